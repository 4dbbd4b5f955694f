"""Findings, results, reports: plain data; text, JSON, pictures, exit codes are made from it."""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

SCHEMA = 1


class Verdict(StrEnum):
    """What became of a claim."""

    ERROR = "error"  # the model could not be run
    FAIL = "fail"
    INCONCLUSIVE = "inconclusive"
    PASS = "pass"
    KNOWN = "known"  # refuted, and disclaimed by the model
    SKIPPED = "skipped"


class Bound(StrEnum):
    """How a number is held against what is expected."""

    AT_MOST = "at most"
    AT_LEAST = "at least"
    EQUAL = "equal"


#: The worst comes first; a run is as bad as its worst finding, and "known" never fails it.
SEVERITY = tuple(Verdict)
EXIT_CODES = {
    Verdict.PASS: 0,
    Verdict.KNOWN: 0,
    Verdict.SKIPPED: 0,
    Verdict.FAIL: 1,
    Verdict.INCONCLUSIVE: 3,
    Verdict.ERROR: 4,
}


@dataclass(frozen=True)
class Finding:
    """The outcome of one claim."""

    quantity: str
    where: dict[str, Any]
    verdict: str
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


@dataclass(frozen=True)
class Result:
    """All findings of one check of one model with one parameter set."""

    model: str
    params: dict[str, Any]
    check: str
    findings: list[Finding]
    curves: list[list[tuple[float, float]]] = field(default_factory=list)  # per channel, for plots
    source: dict[str, Any] = field(default_factory=dict)  # file and line of the user's f

    @property
    def verdict(self) -> str:
        """The worst verdict of its findings."""
        return worst(f.verdict for f in self.findings)


@dataclass(frozen=True)
class Report:
    """The only artefact of a run."""

    command: str
    settings: dict[str, Any]
    results: list[Result]
    measured: dict[str, Any] = field(default_factory=dict)

    @property
    def verdict(self) -> str:
        """ "pass", "fail" or "inconclusive" ("error" if a model could not be run)."""
        verdict = worst(r.verdict for r in self.results)
        return "pass" if verdict in ("known", "skipped") else verdict

    @property
    def exit_code(self) -> int:
        """0 all claims held, 1 one was refuted, 3 inconclusive, 4 the model could not be run."""
        return EXIT_CODES[Verdict(self.verdict)]

    @property
    def level(self) -> float:
        """The sum of the false-alarm rates of all findings."""
        return math.fsum(f.level or 0.0 for r in self.results for f in r.findings)

    def to_dict(self) -> dict[str, Any]:
        """Plain data; `results` has nothing that changes between equal runs."""
        return {
            "schema": SCHEMA,
            "command": self.command,
            "verdict": self.verdict,
            "versions": versions(),
            "settings": self.settings,
            "results": [_result(r) for r in self.results],
            "measured": self.measured,
        }

    def to_json(self) -> str:
        """The report as JSON; numbers that are not finite become null: JSON has no name for
        them."""
        return json.dumps(_plain(self.to_dict()), indent=1, allow_nan=False) + "\n"


def worst(verdicts: Iterable[str]) -> str:
    """The worst of some verdicts; "skipped" if there is none."""
    return min(verdicts, key=SEVERITY.index, default="skipped")


def versions() -> dict[str, str]:
    """What the numbers may depend on besides the settings."""
    from importlib.metadata import version

    from montecarlo_brdf import __version__

    packages = {name: version(name) for name in ("numba", "llvmlite", "numpy")}
    return {"montecarlo_brdf": __version__, "python": platform.python_version(), **packages}


def _result(result: Result) -> dict[str, Any]:
    extra = {k: v for k in ("source", "curves") if (v := getattr(result, k))}
    return {
        "model": result.model,
        "params": result.params,
        "check": result.check,
        "verdict": result.verdict,
        "findings": [_finding(f) for f in result.findings],
        **extra,
    }


def _finding(finding: Finding) -> dict[str, Any]:
    return {k: v for k, v in vars(finding).items() if v not in (None, [])}


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
