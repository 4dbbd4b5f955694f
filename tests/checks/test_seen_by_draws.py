"""What quadratures and searches in coordinates of the mirror direction miss, and draws show."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _draws, energy
from montecarlo_brdf.estimate.quadrature import Coordinates, integrate
from montecarlo_brdf.statistics import Moments, estimate
from montecarlo_brdf.vectors import from_degrees

TESTS = Path(__file__).parents[1]


def case(name: str) -> Case:
    model = mb.load(str(TESTS / f"{name}.py"))
    return Case(model, model.parameters(), (45.0,), free=tuple(model.domain))


def test_of_two_equal_needles_the_one_that_nodes_do_not_see_is_the_error() -> None:
    """Its values are no higher than theirs, but far above those of the nodes around it."""
    wo, width = np.array(from_degrees(45.0)), 1e-3
    mirror = wo * np.array([-1.0, -1.0, 1.0])

    def needles(w: object) -> object:
        return sum(
            np.exp(-0.5 * np.sum((w - c) ** 2, axis=1) / width**2) / (2.0 * math.pi * width**2)
            for c in (wo, mirror)
        )

    rng = np.random.default_rng(1)
    draws = np.concatenate([c + width * rng.normal(size=(500, 3)) for c in (wo, mirror)])
    draws /= np.linalg.norm(draws, axis=1)[:, None]
    angle = 1.0 / (1000 * 0.5 * needles(draws))
    coordinates = Coordinates(wo, 3e-4)
    blind = integrate(needles, coordinates)
    assert blind.value == pytest.approx(1.0, abs=0.01) and blind.error < 0.01
    seeing = integrate(needles, coordinates, probes=((draws, angle),))
    assert seeing.missed == pytest.approx(1.0, abs=0.1) and seeing.error >= seeing.missed
    one = integrate(lambda w: needles(w) * (w[:, 0] < 0.0), coordinates, probes=((draws, angle),))
    assert one.missed < 1e-6


@pytest.mark.parametrize("name", ["honest/rare_lobe_by_u0", "honest/azimuth_in_slices"])
def test_rare_lobes_and_seams_are_no_fault_of_a_pdf(name: str) -> None:
    assert _draws.jacobian(case(name), 45.0).value <= _draws.JACOBIAN_TOLERANCE


def test_a_sampler_that_clamps_is_wrong_at_an_end_only() -> None:
    mine = case("mutants/sampler_clamps_alpha")
    assert _draws.jacobian(mine, 45.0).value <= _draws.JACOBIAN_TOLERANCE
    low, *_, high = parameters.at_ends(mine)
    assert _draws.jacobian(*low).value > 1.0
    assert _draws.jacobian(*high).value <= _draws.JACOBIAN_TOLERANCE


def test_all_parameters_are_also_asked_at_their_ends_together() -> None:
    *_, lowest, highest = parameters.ends(case("mutants/brushed_in_one_corner"))
    assert tuple(lowest) == (0.0, 0.0) and tuple(highest) == (1.0, 1.0)


def test_energy_is_asked_where_the_sampler_does_not_draw() -> None:
    worst = next(iter(energy.claims(case("mutants/diffuse_never_drawn"))))
    assert worst.where["blend"] == 1.0


@pytest.mark.parametrize("value", [1e152, 1e160, 1e-200])
def test_squares_beyond_the_range_of_numbers_are_no_crash(value: float) -> None:
    means = [value * (1.0 + 0.1 * k) for k in range(16)]
    e = estimate([Moments(64.0, m, 64.0 * (0.1 * m) * m, 2.0 * m) for m in means])
    assert e.mean == pytest.approx(1.75 * value)
    assert e.effective_samples() >= 0.0 or math.isnan(e.effective_samples())
    assert estimate([Moments(64.0, value, -math.inf, 1.0), Moments(64.0, value, math.inf, 1.0)])
