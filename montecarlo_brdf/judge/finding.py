"""Findings, results, reports: plain data; text, JSON, pictures, exit codes are made from it."""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.statistics import FLOOR, with_error

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis

SCHEMA = 1


class Verdict(StrEnum):
    """What became of a claim."""

    ERROR = "error"  # the model could not be run
    FAIL = "fail"
    INCONCLUSIVE = "inconclusive"
    PASS = "pass"
    KNOWN = "known"  # refuted, and disclaimed by the model
    SKIPPED = "skipped"


class Command(StrEnum):
    """What was asked; a report is drawn and told by it."""

    RUN = "run"
    FURNACE = "furnace"
    CONVERGE = "converge"
    RADIANCE = "radiance"
    STRESS = "stress"
    COMPARE = "compare"
    IDENTITIES = "identities"
    TABLE = "table"
    CHECK = "check"  # one result of a report


class Bound(StrEnum):
    """How a number is held against what is expected."""

    AT_MOST = "at most"
    AT_LEAST = "at least"
    EQUAL = "equal"


#: The worst comes first; a run is as bad as its worst finding, and "known" never fails it.
SEVERITY = tuple(Verdict)
EXIT_CODES = dict.fromkeys((Verdict.PASS, Verdict.KNOWN, Verdict.SKIPPED), 0)
EXIT_CODES |= {Verdict.FAIL: 1, Verdict.INCONCLUSIVE: 3, Verdict.ERROR: 4}


class Policy(StrEnum):
    """What an inconclusive report counts as, if somebody says so."""

    PASS = Verdict.PASS.value
    FAIL = Verdict.FAIL.value

    @property
    def code(self) -> int:
        """The exit code."""
        return EXIT_CODES[Verdict(self.value)]


@dataclass(frozen=True)
class Finding:
    """The outcome of one claim."""

    quantity: str
    where: dict[str, Any]
    verdict: Verdict
    bound: str = Bound.EQUAL
    value: float = math.nan
    stderr: float = math.nan
    expected: float | None = None
    tolerance: float | None = None
    resolves: float | None = None
    level: float | None = None
    samples: int | None = None
    estimator: str | None = None
    reference: dict[str, Any] | None = None
    estimators: list[dict[str, Any]] = field(default_factory=list)
    note: str | None = None
    hint: str | None = None
    reproduce: str | None = None
    draws: dict[str, Any] | None = None  # counts in cells of equal probability, for pictures
    follows: str | None = None  # from what of the model: a consequence of its cause

    @property
    def number(self) -> str:
        """The value with its error bar: '0.68899(76)', '0.8(0)' if it is exact to rounding, '0' if
        it is nothing but rounding; empty if nothing was evaluated."""
        if self.verdict in (Verdict.ERROR, Verdict.SKIPPED) and math.isnan(self.value):
            return ""
        noise = self.expected == 0.0 and self.stderr == 0.0
        return "0" if noise and self.as_wished else with_error(self.value, self.stderr)

    @property
    def as_wished(self) -> bool:
        """Whether the value is what is expected, to rounding: nothing happened where it is from."""
        wish = self.expected
        return wish is not None and abs(self.value - wish) <= FLOOR * (abs(wish) or 1.0)


@dataclass(frozen=True)
class Result:
    """All findings of one check of one model with one parameter set."""

    model: str
    params: dict[str, Any]
    check: str
    findings: list[Finding]
    curves: Sequence[Sequence[tuple[float, ...]]] = field(default=())  # per channel, for plots
    source: dict[str, Any] = field(default_factory=dict)  # file and line of the user's f

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of its findings."""
        return worst(f.verdict for f in self.findings)


@dataclass(frozen=True)
class Report:
    """The only artefact of a run."""

    command: Command
    settings: dict[str, Any]
    results: list[Result]
    measured: dict[str, Any] = field(default_factory=dict)
    versions: dict[str, str] | None = None  # of what made it, if that is not this process
    diagnosis: Sequence[Diagnosis] = ()  # of each model that was refuted

    @property
    def verdict(self) -> Verdict:
        """PASS, FAIL or INCONCLUSIVE (ERROR if a model could not be run)."""
        verdict = worst(r.verdict for r in self.results)
        return Verdict.PASS if verdict in (Verdict.KNOWN, Verdict.SKIPPED) else verdict

    @property
    def exit_code(self) -> int:
        """0 all claims held, 1 one was refuted, 3 inconclusive, 4 the model could not be run."""
        return EXIT_CODES[self.verdict]

    @property
    def level(self) -> float:
        """The sum of the false-alarm rates of all findings."""
        return math.fsum(f.level or 0.0 for r in self.results for f in r.findings)

    def to_dict(self) -> dict[str, Any]:
        """Plain data; `results` has nothing that changes between equal runs."""
        told = {"diagnosis": [d.told() for d in self.diagnosis]} if self.diagnosis else {}
        return {
            "schema": SCHEMA, "command": self.command, "verdict": self.verdict, **told,
            "versions": self.versions or versions(), "settings": self.settings,
            "results": [_result(r) for r in self.results], "measured": self.measured,
        }  # fmt: skip

    def to_json(self) -> str:
        """The report as JSON; numbers that are not finite become null: JSON has no name for
        them."""
        return json.dumps(_plain(self.to_dict()), indent=1, allow_nan=False) + "\n"


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """The worst of some verdicts; SKIPPED if there is none."""
    return min(verdicts, key=SEVERITY.index, default=Verdict.SKIPPED)


def versions() -> dict[str, str]:
    """What the numbers may depend on besides the settings."""
    from importlib.metadata import version

    from montecarlo_brdf import __version__

    packages = {name: version(name) for name in ("numba", "llvmlite", "numpy")}
    return {"montecarlo_brdf": __version__, "python": platform.python_version(), **packages}


def _result(result: Result) -> dict[str, Any]:
    extra = {k: v for k in ("source", "curves") if (v := getattr(result, k))}
    told = [{k: v for k, v in vars(f).items() if v not in (None, [])} for f in result.findings]
    return {
        "model": result.model, "params": result.params, "check": result.check,
        "verdict": result.verdict, "findings": told, **extra,
    }  # fmt: skip


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
