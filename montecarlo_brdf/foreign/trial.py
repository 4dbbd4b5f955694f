"""A translated text run at a few places: whether it returns at all, and whether it has colours."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Iterator
from typing import Any

from montecarlo_brdf.foreign.members import CHANNEL

WO, WI, U = (0.6, 0.0, 0.8), (-0.28, 0.45, 0.8480566018), (0.3, 0.6, 0.4)
PLACES = 24


def functions(text: str) -> dict[str, Any]:
    """What a model file's text defines."""
    space: dict[str, Any] = {"__name__": "shader"}
    exec(compile(text, "<shader>", "exec"), space)  # noqa: S102
    return space


def call(space: dict[str, Any]) -> None:
    """Call every function once: an endless loop is better met here than in a kernel."""
    for name, second in (("f", WI), ("pdf", WI), ("sample", U)):
        if name in space:
            _value(space, name, WO, second, _defaults(space))


def is_grey(space: dict[str, Any]) -> bool:
    """Whether f has the same value in every channel, wherever one looks."""
    return all(len({repr(x) for x in channels}) == 1 for channels in _values(space))


def _values(space: dict[str, Any]) -> Iterator[list[Any]]:
    """f in three channels at places and parameters of any kind."""
    chosen = random.Random(1)
    for _ in range(PLACES):
        wo, wi = _direction(chosen), _direction(chosen)
        p = _defaults(space)
        varied = {n: chosen.uniform(*space.get("domain", {}).get(n, (0.0, 1.0))) for n in p._fields}
        sets = [p._replace(**{**varied, CHANNEL: float(k)}) for k in range(3)]
        yield [_value(space, "f", wo, wi, one) for one in sets]


def _direction(chosen: random.Random) -> tuple[float, float, float]:
    x, y = chosen.uniform(-0.6, 0.6), chosen.uniform(-0.6, 0.6)
    return x, y, float((1.0 - x * x - y * y) ** 0.5)


def _defaults(space: dict[str, Any]) -> Any:
    p = space["Params"]()
    return p._replace(**{CHANNEL: 0.0}) if CHANNEL in p._fields else p


def _value(space: dict[str, Any], name: str, *arguments: Any) -> Any:
    """NaN where Python raises what compiled arithmetic does not."""
    with contextlib.suppress(ZeroDivisionError, OverflowError, ValueError):
        return space[name](*arguments)
    return "NaN"
