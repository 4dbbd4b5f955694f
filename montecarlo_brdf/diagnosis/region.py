"""Where values are at fault: a region that parts bad points from good ones exactly.

Asked of the points that all checks look at (cases.look): where none of tens of thousands
contradicts, the region is told as a cause; where it only leans to one side, as a place.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import search_range
from montecarlo_brdf.cases.look import Look
from montecarlo_brdf.diagnosis.geometry import Geometry, geometry

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

    Flags = Any

NEAR = 1e-7  # of a special place: directions that differ by ulps are there
SAME = 1e-12
SOME = 0.02  # share of a special place that is bad at least: rounding decides there
FEWEST = 4  # bad points that show a threshold
GRAZING = 0.3  # cosine
INNER = 0.9999  # of cosines: at the ends of their range special places tell
ZERO = 0.01  # cosine: a threshold at 0, where a root or power is of a negative number


class Region(NamedTuple):
    """Where, and whether every point there is bad."""

    where: str
    whole: bool

    def __str__(self) -> str:
        return self.where if self.whole else f"{self.where}, for some pairs"


def region(at: Look, bad: Flags, names: list[str], of_wo: bool = False) -> Region | None:
    """The region that holds all bad points and, but for special places, no good one.

    names: of parameters that may tell; of_wo: values that depend on wo and parameters alone.
    """
    if not bad.any() or bad.all():
        return Region("everywhere", True) if bad.all() else None
    g = geometry(at.points.wo, at.points.wi)
    within, said = np.ones(len(bad), dtype=bool), list[str]()
    for places in (_directions(g, of_wo), _of_parameters(at, names)):
        for name, inside in places:
            narrower = (within & ~inside).any() and not bad[within].all()
            if narrower and not (bad & ~inside).any():
                within = within & inside
                said.append(name)
                break
    if said and bad[within].mean() > SOME:
        return Region(" and ".join(said), bool(bad[within].all()))
    return _threshold(at, g, bad, names, of_wo)


def _directions(g: Geometry, of_wo: bool) -> Iterator[tuple[str, Flags]]:
    """Directions that code treats apart."""
    yield "wo is the normal (normal incidence)", _normal(g.wo)
    if not of_wo:
        yield "wi is the normal (normal incidence)", _normal(g.wi)
        either = _normal(g.wo) | _normal(g.wi)
        yield "wo or wi is the normal (normal incidence)", either
        yield "wi = wo", np.linalg.norm(g.wo - g.wi, axis=1) < NEAR
        yield "x is 0", np.minimum(abs(g.wo[:, 0]), abs(g.wi[:, 0])) < SAME
        mirror = g.wo * np.array([-1.0, -1.0, 1.0])
        yield "wi is wo's mirror direction", np.linalg.norm(mirror - g.wi, axis=1) < NEAR


def _normal(w: Array) -> Flags:
    return np.hypot(w[:, 0], w[:, 1]) < NEAR


def _of_parameters(at: Look, names: list[str]) -> Iterator[tuple[str, Flags]]:
    """Ends of ranges, 0 and 1, equal parameters."""
    fields = at.case.one._fields
    columns = {n: at.points.table[:, fields.index(n)] for n in names}
    for n, v in columns.items():
        ends = search_range(at.model, n) or ()
        for value in dict.fromkeys((*ends, 0.0, 1.0)):
            inside = abs(v - value) < SAME * max(1.0, abs(value))
            if inside.any() and not inside.all():
                end = " (an end of its range)" if value in ends else ""
                yield f"{n} = {value:g}{end}", inside
    for a, b in itertools.combinations(names, 2):
        inside = abs(columns[a] - columns[b]) < SAME
        if inside.any() and not inside.all():
            yield f"{a} = {b}", inside


def _threshold(
    at: Look, g: Geometry, bad: Flags, names: list[str], of_wo: bool
) -> Region | None:
    """One quantity that is smaller for all bad points than for all good ones, or larger."""
    if bad.sum() < FEWEST:
        return None
    for name, v in _quantities(at, g, names, of_wo):
        for sign, words in ((1.0, "<"), (-1.0, ">")):
            inside, outside = (sign * v[bad]).max(), (sign * v[~bad]).min()
            t = 0.5 * sign * (inside + outside)
            if inside < outside and (name in names or abs(t) < INNER):
                return Region(f"{name} {words} {t:.3g}{_remark(name, t, words)}", True)
    return None


MIRROR = "cos of wi and the mirror direction"
COSINES = ("cos_i", "cos_o", "the smaller cosine", "the larger cosine")


def _quantities(
    at: Look, g: Geometry, names: list[str], of_wo: bool
) -> Iterator[tuple[str, Array]]:
    yield "cos_o", g.cos_o
    if not of_wo:
        yield "cos_i", g.cos_i
        yield "the smaller cosine", np.minimum(g.cos_i, g.cos_o)
        yield "the larger cosine", np.maximum(g.cos_i, g.cos_o)
        yield "wo.wi", np.sum(g.wo * g.wi, axis=1)
        yield "n.h", g.normal_half
        yield "wo.h", g.out_half
        flat = g.wo[:, 0] * g.wi[:, 0] + g.wo[:, 1] * g.wi[:, 1]
        yield MIRROR, g.cos_i * g.cos_o - flat
        yield "sin_o sin_i cos(phi_o - phi_i)", flat
    for n in names:
        yield n, at.points.table[:, at.case.one._fields.index(n)]


def _remark(name: str, t: float, words: str) -> str:
    if name in COSINES and words == "<" and t < GRAZING:
        return " (towards grazing)"
    if name in (MIRROR, "wo.wi") and words == "<" and abs(t) <= ZERO:
        return ": root or power of a negative number"
    return ""


def leaning(at: Look, bad: Flags) -> str:
    """Where bad points lie, if a cosine says that and no more."""
    for name, v in (
        ("both cosines are", np.maximum(at.points.wo[:, 2], at.points.wi[:, 2])),
        ("one cosine is", np.minimum(at.points.wo[:, 2], at.points.wi[:, 2])),
    ):
        t = float(v[bad].max())
        if t < GRAZING:
            return f"only where {name} below {t:.3g} (towards grazing), not everywhere there"
    return ""


