"""Numbers as people type them: lists, ranges, powers of two, colours."""
from __future__ import annotations

import itertools
import math
import secrets
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import click

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.model import Model

MOST_VALUES = 10_000
MOST_DIGITS = 400  # of a number: more than any double has


def number(text: str, what: str) -> float:
    """A finite number, or a UserError."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise UserError(f"{what} must be a finite number, not {text!r}")
    return value


def whole(text: str) -> int | None:
    """The whole number that plain decimal digits stand for, or None."""
    return int(text) if text.isascii() and text.isdigit() and len(text) <= MOST_DIGITS else None


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
    n = whole(count_text.removeprefix("log"))
    if n is None or not 2 <= n <= MOST_VALUES:
        raise UserError(
            f"{what} range {text!r} must be first:last:count or first:last:logcount "
            f"with a count from 2 to {MOST_VALUES}"
        )
    a, b = number(first, what), number(last, what)
    if logarithmic and not (a > 0.0 and b > 0.0):
        raise UserError(f"{what} range {text!r} needs positive ends to be logarithmic")
    steps = [k / (n - 1) for k in range(n)]
    if logarithmic:
        return [a * (b / a) ** t for t in steps]
    return [a + (b - a) * t for t in steps]


class Whole(click.ParamType):
    """A whole number, also written 2^20, 1e6 or 1_000_000."""

    name = "number"

    def convert(
        self, value: str | int, param: click.Parameter | None, ctx: click.Context | None
    ) -> int:
        """The number; its range is checked where it is used."""
        if isinstance(value, int):
            return value
        number = _whole_of(value.replace("_", ""))
        if number is None:
            self.fail(f"{value!r} is not a whole number (write 65536, 2^16 or 1e6)", param, ctx)
        return number


def _whole_of(text: str) -> int | None:
    base, _, power = text.partition("^")
    if power:
        b, p = whole(base), whole(power)
        return b**p if b is not None and p is not None and b < 1 << 64 and p <= 64 else None
    try:
        value = float(text)
    except ValueError:
        return None
    exact = whole(text.removeprefix("-"))
    if exact is not None:
        return -exact if text.startswith("-") else exact
    return int(value) if value.is_integer() else None


def read_seed(text: str, what: str) -> int:
    """A seed, drawn and told if it is 'random', or a UserError."""
    if text == "random":
        drawn = secrets.randbits(32)
        click.echo(f"seed {drawn}", err=True)
        return drawn
    found = whole(text)
    if found is None or found >= 1 << 64:
        allowed = "a whole number from 0 to 2^64 - 1, or random"
        raise UserError(f"{what} must be {allowed}, not {text!r}")
    return found


def listed(text: str, what: str) -> str | list[str]:
    """'all', or names separated by commas; whether they exist is checked where they are used."""
    return text if text == "all" else [name.strip() for name in text.split(",")]


class Read(click.ParamType):
    """What a function makes of a text; it gets the option's name for its complaint."""

    name = "text"

    def __init__(self, function: Callable[[str, str], Any]) -> None:
        self._function = function

    def convert(self, value: Any, param: click.Parameter | None, ctx: object) -> Any:
        """The value; its range is checked where it is used."""
        what = max(param.opts, key=len).lstrip("-") if param else ""
        return self._function(value, what) if isinstance(value, str) else value


class Number(click.ParamType):
    """A finite number; its range, here only told, is checked where it is used."""

    name = "number"

    def __init__(self, allowed: str = "that is finite") -> None:
        self.allowed = allowed

    def convert(
        self, value: str | float, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """The number."""
        try:
            return number(str(value), "")
        except UserError:
            self.fail(f"{value!r} is not a number {self.allowed}", param, ctx)


def parameter_sets(model: Model, assignments: Sequence[str]) -> list[Any]:
    """All combinations of -p name=value: lists and ranges make cases, a/b/c makes a colour."""
    listed = axes(assignments, lambda name: model)
    rows: Iterable[tuple[Any, ...]] = itertools.product(*listed.values())
    return [model.parameters(**dict(zip(listed, row, strict=True))) for row in rows]


def axes(assignments: Sequence[str], owner: Callable[[str], Model]) -> dict[str, list[Any]]:
    """The values of every name assigned; `owner` says which model a name belongs to."""
    found: dict[str, list[Any]] = {}
    for assignment in assignments:
        name, values = _axis(owner(assignment.partition("=")[0].strip()), assignment)
        if name in found:
            raise UserError(f"-p {name} is given twice: write -p {name}=a,b for both values")
        found[name] = values
    count = math.prod(map(len, found.values()))
    if count > MOST_VALUES:
        raise UserError(f"{count} parameter sets are more than the {MOST_VALUES} allowed")
    return found


def _axis(model: Model, assignment: str) -> tuple[str, list[Any]]:
    name, equals, text = assignment.partition("=")
    name = name.strip()
    if not equals or not text:
        raise UserError(f"-p takes name=value, not {assignment!r}")
    if name in model.choices:
        return name, text.split(",")
    return name, values_of(name, text)


Value = str | float | tuple[str, ...]


def values_of(name: str, text: str) -> list[Value]:
    """Values as the model will check them: it knows what is allowed and says so."""
    found: list[Value] = []
    for part in map(str.strip, text.split(",")):
        if ":" in part:
            found += _range(part, name)
        else:
            found.append(tuple(part.split("/")) if "/" in part else part)
    return found


def models_of(spec: str) -> list[str]:
    """'all', or names separated by commas."""
    from montecarlo_brdf import loading

    found = listed(spec, "model")
    return loading.names() if isinstance(found, str) else found
