"""Numbers as people type them: lists, ranges, powers of two, colours."""
from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Any

import click

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.model import Model

MOST_VALUES = 10_000


def number(text: str, what: str) -> float:
    """A finite number, or a UserError."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise UserError(f"{what} must be a finite number, not {text!r}")
    return value


def numbers(text: str, what: str) -> list[float]:
    """'0,30,60' or 'first:last:count' or 'first:last:logcount', in any combination."""
    found: list[float] = []
    for part in text.split(","):
        found += _range(part.strip(), what) if ":" in part else [number(part.strip(), what)]
    return found


def _range(text: str, what: str) -> list[float]:
    first, _, rest = text.partition(":")
    last, _, count_text = rest.partition(":")
    logarithmic = count_text.startswith("log")
    count = count_text.removeprefix("log")
    if not count.isdigit() or not 2 <= int(count) <= MOST_VALUES:
        raise UserError(f"{what} range {text!r} must be first:last:count or first:last:logcount")
    a, b, n = number(first, what), number(last, what), int(count)
    if logarithmic and not (a > 0.0 and b > 0.0):
        raise UserError(f"{what} range {text!r} needs positive ends to be logarithmic")
    steps = [k / (n - 1) for k in range(n)]
    if logarithmic:
        return [a * (b / a) ** t for t in steps]
    return [a + (b - a) * t for t in steps]


class Whole(click.ParamType):
    """A whole number, also written 2^20, 1e6 or 1_000_000."""

    name = "number"

    def convert(self, value: Any, param: Any, ctx: Any) -> int:
        """The number; its range is checked where it is used."""
        if isinstance(value, int):
            return value
        text = str(value).replace("_", "")
        base, _, power = text.partition("^")
        try:
            result = int(base) ** int(power) if power else float(text) if "e" in text.lower() else int(text)
            if result == int(result):
                return int(result)
        except (ValueError, OverflowError):
            pass
        self.fail(f"{value!r} is not a whole number (write 65536, 2^16 or 1e6)", param, ctx)


def parameter_sets(model: Model, assignments: Sequence[str]) -> list[Any]:
    """All combinations of -p name=value: lists and ranges make cases, a/b/c makes a colour."""
    axes = [_axis(model, a) for a in assignments]
    count = math.prod(len(values) for _, values in axes)
    if count > MOST_VALUES:
        raise UserError(f"{count} parameter sets are more than the {MOST_VALUES} allowed")
    names = [name for name, _ in axes]
    rows: Iterable[tuple[Any, ...]] = itertools.product(*(values for _, values in axes))
    return [model.parameters(**dict(zip(names, row, strict=True))) for row in rows]


def _axis(model: Model, assignment: str) -> tuple[str, list[Any]]:
    name, equals, text = assignment.partition("=")
    name = name.strip()
    if not equals or not text:
        raise UserError(f"-p takes name=value, not {assignment!r}")
    if name in model.choices:
        return name, text.split(",")
    if "/" in text:
        return name, [tuple(number(v, name) for v in one.split("/")) for one in text.split(",")]
    return name, numbers(text, name)
