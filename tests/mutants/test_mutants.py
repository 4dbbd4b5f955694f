"""Every known-bad BRDF is refuted by the check meant for it; no honest one ever fails.

The models are files as users write them. A mutant's docstring names the check: "caught by: energy",
and what was done to it: "cause: missing 1/pi". Nearly all of the time goes into compiling a model's
kernels (scripts/effort.py), one or two for a law of f and up to ten for all checks. So the suite
asks at low effort

- every mutant of a law of f, and the first of each other check, until a claim fails,
- every honest and every built-in model the laws of f, and a few honest ones everything,

but for those whose docstring says "suite: slow": they cost as much and ask the same kinds again;

`python -m pytest -m slow tests/mutants` asks the other mutants at low effort, those that it misses
at full effort, every honest model everything at low and at full effort, and whether the list of
what low effort misses is exact.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import montecarlo_brdf
from montecarlo_brdf import checks, loading
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Verdict
from montecarlo_brdf.verify.run import ANGLES as RUN_ANGLES
from montecarlo_brdf.verify.run import SAMPLES

TESTS = Path(__file__).parents[1]
MUTANTS = sorted(p for p in (TESTS / "mutants").glob("*.py") if not p.stem.startswith("test_"))
HONEST = sorted((TESTS / "honest").glob("*.py"))
LOW = 0.03  # of the pairs, places and nodes: docs/statistics.md says what it catches
#: mutants that low effort misses -> why
MISSED = {
    "retro_pole_shortcut": "draws towards the viewer of a narrow lobe alone",
    "sheen_rim_never_drawn": "a rim of f that no draw meets, at few places",
}
#: checks of f alone: they compile nothing but f
OF_F = ("positivity", "reciprocity", "isotropy", "equality", "limits")
#: honest models are asked everything, at fewer angles: it is about their kinds, not about angles
ANGLES = (0.0, 70.0)
#: honest models that are asked everything by default: two kinds of samplers, and none
SHORT = {"both_from_one_number", "sampler_without_pdf", "weights_alone"}


def _told(path: Path, what: str) -> str:
    """What a docstring says of its model, "" where it does not."""
    found = re.findall(rf"^{what}: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return str(found[0]) if found else ""


def meant(path: Path) -> str:
    """The check that a mutant's docstring names."""
    return _told(path, "caught by")


def later(path: Path) -> bool:
    """Whether a model is left to `-m slow` altogether."""
    return _told(path, "suite") == "slow"


def refuted(path: Path, effort: float) -> bool:
    """Whether a claim of the check meant for a mutant fails: the first that does is enough."""
    model = montecarlo_brdf.load(str(path))
    p, plan = model.parameters(), Plan(samples=SAMPLES, effort=effort)
    case = Case(model, p, RUN_ANGLES, free=searched(model, {}), effort=effort)
    claims = checks.find(meant(path)).claims(case)
    return any(decide(claim, plan).verdict == Verdict.FAIL for claim in claims)


def failures(spec: str, effort: float, names: tuple[str, ...] | None = None) -> list[object]:
    """The claims of a model that a run calls failed."""
    model = montecarlo_brdf.load(spec)
    report = montecarlo_brdf.run(model, names=names, theta_o_deg=ANGLES, effort=effort)
    found = [(r.check, f) for r in report.results for f in r.findings]
    return [one for one in found if one[1].verdict == Verdict.FAIL]


def _first(check: str) -> Path:
    return next(p for p in CAUGHT if meant(p) == check and not later(p))


def _marked(paths: list[Path], quick: set[Path]) -> list[object]:
    slow = pytest.mark.slow
    return [pytest.param(p, id=p.stem, marks=() if p in quick else slow) for p in paths]


CAUGHT = [p for p in MUTANTS if p.stem not in MISSED]
OFTEN = {p for p in CAUGHT + HONEST if not later(p)}
REFUTING = [c for c in checks.names() if c != "coverage"]  # which only tells
QUICK = {p for p in OFTEN if meant(p) in OF_F} | {_first(c) for c in REFUTING}


@pytest.mark.parametrize("path", _marked(CAUGHT, QUICK))
def test_mutant_is_refuted_at_low_effort(path: Path) -> None:
    assert refuted(path, LOW)


@pytest.mark.slow
@pytest.mark.parametrize("name", MISSED)
def test_mutant_that_low_effort_misses_is_refuted(name: str) -> None:
    """At full effort; one that low effort does catch has to leave the list."""
    path = TESTS / "mutants" / f"{name}.py"
    assert refuted(path, 1.0)
    assert not refuted(path, LOW)


@pytest.mark.parametrize("path", _marked(HONEST, OFTEN))
def test_honest_model_keeps_the_laws_of_f(path: Path) -> None:
    assert failures(str(path), LOW, OF_F) == []


@pytest.mark.parametrize("name", loading.names())
def test_built_in_model_keeps_the_laws_of_f(name: str) -> None:
    assert failures(name, LOW, OF_F) == []


@pytest.mark.parametrize("path", _marked(HONEST, {p for p in HONEST if p.stem in SHORT}))
def test_honest_model_never_fails_at_low_effort(path: Path) -> None:
    assert failures(str(path), LOW) == []


@pytest.mark.slow
@pytest.mark.parametrize("path", HONEST, ids=lambda p: p.stem)
def test_honest_model_never_fails(path: Path) -> None:
    assert failures(str(path), 1.0) == []


def test_corpus_is_large() -> None:
    assert len(MUTANTS) >= 185
    assert len(HONEST) >= 70


def test_every_mutant_says_what_was_done_to_it() -> None:
    """By a cause that scripts/detection_matrix.py looks for in the hints, or "none"."""
    known = {"none", *tomllib.loads((TESTS / "mutants" / "causes.toml").read_text("utf-8"))}
    assert {p.stem for p in MUTANTS if _told(p, "cause") not in known} == set()


def test_every_check_has_a_mutant() -> None:
    assert set(REFUTING) == {meant(p) for p in MUTANTS}
