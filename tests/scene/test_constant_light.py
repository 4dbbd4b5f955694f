"""Under constant light furnace and radiance ask one question: one verdict, estimator and value."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.judge.finding import Finding, Report
from montecarlo_brdf.scene.read import scene_of

TESTS = Path(__file__).parents[1]
CORPORA = [
    *loading.names(),
    *(str(p) for p in sorted((TESTS / "honest").glob("*.py"))),
    *(str(p) for p in sorted((TESTS / "mutants").glob("*.py")) if not p.stem.startswith("test_")),
]
#: asked by default: a sampler with a pdf, a constant f, one with a weight, none
SHORT = ("ggx", "lambert", "sampler_with_weights", "ggx_missing_quarter")
THETA = 30.0


def short(spec: str) -> bool:
    return Path(spec).stem in SHORT


def told(report: Report, quantity: str) -> tuple[Any, ...]:
    """What a report finds of a quantity."""
    finding: Finding = next(f for r in report.results for f in r.findings if f.quantity == quantity)
    return finding.verdict, finding.estimator, repr(finding.value), repr(finding.stderr)


def agree(spec: str) -> None:
    """That both say the same of a model, of A and of its bound."""
    model = mb.load(spec)
    p = model.parameters()
    furnace = mb.furnace(model, p, THETA, samples=1 << 16)
    scene = scene_of(model, p, "constant", (THETA,))
    radiance = mb.radiance(scene, samples=1 << 16)
    assert told(furnace, "A") == told(radiance, "L_o")
    assert told(furnace, "A <= 1") == told(radiance, "A <= 1")


@pytest.mark.parametrize("spec", [s for s in CORPORA if short(s)], ids=lambda s: Path(s).stem)
def test_one_question_has_one_answer(spec: str) -> None:
    agree(spec)


@pytest.mark.slow
@pytest.mark.parametrize("spec", [s for s in CORPORA if not short(s)], ids=lambda s: Path(s).stem)
def test_one_question_has_one_answer_for_all(spec: str) -> None:
    agree(spec)


def test_what_grows_towards_the_horizon(user_file: Any) -> None:
    """Cosine sampling of 1/cos has no variance; two copies of what may be believed disagreed."""
    path = str(user_file("def f(wo, wi, p):\n    return 0.1 / wi[2]\n"))
    agree(path)
    found = mb.furnace(mb.load(path), None, THETA)
    assert told(found, "A")[:2] == ("pass", "uniform")


def test_the_light_scales_what_is_found(user_file: Any) -> None:
    """A weight and a sky of another radiance than 1 change nothing but the unit."""
    model = mb.load(str(user_file("def f(wo, wi, p):\n    return 0.1 + 0.1 * wi[2]\n")))
    p = model.parameters()
    one, three = (
        mb.radiance(scene_of(model, p, sky, (THETA,)), samples=1 << 16)
        for sky in ("constant", "constant:3")
    )
    a, b = (next(f for f in r.results[0].findings if f.quantity == "L_o") for r in (one, three))
    assert b.value == pytest.approx(3.0 * a.value, rel=1e-15)
    assert b.stderr == pytest.approx(3.0 * a.stderr, rel=1e-15)
    assert b.tolerance == pytest.approx(3.0 * float(a.tolerance or 0.0), rel=1e-15)
