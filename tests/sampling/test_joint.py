"""Coordinates that do not share a grid or a net are independent of each other, also in one
replicate."""
from __future__ import annotations

import itertools

import compiled_points as bulk
import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.sampling import points
from montecarlo_brdf.sampling.points import replicate_key

TOGETHER = {(0, 1), (2, 3)}
PAIRS = [pair for pair in itertools.combinations(range(5), 2) if pair not in TOGETHER]
REPLICATES = 100


def crowding(u: np.ndarray, parts: int) -> float:
    """Pearson's chi-square per degree of freedom of pairs in parts x parts boxes, given that each
    coordinate is stratified: 1 for a random order."""
    boxes = np.floor(u * parts).astype(int) @ (parts, 1)
    expected = len(u) / parts**2
    spread = np.sum((np.bincount(boxes, minlength=parts**2) - expected) ** 2 / expected)
    return float(spread / (parts - 1) ** 2)


@pytest.mark.parametrize("name", ["stratified", "sobol"])
@pytest.mark.parametrize("pair", PAIRS)
def test_pairs_fill_the_square(name: str, pair: tuple[int, int]) -> None:
    """Orders by nested scrambling from the highest bit, as stratified sets had, gave 1024/9."""
    found = [
        crowding(bulk.points(name, replicate_key(9, r), 0, 1024)[:, pair], 4)
        for r in range(REPLICATES)
    ]
    assert np.mean(found) < 1.6 and max(found) < 6.0


@pytest.mark.parametrize("bits", range(13))
def test_an_order_is_a_permutation(bits: int) -> None:
    size = 1 << bits
    shape = points.grid(size)
    for key, axis in ((1, 2), (2**64 - 1, 4), (77, 4)):
        order = [points.shuffled(key, i, axis, shape) for i in range(size)]
        assert sorted(order) == list(range(size))


def test_a_choice_of_lobes_is_as_precise_as_with_independent_points() -> None:
    """The choice once went with the first coordinate: twice the error of independent points."""
    model = mb.load("0.5 lambert + 0.4 phong")
    case = model, model.parameters(), 45.0
    one, other = (
        mb.directional_albedo(*case, sampler="own", points=p, samples=1 << 16)
        for p in ("stratified", "independent")
    )
    assert one.stderr < 0.8 * other.stderr
