"""What decides at a place of the code: the margin passes 0 where the code turns, or fails."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from montecarlo_brdf.arithmetic.batch import Widened
from montecarlo_brdf.arithmetic.recording import MARGINS, OFTEN, Tape, recording

#: operation -> operands, and whether the margin is above 0, 0, below
TURNS: dict[str, tuple[tuple[Any, ...], list[float]]] = {
    "less": (([3.0, 2.0, 1.0], 2.0), [1.0, 0.0, -1.0]),
    "equal": (([3.0, 2.0, 1.0], 2.0), [1.0, 0.0, -1.0]),
    "true_divide": ((1.0, [0.5, 0.0, -0.5]), [0.5, 0.0, -0.5]),
    "sqrt": (([0.5, 0.0, -0.5],), [0.5, 0.0, -0.5]),
    "log": (([0.5, 0.0, -0.5],), [0.5, 0.0, -0.5]),
    "log1p": (([0.0, -1.0, -1.5],), [1.0, 0.0, -0.5]),
    "arccos": (([0.5, 1.0, -1.5],), [0.5, 0.0, -0.5]),
    "floor": (([1.25, 1.0, 0.75],), [0.25, 0.0, -0.25]),
    "absolute": (([2.0, 0.0, -2.0],), [2.0, 0.0, -2.0]),
}


def run(tape: Tape, points: int, code: Callable[[dict[str, Any]], Any]) -> Any:
    """Code on a tape, for so many points at once."""
    arithmetic = recording(tape)
    tape.begin(points)
    tape.watch(np.arange(points))
    with np.errstate(all="ignore"):
        return code(arithmetic.functions)


@pytest.mark.parametrize("name", TURNS)
def test_the_margin_passes_0_where_an_operation_turns(name: str) -> None:
    operands, due = TURNS[name]
    arrays = [np.asarray(x) for x in operands]
    tape = Tape(10)
    value = run(tape, 3, lambda g: g[name](*arrays))
    with np.errstate(all="ignore"):
        assert np.array_equal(value, getattr(np, name)(*arrays), equal_nan=True)
    (margin,) = tape.margins.values()
    assert list(margin) == due


def test_every_operation_that_turns_gives_what_numpy_gives() -> None:
    x, y = np.array([0.25, -0.5, 2.0]), np.array([0.5, 0.25, 2.0])
    for name in MARGINS:
        operation = getattr(np, name)
        operands = (x, y)[: operation.nin]
        found = run(Tape(10), 3, lambda g, n=name, a=operands: g[n](*a))
        with np.errstate(all="ignore"):
            assert np.array_equal(found, operation(*operands), equal_nan=True)


def test_the_first_times_of_a_loop_are_told_apart_and_the_nearest_of_the_rest_kept() -> None:
    values = [5.0, 4.0, 3.0, 6.0, 2.0, 7.0]

    def loop(functions: dict[str, Any]) -> None:
        for value in values:
            functions["sqrt"](np.full(2, value))

    tape = Tape(100)
    run(tape, 2, loop)
    found = {site.time: margin[0] for site, margin in tape.margins.items()}
    assert OFTEN == 4 and found == {0: 5.0, 1: 4.0, 2: 3.0, 3: 2.0}


def test_what_all_points_share_is_no_margin() -> None:
    tape = Tape(10)
    run(tape, 2, lambda g: g["sqrt"](2.0))
    assert tape.margins == {}


def test_code_of_too_many_operations_is_given_up() -> None:
    tape = Tape(3)
    run(tape, 2, lambda g: [g["sqrt"](np.ones(2)) for _ in range(4)])
    with pytest.raises(Widened):
        tape.watch(np.arange(2))
