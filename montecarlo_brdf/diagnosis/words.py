"""Names of factors: a constant, a word in the parameters, a product of cosines.

A ratio that is one constant at one place proves nothing; one that is the same constant, times the
same word, at every place stored does.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import Parameters
from montecarlo_brdf.diagnosis.geometry import (
    NAMES,
    NONE,
    SHAPES,
    Exponents,
    Geometry,
    monomial,
)

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

PI = math.pi
#: what multiplies -> what was done
MISTAKES = {
    PI: "1/pi is missing",
    1.0 / PI: "1/pi is applied twice",
    2.0: "a factor 2 too much",
    0.5: "a factor 2 too little",
    4.0: "a factor 4 too much: a 1/4 is missing",
    0.25: "a factor 4 too little: the 1/4 is applied twice",
    4.0 / PI: "pi stands where 4 belongs",
    PI / 4.0: "4 stands where pi belongs",
    2.0 * PI: "1/(2 pi) is missing",
    0.5 / PI: "1/(2 pi) is applied twice",
    4.0 * PI: "1/(4 pi) is missing",
    PI * PI: "1/pi^2 is missing",
}
FEWEST = 8  # values that a constant must show in
MOST = 0.9  # of the values that must agree: a few may lack a root, or lie beyond a branch
SHIFTS = (0, 1, 2, 8, 20)  # of exponents in normalisations


def mistake(c: float, tolerance: float = 2e-4) -> str | None:
    """What was done if something is c times what it should be."""
    return next((said for v, said in MISTAKES.items() if abs(c / v - 1.0) < tolerance), None)


def unnamed(c: float) -> float:
    """How far a constant is from the nearest one that has a name, or from 1."""
    return min(abs(c / v - 1.0) for v in (1.0, *MISTAKES))


class Word(NamedTuple):
    """A function of the parameters that has a name; a scale is one parameter by itself."""

    text: str = ""
    value: Callable[[Parameters], float] = lambda p: 1.0
    scale: bool = False

    @property
    def normalises(self) -> bool:
        """Whether it is a quotient, as normalisations are."""
        return "/(" in self.text


ONE = Word()


def vocabulary(names: Sequence[str]) -> Iterator[Word]:
    """p, p^2, 1/p, 1 - p, p q, (n + a)/(n + b), q (n + a)/(n + b)."""
    for k in names:
        yield Word(k, _mapped(k, lambda v: v), scale=True)
        yield Word(f"{k}^2", _mapped(k, lambda v: v * v))
        yield Word(f"1/{k}", _mapped(k, lambda v: _over(1.0, v)))
        yield Word(f"(1 - {k})", _mapped(k, lambda v: 1.0 - v))
        for a in (1, 2):
            yield Word(f"1/({k} + {a})", _mapped(k, _quotient(None, a)))
        for a, b in itertools.permutations(SHIFTS, 2):
            text, value = f"{_plus(k, a)}/{_plus(k, b)}", _mapped(k, _quotient(a, b))
            yield Word(text, value)
            for s in (s for s in names if s != k):
                yield Word(f"{s} {text}", _product(_mapped(s, lambda v: v), value))
    for a_, b_ in itertools.combinations(names, 2):
        yield Word(f"{a_} {b_}", _product(*(_mapped(k, lambda v: v) for k in (a_, b_))))


Value = Callable[[Parameters], float]


def _mapped(name: str, f: Callable[[float], float]) -> Value:
    return lambda p: f(float(getattr(p, name)))


def _product(one: Value, two: Value) -> Value:
    return lambda p: one(p) * two(p)


def _quotient(a: int | None, b: int) -> Callable[[float], float]:
    """(v + a)/(v + b), or 1/(v + b)."""
    return lambda v: _over(1.0 if a is None else v + a, v + b)


def _plus(name: str, shift: int) -> str:
    return f"({name} + {shift})" if shift else f"({name})"


def _over(a: float, b: float) -> float:
    return a / b if b else math.nan


class Factor(NamedTuple):
    """constant x word x monomial; or, if no word fits, one constant for each place."""

    constant: float
    word: Word = ONE
    exponents: Exponents = NONE
    each: tuple[float, ...] = ()  # one for each place, where no word tells

    @property
    def plain(self) -> bool:
        """Whether it is a constant alone."""
        return self.exponents == NONE and not self.word.text

    def at(self, g: Geometry, p: Parameters) -> Array:
        """Its values."""
        return self.constant * self.word.value(p) * monomial(g, self.exponents)

    def __str__(self) -> str:
        parts = [f"{self.constant:.6g}"] if abs(self.constant - 1.0) > 1e-5 else []
        parts += [self.word.text] if self.word.text else []
        cosines = zip(NAMES, self.exponents, strict=True)
        return " ".join([*parts, *(_power(n, x) for n, x in cosines if x)]) or "1"


def _power(name: str, x: int) -> str:
    return name if x == 1 else f"{name}^{x}"


def shape_said(e: Exponents) -> str:
    """'n.h is included, which does not belong, wo.h is missing'."""
    parts = []
    for sign, one, many in (
        (1, "is included, which does not belong", "are included, which do not belong"),
        (-1, "is missing", "are missing"),
    ):
        named = [_power(n, sign * x) for n, x in zip(NAMES, e, strict=True) if sign * x > 0]
        if named:
            parts.append(f"{' and '.join(named)} {one if len(named) == 1 else many}")
    return ", ".join(parts)


def constant(q: Array, tolerance: float, most: float = MOST) -> float | None:
    """The median of values if they agree."""
    q = q[np.isfinite(q) & (q > 0.0)]
    if len(q) < FEWEST:
        return None
    middle = float(np.median(q))
    agree = np.quantile(np.abs(q / middle - 1.0), most) < tolerance
    return middle if agree else None


def relation(
    cs: Sequence[float], sets: Sequence[Parameters], names: Sequence[str], tolerance: float
) -> tuple[float, Word] | None:
    """(constant, word) such that c = constant x word at all places: the best of those that fit,
    and whose constant has a name."""
    values = np.array(cs)
    if np.max(np.abs(values / values[0] - 1.0)) < tolerance:
        return float(values[0]), ONE
    best: tuple[float, float, Word] | None = None
    for word in vocabulary(names):
        with np.errstate(all="ignore"):
            r = values / np.array([word.value(p) for p in sets])
        if not np.all(np.isfinite(r) & (r > 0.0)):
            continue
        middle = float(np.median(r))
        spread = float(np.max(np.abs(r / middle - 1.0)))
        named = unnamed(middle) < max(tolerance, 1e-5)
        if spread < tolerance and (named or word.scale):
            free = word.scale and not named
            score = spread + (0.0 if free else unnamed(middle)) + 1e-7 * len(word.text)
            if best is None or score < best[0]:
                best = score, middle, word
    return best[1:] if best else None


#: of each place: a ratio and where it was taken
Ratios = Sequence[tuple["Array", Geometry]]


def factor(
    rows: Ratios, sets: Sequence[Parameters], names: Sequence[str], tolerance: float,
    most: float = MOST, shapes: Sequence[Exponents] = SHAPES,
) -> Factor | None:  # fmt: skip
    """The simplest factor that all ratios are: fewest cosines first."""
    for e in shapes:
        cs: list[float] = []
        for r, g in rows:
            c = constant(r / monomial(g, e), tolerance, most)
            if c is None:
                break
            cs.append(c)
        else:
            found = relation(cs, sets, names, 2.0 * tolerance)
            if found:
                return Factor(*found, e)
            if e == NONE:
                return Factor(math.nan, ONE, e, tuple(cs))
    return None
