"""Mixtures by name: values and albedos of the table, parameters, the claim kd + ks <= 1."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.vectors import from_degrees

FILE = Path(__file__).parent.parent / "data" / "reference.json"
MASKING = {"corr": "smith", "sep": "separable", "vcavity": "v_cavity"}


def entries(quantity: str) -> list[dict[str, Any]]:
    data = json.loads(FILE.read_text())
    return [e for e in data if e["model"] == "mixture" and e["quantity"] == quantity]


def surface(params: dict[str, Any]) -> tuple[Any, Any]:
    """kd Lambert of albedo 1 and ks Cook-Torrance."""
    spec = params["spec"]
    kind, _, rest = spec["F"].partition(":")
    numbers = {k.lower(): float(v) for k, v in (p.split("=") for p in rest.split(",") if p)}
    lobe = {"distribution": spec["D"], "masking": MASKING[spec["G"]], "fresnel": kind, **numbers}
    lobe |= {k: spec[k] for k in ("alpha", "n") if k in spec}
    model = mb.load(f"{params['kd']} lambert + {params['ks']} cook_torrance")
    given = {f"cook_torrance.{k}": v for k, v in lobe.items()}
    p = model.parameters(**{"lambert.albedo": 1.0}, **given)
    return model.of(p), p


@pytest.mark.parametrize("entry", entries("brdf"), ids=lambda e: str(e["theta_i_deg"]))
def test_values(entry: dict[str, Any]) -> None:
    model, p = surface(entry["params"])
    wo = from_degrees(entry["theta_o_deg"], entry["phi_o_deg"])
    wi = from_degrees(entry["theta_i_deg"], entry["phi_i_deg"])
    value = model.f(wo, wi, model.prepared(p))
    assert value == pytest.approx(float(entry["value"]), rel=1e-13)


@pytest.mark.parametrize("entry", entries("albedo"), ids=lambda e: str(e["theta_o_deg"]))
def test_albedos(entry: dict[str, Any]) -> None:
    model, p = surface(entry["params"])
    found = _truth.independent(model, p, entry["theta_o_deg"])
    assert found is not None
    exact = float(entry["value"])
    assert abs(found.value - exact) <= max(1e-11, 10.0 ** -(entry["digits"] - 1)) * exact
    assert abs(found.value - exact) <= found.error + 10.0 ** -(entry["digits"] - 1) * exact


def test_weights_beyond_one_are_a_finding_not_a_crash() -> None:
    model = mb.load("0.7 lambert + 0.6 ggx")
    report = mb.furnace(model, theta_o_deg=[80.0], sampler="cosine")
    (finding,) = [f for f in report.results[0].findings if f.quantity.startswith("sum of weights")]
    assert finding.verdict == "fail" and report.exit_code == 1


def test_a_model_that_comes_twice_has_two_sets_of_parameters() -> None:
    model = mb.load("0.5 ggx + 0.5 ggx")
    p = model.parameters(**{"ggx.alpha": 0.1, "ggx_2.alpha": 0.4})
    assert (p.ggx_alpha, p.ggx_2_alpha) == (0.1, 0.4)


@pytest.mark.parametrize("spec", ["x lambert + 1 ggx", "-1 lambert + 1 ggx", "nan lambert + 1 ggx"])
def test_wrong_weights_are_refused_in_one_sentence(spec: str) -> None:
    with pytest.raises(UserError, match="weights of a mixture"):
        mb.load(spec)


def test_own_sampling_agrees_with_the_reference() -> None:
    """Within the 1e-7 interval of Student's t."""
    model = mb.load("0.6 lambert + 0.4 ggx")
    p = model.parameters(**{"ggx.alpha": 0.05})
    e = mb.directional_albedo(model, p, 70.0, sampler="own", samples=2**18)
    exact = _truth.independent(model, p, 70.0)
    assert exact is not None
    assert abs(e.mean - exact.value) <= e.half_width(1e-7)
