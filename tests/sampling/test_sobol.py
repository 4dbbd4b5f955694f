"""Sobol points are nets: every elementary interval of the right size holds exactly one of them."""
from __future__ import annotations

import compiled_points as bulk
import numpy as np
import pytest
from scipy import stats

from montecarlo_brdf.bits import reverse32, u32
from montecarlo_brdf.sampling import points as module

PAIRS = [(0, 1), (2, 3)]


def is_net(x: np.ndarray, y: np.ndarray) -> bool:
    """Whether all 2^m points lie alone in their box, for all m + 1 shapes of boxes of area 2^-m."""
    m = x.size.bit_length() - 1
    for a in range(m + 1):
        box = np.floor(x * (1 << a)) * (1 << (m - a)) + np.floor(y * (1 << (m - a)))
        if np.unique(box).size != x.size:
            return False
    return True


@pytest.mark.parametrize("key", [0, 1, 12345, 1 << 63, (1 << 64) - 1])
@pytest.mark.parametrize("m", [0, 1, 2, 3, 5, 8, 12, 16])
@pytest.mark.parametrize("pair", PAIRS)
def test_net(key: int, m: int, pair: tuple[int, int]) -> None:
    for block in (0, 1, 6):
        u = bulk.points("sobol", key, block << m, 1 << m)
        assert is_net(u[:, pair[0]], u[:, pair[1]])


@pytest.mark.parametrize("axis", range(5))
def test_each_coordinate_is_stratified(axis: int) -> None:
    u = bulk.points("sobol", 77, 0, 1 << 14)[:, axis]
    assert np.array_equal(np.sort(np.floor(u * (1 << 14))), np.arange(1 << 14))


def left_shifts(x: int) -> int:
    """`pascal_reversed` with its shifts the wrong way: right marginals, wrong net."""
    x = x ^ u32(x << 16)
    x = x ^ (u32(x << 8) & 0xFF00FF00)
    x = x ^ (u32(x << 4) & 0xF0F0F0F0)
    x = x ^ (u32(x << 2) & 0xCCCCCCCC)
    return x ^ (u32(x << 1) & 0xAAAAAAAA)


def test_the_net_test_sees_wrong_shifts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "pascal_reversed", left_shifts)
    u = np.array([module.sobol(1, i) for i in range(256)])
    assert not is_net(u[:, 0], u[:, 1]) and not is_net(u[:, 2], u[:, 3])


def test_independent_points_are_no_net() -> None:
    u = bulk.points("independent", 1, 0, 256)
    assert not is_net(u[:, 0], u[:, 1])


def test_unscrambled_points_are_those_of_scipy() -> None:
    """scipy runs through the same points in Gray code order."""
    expected = stats.qmc.Sobol(d=2, scramble=False, bits=32).random_base2(10)
    for i, point in enumerate(expected):
        gray = i ^ (i >> 1)
        words = reverse32(gray), reverse32(u32(module.pascal_reversed(gray)))
        assert [w / 2.0**32 for w in words] == point.tolist()


@pytest.mark.parametrize("index", [0, 1, 1000])
def test_scrambling_makes_each_point_uniform(index: int) -> None:
    """Over 2^14 keys, chi^2 of single coordinates and of pairs; 15 tests at 1e-7 each and index."""
    u = np.concatenate([bulk.points("sobol", k * 0x9E3779B97F4A7C15 % 2**64, index, 1, 4096)
                        for k in range(1 << 14)])  # fmt: skip
    cells = np.floor(u * 16).astype(int)
    for a in range(5):
        assert stats.chisquare(np.bincount(cells[:, a], minlength=16)).pvalue > 1e-7
        for b in range(a):
            joint = np.bincount(16 * cells[:, a] + cells[:, b], minlength=256)
            assert stats.chisquare(joint).pvalue > 1e-7


def test_two_points_of_one_set_are_scrambled_together() -> None:
    """Points 0 and 1 share no half, whatever the key: scrambling flips both or neither."""
    u = np.concatenate([bulk.points("sobol", k, 0, 2) for k in range(200)]).reshape(200, 2, 5)
    halves = np.floor(2 * u)
    assert (halves[:, 0, :4] != halves[:, 1, :4]).all()
