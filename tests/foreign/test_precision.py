"""The check `precision` tells a formula from its rounding."""
from __future__ import annotations

import dataclasses

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf import checks
from montecarlo_brdf.judge.finding import Finding, Verdict
from montecarlo_brdf.model import Model


def precise(model: Model, alpha: float) -> tuple[Verdict, list[Finding]]:
    """What the check says at the normal and near the horizon."""
    p = model.parameters(alpha=alpha)
    report = mb.run(model, p, names=["precision"], theta_o_deg=(0.0, 85.0))
    return report.verdict, report.results[0].findings


@pytest.mark.parametrize(
    ("name", "alpha", "verdict"),
    [("ggx.glsl", 0.3, "pass"), ("ggx.glsl", 0.01, "fail"), ("ggx_stable.glsl", 0.01, "pass")],
)
def test_single_precision_is_enough_or_not(name: str, alpha: float, verdict: str) -> None:
    assert precise(stored.model(name), alpha)[0] == Verdict(verdict)


def test_how_far_it_moves_the_albedo_is_told() -> None:
    model = stored.model("ggx.glsl")
    found = precise(model, 0.01)[1]
    (albedo,) = (f for f in found if f.quantity.startswith("A ") and f.where["theta_o_deg"] == 0.0)
    assert albedo.value == pytest.approx(6.2e-4, abs=0.3e-4)
    assert "single precision moves A by 6.2e-04 at alpha 0.01" in str(albedo.hint)
    p = model.parameters(alpha=0.01)
    formula = mb.run(model, p, names=["furnace", "pdf"], theta_o_deg=[0.0], effort=0.1)
    assert formula.verdict == Verdict.PASS


def test_a_value_that_is_no_number_fails() -> None:
    model = stored.model("ggx_stable.glsl")
    space = stored.functions(stored.texts("ggx_stable.glsl").single)
    source = "def bad(wo, wi, p):\n    return f(wo, wi, p) if wi[0] < 0.5 else 0.0 * 1e400\n"
    exec(source, space)
    broken = dataclasses.replace(model, single=lambda: {"f": space["bad"]})
    verdict, found = precise(broken, 0.3)
    assert verdict == Verdict.FAIL
    assert any("no number in single precision" in str(f.hint) for f in found)


def test_other_models_are_not_asked() -> None:
    assert {*checks.names()} - {*checks.asked(mb.load("lambert"))} == {"coverage", "precision"}
    (only,) = mb.run(mb.load("lambert"), names=["precision"]).results
    assert [f.verdict for f in only.findings] == [Verdict.SKIPPED]
