"""Peaks are found wherever they are, and errors are what they are said to be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from montecarlo_brdf.estimate.mesh import Probes
from montecarlo_brdf.estimate.quadrature import integrate, parts, star
from montecarlo_brdf.estimate.regions import Around, Coordinates
from montecarlo_brdf.vectors import from_degrees

UP = (0.0, 0.0, 1.0)


class Needles:
    """Lobes of one width that hold 1 each, far from the horizon."""

    def __init__(self, width: float, *centres: tuple[float, ...]) -> None:
        self.width, self.centres = width, [np.array(c) for c in centres]

    def __call__(self, w: np.ndarray) -> np.ndarray:
        square = 2.0 * self.width**2
        away = (np.sum((w - c) ** 2, axis=1) for c in self.centres)
        return sum(np.exp(-d / square) / (math.pi * square) for d in away)

    def drawn(self, count: int, seed: int) -> Probes:
        """Draws from them, with the solid angle that each stands for."""
        rng = np.random.default_rng(seed)
        draws = [c + self.width * rng.normal(size=(count, 3)) for c in self.centres]
        w = np.concatenate(draws)
        w /= np.linalg.norm(w, axis=1)[:, None]
        return w, len(self.centres) / (len(w) * self(w))


@pytest.mark.parametrize("width", [1e-2, 1e-4])
@pytest.mark.parametrize("seed", range(4))
def test_a_needle_that_no_node_sees_is_found_by_draws(width: float, seed: int) -> None:
    """One at the mirror direction, which the chart resolves, one at wo, one anywhere."""
    wo = from_degrees(45.0)
    needles = Needles(width, wo, (-wo[0], -wo[1], wo[2]), from_degrees(20.0, 110.0))
    value, error = integrate(needles, Coordinates(wo), 1e-6, [needles.drawn(300, seed)], seed)
    assert error < 2e-5
    assert value == pytest.approx(3.0, abs=error + 5.0 * width**2)  # of the sphere's curvature


@pytest.mark.parametrize("width", [1e-1, 1e-3, 1e-5])
def test_a_star_sees_a_needle_of_any_width(width: float) -> None:
    centre = from_degrees(33.0, 77.0)
    needle, chart = Needles(width, centre), Coordinates(from_degrees(60.0))
    value, error = integrate(needle, chart, 1e-6, [star(centre)])
    assert value == pytest.approx(1.0, abs=error + 2.0 * width**2) and error < 2e-5


def test_parts_of_a_needle_hold_no_more_than_their_share() -> None:
    """And add up to the integral; the tree finds each cell by its middle."""
    centre, share = from_degrees(20.0, 110.0), 0.01
    needle, chart = Needles(1e-3, centre), Coordinates(from_degrees(60.0))
    found = parts(needle, chart, 1e-6, [star(centre)], share)
    assert found.value.sum() == pytest.approx(1.0, abs=found.error + 1e-5)
    assert found.value.max() < 1.01 * share
    middle = found.low + 0.5 * found.size
    for place, node in list(zip(middle, found.node, strict=True))[::7]:
        at = 0
        while found.nodes[at, 0] >= 0.0:
            side, edge, below, above = found.nodes[at]
            at = int(below if place[int(side)] < edge else above)
        assert at == node


def test_what_probes_see_and_cells_do_not_is_the_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no cell may be cut."""
    monkeypatch.setattr("montecarlo_brdf.estimate.mesh.MOST_CELLS", 1)
    needle = Needles(1e-4, from_degrees(20.0, 110.0))
    value, error = integrate(needle, Coordinates(UP), probes=[needle.drawn(1000, 0)])
    assert abs(value) < 0.5 and error == pytest.approx(1.0, abs=0.1)


CAP = from_degrees(50.0)


def one(w: np.ndarray) -> np.ndarray:
    return np.ones(len(w))


CASES = {
    "smooth": (lambda w: w[:, 2] ** 3, Coordinates(UP), math.pi / 2.0),
    "kink": (lambda w: np.abs(w[:, 0]), Coordinates(from_degrees(70.0)), math.pi),
    "step": (lambda w: 1.0 * (w[:, 0] + w[:, 1] > 0.0), Coordinates(CAP), math.pi),
    "root": (lambda w: 1.0 / np.sqrt(w[:, 2]), Coordinates(UP), 4.0 * math.pi),
    "cap": (one, Around(CAP, 0.3), 4.0 * math.pi * math.sin(0.15) ** 2),
    "steep": (lambda w: w[:, 2] ** -0.8, Coordinates(UP), 10.0 * math.pi),
    "half a cap": (one, Around((1.0, 0.0, 0.0), 1e-3), 2.0 * math.pi * math.sin(5e-4) ** 2),
}


@pytest.mark.parametrize("name", CASES)
def test_the_error_holds_the_truth(name: str) -> None:
    """For 8 seeds; an interval of one in 10^9 is 6 standard errors and more."""
    function, chart, truth = CASES[name]
    found = [integrate(function, chart, seed=seed) for seed in range(8)]
    assert all(abs(value - truth) <= error + 1e-12 * truth for value, error in found)
    assert max(error for _, error in found) < 3e-5 * truth


@pytest.mark.parametrize("scale", [1e-200, 1e160, math.inf, math.nan])
def test_values_whose_squares_are_no_numbers(scale: float) -> None:
    """With steps, for which spreads are looked at cell by cell."""

    def step(w: np.ndarray) -> np.ndarray:
        return scale * (w[:, 0] > 0.1)

    value, error = integrate(step, Coordinates(UP))
    same = integrate(lambda w: 1.0 * (w[:, 0] > 0.1), Coordinates(UP))
    if math.isfinite(scale):
        assert value / scale == pytest.approx(same.value) and error < 1e-4 * value
    else:
        assert error == math.inf


def test_an_integral_that_is_zero() -> None:
    """Of an odd step, of which no cell holds half."""
    value, error = integrate(lambda w: np.sign(w[:, 0] + 0.3 * w[:, 1]), Coordinates(UP))
    assert abs(value) <= error < 0.1
