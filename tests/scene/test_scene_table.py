"""Every `radiance` entry of the table of true values: by closed form or quadrature, and sampled."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.scene import plan, radiance, skies, truth
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.skies import cap_of
from montecarlo_brdf.scene.surface import Surface, lobes_of
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.vectors import from_degrees

FILE = Path(__file__).parents[1] / "data" / "reference.json"
ENTRIES = [e for e in json.loads(FILE.read_text()) if e["quantity"] == "radiance"]
GROUPS = sorted({e["model"] for e in ENTRIES})
NAMES = {"oren_nayar_qualitative": "oren_nayar", "phong_modified": "phong"}
RENAMED = {"c": "albedo", "rho": "albedo", "r": "roughness"}
MASKINGS = {"corr": "smith", "sep": "separable"}
FINE = truth.Quadrature(target=1e-9)
LEVEL = 1e-6 / len(ENTRIES)  # of a false alarm, per entry


def _model(entry: dict[str, Any]) -> tuple[Any, Any]:
    raw = dict(entry["params"])
    model = mb.load(NAMES.get(entry["model"], entry["model"]))
    if "D" in raw:
        fresnel, _, f0 = raw["F"].partition(":F0=")
        values: dict[str, Any] = {"distribution": raw["D"], "masking": MASKINGS[raw["G"]]}
        values |= {"fresnel": fresnel, "alpha": raw["alpha"], **({"f0": float(f0)} if f0 else {})}
    else:
        values = {RENAMED.get(k, k): v for k, v in raw.items()}
    p = model.parameters(**values)
    return model.of(p), p


def _shape(env: dict[str, Any]) -> Any:
    axis = from_degrees(env.get("u_tilt_deg", 0.0), env.get("u_azimuth_deg", 0.0))
    made = {
        "cosine": lambda: skies.Cosine(1.0),
        "gradient": lambda: skies.Linear(0.5, 0.5, axis),
        "power_lobe": lambda: skies.Cosine(env["m"], axis),
        "cap": lambda: cap_of(env["half_angle_deg"], axis),
        "quadratic": lambda: skies.Quadratic(axis),
    }
    return made[env["type"]]()


def _scene(entry: dict[str, Any]) -> tuple[Scene, Any]:
    model, p = _model(entry)
    sky = skies.Sky((_shape(entry["env"]),), (1.0,))
    surface = Surface(tuple(lobes_of(model, p, (1.0,), 1)))
    wo = from_degrees(entry["theta_o_deg"], entry["env"].get("view_azimuth_deg", 0.0))
    return Scene("test", 1, surface, sky), wo


@pytest.mark.parametrize("group", GROUPS)
def test_truth(group: str) -> None:
    for entry in (e for e in ENTRIES if e["model"] == group):
        scene, wo = _scene(entry)
        found, expected = truth.reference(scene, wo, 0, FINE), float(entry["value"])
        resolution = abs(expected) * 10.0 ** (1 - entry["digits"])
        # the angle of a cap reaches the horizon with a rounding that moves E by 1e-16
        error = max(found.error, 1e-12 * expected)
        assert abs(found.value - expected) <= error + resolution + 1e-16, entry
        assert found.error <= 1e-7 * expected + 2e-16
        assert abs(found.value - expected) <= found.error + resolution + 1e-18, (entry, found)


@pytest.mark.parametrize("group", GROUPS)
def test_estimates(group: str) -> None:
    for entry in (e for e in ENTRIES if e["model"] == group):
        scene, wo = _scene(entry)
        (found,) = radiance.measure(
            plan.make(scene), wo, Plan(points="independent", samples=1 << 14, seed=1)
        )
        e, expected = found.estimate, float(entry["value"])
        if not found.unfit:
            half = quantile(LEVEL / 2.0, 15) * e.stderr
            assert abs(e.mean - expected) <= half + 1e-12 * expected + 1e-40, (entry, str(e))
        assert not found.unfit or expected < 1e-5, (entry, found.unfit)
        assert math.isfinite(e.mean)
