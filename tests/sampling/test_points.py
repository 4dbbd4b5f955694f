"""Points have no state: they are functions of key and index, the same in Python and in kernels."""
from __future__ import annotations

import compiled_points as bulk
import numpy as np
import pytest

from montecarlo_brdf import bits
from montecarlo_brdf.sampling import points as sets

KEYS = [0, 1, 0x9E3779B97F4A7C15, (1 << 63) - 1, 1 << 63, (1 << 64) - 1]
#: index ranges: the start, and either side of where 32 bits end
STARTS = {"independent": [0, 1 << 20, (1 << 32) - 8, (1 << 40) + 3], "sobol": [0, (1 << 32) - 16]}


@pytest.mark.parametrize("name", sets.SETS)
@pytest.mark.parametrize("key", KEYS)
def test_compiled_points_equal_python_exactly(name: str, key: int) -> None:
    for start in STARTS.get(name, [0, 1000]):
        got = bulk.points(name, key, start, 16, 1 << 10)
        shape = bulk.shape_of(name, 1 << 10)
        expected = [getattr(sets, name)(key, start + i, shape) for i in range(16)]
        assert got.tolist() == [list(u) for u in expected]


@pytest.mark.parametrize("name", sets.SETS)
def test_any_order_gives_the_same_points(name: str) -> None:
    whole = bulk.points(name, 5, 0, 256)
    for start, count in ((0, 1), (17, 100), (255, 1)):
        part = bulk.points(name, 5, start, count, 256)
        assert np.array_equal(part, whole[start : start + count])


@pytest.mark.parametrize("name", sets.SETS)
def test_points_stay_in_the_unit_cube(name: str) -> None:
    u = bulk.points(name, 3, 0, 1 << 16)
    assert u.min() >= 0.0 and u.max() < 1.0


def test_keys_of_replicates_and_axes_are_distinct() -> None:
    """110,000 words: the chance of a collision among ideal ones is 3e-10."""
    keys = [sets.replicate_key(k, r) for k in (0, 1, 2, 1 << 63, 7 << 40) for r in range(20_000)]
    axes = [sets.axis_key(k, a) for k in keys[:2000] for a in range(5)]
    assert len({*keys, *axes}) == len(keys) + len(axes)


def test_neighbouring_replicates_differ_in_every_point() -> None:
    for name in sets.SETS:
        u, v = (bulk.points(name, sets.replicate_key(9, r), 0, 512) for r in (0, 1))
        assert not (u == v).any()


def test_mix64_is_splitmix64() -> None:
    """Published outputs for the seed 1234567."""
    expected = [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431]
    assert [bits.mix64(bits.u64(1234567 + i * bits.GOLDEN)) for i in range(1, 5)] == expected


def test_words() -> None:
    assert bits.u64(-1) == (1 << 64) - 1 and bits.u64(1 << 64) == 0
    assert bits.u32(-1) == (1 << 32) - 1 and bits.u32((1 << 32) + 5) == 5
    assert bits.reverse32(1) == 1 << 31 and bits.reverse32(0xF0) == 0x0F000000
    for word in (0, 1, 0x12345678, 0xFFFFFFFF):
        assert bits.reverse32(bits.reverse32(word)) == word
    for x in (0.0, 1.0, -2.5, 5e-324, 1.7976931348623157e308, float("inf")):
        assert bits.double_of(bits.word_of(x)) == x
    ordered = [0.0, 5e-324, 1e-310, 0.5, 1.0, 1e300, float("inf")]
    assert sorted(ordered, key=bits.word_of) == ordered
    assert bits.smaller(-1.0, 2.0) == bits.smaller(2.0, -1.0) == bits.smaller(-1.0, -1.0) == -1.0


def test_unit_fills_the_half_open_interval() -> None:
    assert bits.unit(0) == 0.0
    assert bits.unit((1 << 64) - 1) == 1.0 - 2.0**-52
    assert bits.unit(1 << 63) == 0.5
    assert bits.unit(1 << 12) == 2.0**-52
