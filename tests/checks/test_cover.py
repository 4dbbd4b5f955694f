"""What draws leave out, and how they are distributed, is refuted; weights right on average pass."""

from __future__ import annotations

from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.checks import cover
from montecarlo_brdf.judge.claim import Skip
from montecarlo_brdf.judge.finding import Finding

TESTS = Path(__file__).parents[1]
EFFORT = 0.03


def findings(spec: str, *names: str) -> list[Finding]:
    """What some checks say of a model."""
    report = mb.run(mb.load(spec), names=names, theta_o_deg=(45.0,), effort=EFFORT)
    return [f for r in report.results for f in r.findings]


def failed(spec: str) -> list[str]:
    """The claims of cover that fail."""
    return [f.quantity for f in findings(spec, "cover") if f.verdict == "fail"]


def mutant(name: str) -> str:
    return str(TESTS / "mutants" / f"{name}.py")


def test_a_weight_of_one_lobe_alone_passes_and_is_told() -> None:
    found = findings(str(TESTS / "honest" / "weight_of_the_lobe_drawn.py"), "cover", "pdf")
    assert [f for f in found if f.verdict in ("fail", "inconclusive")] == []
    assert any("not f cos/pdf draw by draw" in (f.note or "") for f in found)


def test_a_lobe_that_is_never_drawn_is_refuted_by_name() -> None:
    assert failed(mutant("matte_not_drawn"))[0] == "reflected, but hardly drawn"


def test_azimuths_that_are_not_even_are_refuted_by_their_harmonic() -> None:
    assert failed(mutant("azimuth_of_a_square")) == [
        "mean over weighted draws - int f cos, of cos 4 phi"
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["lambert", "ggx", "phong"])
def test_right_samplers_pass(name: str) -> None:
    assert failed(name) == []


def test_without_a_sampler_nothing_is_asked() -> None:
    model = mb.load(str(TESTS / "honest" / "f_only_ggx.py"))
    case = Case(model, model.parameters(), (45.0,), free=searched(model, {}))
    assert [type(claim) for claim in cover.claims(case)] == [Skip]
