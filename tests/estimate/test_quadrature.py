"""What a quadrature in coordinates of the mirror direction misses, and probes show."""

from __future__ import annotations

import math

import numpy as np
import pytest

from montecarlo_brdf.estimate.quadrature import Coordinates, integrate
from montecarlo_brdf.vectors import from_degrees


@pytest.mark.parametrize("seed", range(8))  # its shares: 1000 draws, 0.1 is three of their errors
def test_of_two_equal_needles_the_one_that_nodes_do_not_see_is_the_error(seed: int) -> None:
    """Its values are no higher than theirs, but far above those of the nodes around it."""
    wo, width = np.array(from_degrees(45.0)), 1e-3
    mirror = wo * np.array([-1.0, -1.0, 1.0])

    def needles(w: object) -> object:
        return sum(
            np.exp(-0.5 * np.sum((w - c) ** 2, axis=1) / width**2) / (2.0 * math.pi * width**2)
            for c in (wo, mirror)
        )

    rng = np.random.default_rng(seed)
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
