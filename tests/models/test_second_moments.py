"""The spread that estimators predict for blind samplers is the true one.

`second_moment` by uniform and by cosine sampling estimates E[x^2] of the one-sample albedo
estimator from draws by the model's own sampler; formulas and quadratures give it independently. The
deviation is judged by Student's t at 1e-7 per value (about 1e-5 for all), plus 2e-3 where
replicates of an integrand with a heavy tail know too little of it.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from montecarlo_brdf import load
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import second_moment
from montecarlo_brdf.estimate.samplers import functions_of
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import from_degrees

LEVEL = 1e-7
PLAN = Plan(samples=1 << 20)
NAMES = {"c": "albedo", "rho": "albedo", "r": "roughness", "base": "albedo"}
MODELS = {
    "oren_nayar_qualitative": "oren_nayar",
    "phong_modified": "phong",
    "phong_original_normalised": "phong_original",
}
CHOICES = {
    "D": ("distribution", {}),
    "G": ("masking", {"corr": "smith", "sep": "separable", "vcavity": "v_cavity"}),
}


def entries() -> list[dict[str, Any]]:
    data = json.loads((Path(__file__).parent.parent / "data" / "reference.json").read_text())
    return [e for e in data if e["quantity"].startswith("second_moment")]


def translated(params: dict[str, Any]) -> dict[str, Any]:
    """The entry's parameters under the names of our models."""
    found: dict[str, Any] = {}
    for key, value in params.items():
        if key in CHOICES:
            name, words = CHOICES[key]
            found[name] = words.get(value, value)
        elif key == "F":
            kind, _, rest = value.partition(":")
            found["fresnel"] = kind
            found |= {k.lower(): float(v) for k, v in (p.split("=") for p in rest.split(",") if p)}
        else:
            found[NAMES.get(key, key)] = value
    return found


@pytest.mark.parametrize("entry", entries(), ids=lambda e: f"{e['model']}-{e['theta_o_deg']}")
def test_predicted_second_moment(entry: dict[str, Any]) -> None:
    model = load(MODELS.get(entry["model"], entry["model"]))
    p = model.parameters(**translated(entry["params"]))
    sampler = Sampler(entry["quantity"].removeprefix("second_moment_"))
    wo, variant = from_degrees(entry["theta_o_deg"]), model.of(p)
    integrand = second_moment(sampler, functions_of(variant))
    (e,) = estimates(variant, p, wo, [integrand], PLAN, ("test",))[0]
    truth = float(entry["value"])
    assert abs(e.mean - truth) <= e.half_width(LEVEL) + 2e-3 * truth
