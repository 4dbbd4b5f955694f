"""Integrals of known values by a mixture of densities that no lobe escapes.

A test fails by chance once in LEVEL of all seeds, by Student's t over the replicates; how small
error bars are is asked too, as wide ones are always right.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import Law, hardly, mass_of, reflected_of
from montecarlo_brdf.estimate.mixture import (
    FARTHEST,
    NEAREST,
    Groups,
    around,
    blind_density,
    centres,
    cosine,
    estimated,
    frame,
    taken,
)
from montecarlo_brdf.estimate.places import rows_of
from montecarlo_brdf.model import Model
from montecarlo_brdf.statistics import Estimate, quantile
from montecarlo_brdf.vectors import from_degrees

Make = Callable[..., Case]

LEVEL = 1e-9
SIZE, REPLICATES = 1 << 17, 16
ANGLES = (0.0, 50.0, 85.0)
MUTANTS = Path(__file__).parents[1] / "mutants"
NARROW = [1e2, 1e3, 1e4]  # beyond, f is 0 but near the axis, and no height leads there

#: a lobe about an axis 35 degrees off, nowhere near the mirror direction, and without the cosine
#: of wi: it reflects 1 - cos(55 degrees)^(n + 1), hardly less than a
LOBE = """
AXIS = (0.0, math.sin(math.radians(35.0)), math.cos(math.radians(35.0)))


class Params(NamedTuple):
    a: float = 0.5
    n: float = 100.0


domain = {"a": (0.0, 1.0), "n": (100.0, 1e4)}
isotropic = False


def f(wo, wi, p):
    c = max(0.0, wi[1] * AXIS[1] + wi[2] * AXIS[2])
    return p.a * (p.n + 1.0) / (2.0 * math.pi) * c**p.n / wi[2]
"""
#: what is drawn follows the cosine; pdf says twice of it
TWICE = """
def f(wo, wi, p):
    return 0.7 / math.pi

def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return 2.0 * wi[2] / math.pi
"""


def groups(model: Model, changed: dict[str, float], angles: tuple[float, ...] = ANGLES) -> Groups:
    """The same parameters at some angles."""
    one = model.parameters(**changed)
    table = np.array([tuple(one)] * len(angles), dtype=float).reshape(len(angles), -1)
    return Groups(rows_of(model, one, table), np.array([from_degrees(t, 20.0) for t in angles]))


def integrals(
    model: Model, law: Law, own: bool = True, reverse: bool = False, **changed: float
) -> list[Estimate]:
    """What a law gives at all angles."""
    at = groups(model, changed)
    how = {"own": own, "reverse": reverse}
    centre = centres(model, at, reverse)
    means = taken(model, at, centre, SIZE, REPLICATES, 5, law, **how)
    return [estimated(row, SIZE) for row in means]


def off(e: Estimate, due: float) -> float:
    """How far from what is due, in half widths at LEVEL; rounding apart."""
    return abs(e.mean - due) / (quantile(LEVEL / 2.0, REPLICATES - 1) * e.stderr + 1e-12)


@pytest.mark.parametrize("own", [True, False])
@pytest.mark.parametrize("reverse", [True, False])
def test_lambert_reflects_its_albedo(own: bool, reverse: bool) -> None:
    for e in integrals(mb.load("lambert"), reflected_of, own, reverse, albedo=0.7):
        assert off(e, 0.7) < 1.0 and e.stderr < 5e-4


@pytest.mark.parametrize("n", NARROW)
def test_a_narrow_lobe_off_the_mirror_direction_is_found(n: float, case_of: Make) -> None:
    for e in integrals(case_of(LOBE).model, reflected_of, n=n):
        assert off(e, 0.5 * (1.0 - math.cos(math.radians(55.0)) ** (n + 1.0))) < 1.0
        assert e.stderr < 1e-3


@pytest.mark.parametrize(("name", "changed"), [("lambert", {}), ("phong_unclamped", {"n": 1e4})])
def test_a_pdf_integrates_to_1_with_what_is_rejected(name: str, changed: dict[str, float]) -> None:
    for e in integrals(mb.load(name), mass_of, **changed):
        assert off(e, 1.0) < 1.0 and e.stderr < 1e-3


def test_nodes_that_know_nothing_of_a_pdf_are_right_where_it_is_wrong(case_of: Make) -> None:
    model = case_of(TWICE).model
    for e in integrals(model, reflected_of, own=False):
        assert off(e, 0.7) < 1.0 and e.stderr < 5e-4
    for e in integrals(model, reflected_of, own=True):  # its draws count for half
        assert e.mean < 0.6 and off(e, 0.7) > 1.0


def test_what_is_never_drawn_is_measured() -> None:
    """The mean of Lambert over all of it; nothing where the sampler draws everything."""
    mutant = mb.load(str(MUTANTS / "diffuse_never_drawn.py"))
    assert min(e.mean for e in integrals(mutant, hardly, blend=1.0)) > 0.1
    assert max(e.mean for e in integrals(mb.load("lambert"), hardly)) == 0.0


def test_the_blind_density_integrates_to_1_over_the_sphere() -> None:
    """By nodes even on the sphere about a centre: chords by their logarithm, so the integrand is
    flat."""
    centre = np.array([[0.6, 0.0, 0.8]])
    k = 400
    u0, u1 = (x.ravel() for x in np.meshgrid((np.arange(k) + 0.5) / k, (np.arange(k) + 0.5) / k))
    w = around(np.repeat(centre, k * k, axis=0), u0, u1)
    s = NEAREST * np.exp(math.log(FARTHEST / NEAREST) * u0)
    element = 2.0 * math.pi * math.log(FARTHEST / NEAREST) * s * s  # sr per unit of u0 u1
    near = blind_density(centre[:, None], w[None], (0.0, 1.0))[0]
    assert float(np.mean(near * element)) == pytest.approx(1.0, abs=1e-4)


def test_directions_around_a_centre_lie_at_all_distances() -> None:
    rng = np.random.default_rng(1)
    centre = cosine(rng.random((5000, 2)))
    w = around(centre, rng.random(5000), rng.random(5000))
    distance = np.linalg.norm(w - centre, axis=1)
    assert np.abs(np.linalg.norm(w, axis=1) - 1.0).max() < 1e-15
    for decade in range(-6, 0):
        share = np.mean((distance > 10.0**decade) & (distance < 10.0 ** (decade + 1)))
        assert share == pytest.approx(1.0 / math.log10(FARTHEST / NEAREST), abs=0.03)


def test_frames_are_orthonormal_in_both_halves_of_the_sphere() -> None:
    w = np.random.default_rng(2).normal(size=(1000, 3))
    w /= np.linalg.norm(w, axis=1)[:, None]
    for x, y in ((a, b) for a in (w, *frame(w)) for b in (w, *frame(w))):
        due = 1.0 if np.array_equal(x, y) else 0.0
        assert np.abs(np.sum(x * y, axis=1) - due).max() < 1e-14


def test_values_are_the_same_again_and_in_parts() -> None:
    model = mb.load("ggx")
    at = groups(model, {})
    centre = centres(model, at)
    one = taken(model, at, centre, 1024, 4, 3, reflected_of)
    assert np.array_equal(one, taken(model, at, centre, 1024, 4, 3, reflected_of))
    alone = taken(model, at.at(slice(1, 2)), centre[1:2], 1024, 4, 3, reflected_of)
    assert np.allclose(one[1:2], alone, rtol=1e-14)
    assert not np.array_equal(one, taken(model, at, centre, 1024, 4, 4, reflected_of))
