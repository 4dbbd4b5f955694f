"""Narrow light: right models are never refuted under it, wrong ones are, and where the tool's own
numbers differ it says so. scripts/skies.py asks all models under all skies."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import Finding
from montecarlo_brdf.scene import truth
from montecarlo_brdf.scene.read import scene_of

SAMPLES = 1 << 18
#: what was refuted, or stayed open: narrow skies that no node met, skies at the horizon, tails of
#: two lobes that no sample meets, lobes that change sign
RIGHT = [
    ("ggx", {}, "cosine:1e5"),
    ("ggx", {"alpha": 0.01}, "cosine:1e7:60"),
    ("beckmann", {}, "cosine:1e7:90"),
    ("phong", {}, "cosine:1e3:60"),
    ("phong", {"n": 10000.0}, "cap:0.1:30"),
    ("phong_unclamped", {}, "cosine:1e5:30"),
    ("oren_nayar", {}, "cosine:1e3:90"),
    ("ggx_anisotropic", {}, "cap:0.01:85"),
]
ANGLES = (0.0, 60.0, 85.0)


def findings(spec: Any, sky: str, parameters: dict[str, float]) -> list[Finding]:
    """What is said of L_o."""
    model = mb.load(str(spec))
    scene = scene_of(model, model.parameters(**parameters), sky, ANGLES)
    found: list[Finding] = mb.radiance(scene, energy=False, samples=SAMPLES).results[0].findings
    return found


@pytest.mark.parametrize(("name", "parameters", "sky"), RIGHT)
def test_right_models_pass(name: str, parameters: dict[str, float], sky: str) -> None:
    assert {str(f.verdict) for f in findings(name, sky, parameters)} == {"pass"}


def test_the_estimate_scales_with_the_width_of_the_sky() -> None:
    """int cos^m = 2 pi/(m + 1): where f hardly changes, L_o times m is the same."""
    wide, narrow = (findings("ggx", f"cosine:{m:g}", {})[0] for m in (1e6, 1e7))
    assert (wide.expected or 0.0) * 1e6 == pytest.approx((narrow.expected or 0.0) * 1e7, rel=1e-4)


WRONG = """
import math

def f(wo, wi, p):
    return 0.3 * (wo[2] + wi[2])

def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return 0.5 * wi[2] / math.pi
"""


@pytest.mark.parametrize("sky", ["gradient", "cosine:1", "cosine:20:40"])
def test_a_wrong_pdf_is_refuted(sky: str, user_file: Callable[[str], Any]) -> None:
    """Where draws by it are used: two quadratures agree on what f gives."""
    assert {str(f.verdict) for f in findings(user_file(WRONG), sky, {})} == {"fail"}


def test_two_numbers_of_the_tool_that_differ_refute_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A quadrature that misses a thousandth is refuted by another one: nobody knows which of the
    tool's numbers is wrong, and both are told."""
    right = truth._quadrature

    def first_is_wrong(*place: Any) -> Any:
        found = right(*place)
        return found if place[-1].seed else found._replace(value=0.999 * found.value)

    monkeypatch.setattr(truth, "_quadrature", first_is_wrong)
    truth._of_shape.cache_clear()
    found = findings("ggx", "cosine:20:40", {})
    truth._of_shape.cache_clear()
    doubted = [f for f in found if f.verdict == "inconclusive"]
    assert doubted and {str(f.verdict) for f in found} <= {"inconclusive", "pass"}
    for f in found:
        # two others agree on another value
        assert f.verdict == "inconclusive" or f.expected is None
    for f in doubted:
        assert "not resolved" in str(f.note) and "--samples" in str(f.note)
        assert f"{f.expected:.8g}" in str(f.note) and "mixed sampling says" in str(f.note)


def test_an_image_of_one_texel_that_hides_a_lobe() -> None:
    """Coarse images are cut where the lobe is."""
    import numpy as np

    from montecarlo_brdf.scene.environment import image_sky

    model = mb.load("ggx")
    scene = scene_of(model, model.parameters(alpha=0.02), "constant", (30.0,))
    lit = replace(scene, sky=image_sky(np.ones((2, 4, 1))))
    value, error = truth.reference(lit, (0.5, 0.0, 0.75**0.5), 0)[:2]
    same = truth.reference(scene, (0.5, 0.0, 0.75**0.5), 0)
    assert value == pytest.approx(same.value, abs=error + same.error) and error < 1e-4
