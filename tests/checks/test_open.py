"""Honest models whose `run` stayed open, or failed: a density that grows towards the horizon,
masking that knows the azimuth and has no sampler, a table that is looked up and not interpolated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import montecarlo_brdf as mb

#: Lommel-Seeliger drawn by cos = u^2: the pdf is cos^-1/2/(4 pi)
HEAVY = """
import math

def f(wo, wi, p):
    return 1.0 / (4.0 * math.pi * (wo[2] + wi[2]))

def sample(wo, u, p):
    z = (1.0 - u[0]) * (1.0 - u[0])
    s, phi = math.sqrt(1.0 - z * z), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z

def pdf(wo, wi, p):
    return 1.0 / (4.0 * math.pi * math.sqrt(wi[2]))
"""

#: GGX of widths 0.1 and 0.8, height-correlated masking by the width along each direction (Heitz
#: 2014); A(80) = 0.60429944
ANISOTROPIC = """
import math

isotropic = False

def stretched(w):
    return math.sqrt(0.01 * w[0] * w[0] + 0.64 * w[1] * w[1] + w[2] * w[2])

def f(wo, wi, p):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    t = (x * x / 0.01 + y * y / 0.64 + z * z) / (x * x + y * y + z * z)
    masking = 2.0 / (wo[2] * stretched(wi) + wi[2] * stretched(wo))
    return masking / (4.0 * math.pi * 0.08 * t * t)
"""

#: 90 steps of the half vector's angle
STEPS = """
import math

def f(wo, wi, p):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    angle = math.acos(min(1.0, z / math.sqrt(x * x + y * y + z * z)))
    step = math.floor(90.0 * math.sqrt(angle / (0.5 * math.pi)))
    return 0.1 + 0.5 / (1.0 + step * step / 25.0)
"""


@pytest.mark.parametrize(
    ("text", "checks"),
    [(HEAVY, ["pdf", "sampling"]), (ANISOTROPIC, ["furnace"]), (STEPS, ["furnace", "radiance"])],
    ids=["heavy", "anisotropic", "steps"],
)
def test_honest_models_pass(text: str, checks: list[str], user_file: Callable[[str], Any]) -> None:
    report = mb.run(mb.load(str(user_file(text))), names=checks)
    assert {f.verdict for r in report.results for f in r.findings} <= {"pass", "skipped"}


def test_an_albedo_that_stayed_open_is_what_it_is(user_file: Callable[[str], Any]) -> None:
    report = mb.furnace(mb.load(str(user_file(ANISOTROPIC))), None, 80.0, samples=1 << 16)
    found = report.results[0].findings[0]
    assert found.expected == pytest.approx(0.60429944, rel=1e-6)
