"""Tables that `prepare` makes: arrays as they are, long tuples as arrays, for colours too."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.compile.layout import Grid, numbers_of, pack, shape_of
from montecarlo_brdf.estimate.places import Pointwise

#: Lambert whose albedo is looked up: the entry of a column is its number times that of the row
TABLES = """
import math
from typing import NamedTuple

import numpy as np

class Params(NamedTuple):
    albedo: float = 0.8

class Prepared(NamedTuple):
    table: object
    line: tuple
    k: float

def prepare(p):
    rows = np.outer(np.full(3, p.albedo), np.arange(1.0, 5.0)) / math.pi
    return Prepared(rows, tuple(0.25 * j for j in range(1, 201)), p.albedo)

def f(wo, wi, p):
    j = min(3, int(4.0 * wi[2] * wo[2]))
    return p.table[1, j] * p.line[3] * len(p.line) / 200.0 / (j + 1) + 0.0 * p.k
"""


def test_an_array_and_a_long_tuple_are_looked_up(user_file: Callable[[str], Any]) -> None:
    model = mb.load(str(user_file(TABLES)))
    rng = np.random.default_rng(1)
    wo, wi = np.array((0.6, 0.0, 0.8)), rng.normal(size=(500, 3))
    wi = np.abs(wi / np.linalg.norm(wi, axis=1)[:, None])
    for albedo in (0.3, 0.8):
        values = Pointwise(model, model.parameters(albedo=albedo)).f(wo, wi)
        assert values == pytest.approx(albedo / np.pi, rel=1e-14)
    colour = mb.furnace(model, model.parameters(albedo=(0.2, 0.5, 0.5)), 30.0, samples=1 << 14)
    found = [f.value for f in colour.results[0].findings if f.quantity == "A"]
    assert found == pytest.approx([0.2, 0.5, 0.5], rel=1e-3)


def test_numbers_of_a_table_stand_side_by_side() -> None:
    one, other = (np.arange(6.0).reshape(2, 3), 7.0), (np.arange(6.0).reshape(2, 3) + 1.0, 7.0)
    assert shape_of(one) == (tuple, (Grid((2, 3)), None))
    layout, numbers = pack([one, other], 4)
    assert numbers == [*range(6), *range(1, 7), 7.0]
    assert layout.places == ((*range(4, 10), 16), (*range(10, 16), 16))
    assert list(numbers_of(one)) == [*range(6), 7.0]


def test_digits_of_a_table_in_a_file(user_file: Callable[[str], Any]) -> None:
    """Single and half precision look up what the table has in these."""
    text = "import numpy as np\nT = np.full((4, 4), 0.1)\n"
    text += "def f(wo, wi, p):\n    return T[int(3.0 * wi[2]), 2] * 3.0\n"
    report = mb.stress(mb.load(str(user_file(text))), quick=True)
    assert report.verdict == "pass"
