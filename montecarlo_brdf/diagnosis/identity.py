"""What f is, when it is not what it says: a known model up to a factor, at all nodes of all places.

Nothing else but a declared model or albedo can tell a factor of f: A = 1.56 alone is no proof of
pi/2.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.diagnosis import known
from montecarlo_brdf.diagnosis.geometry import NONE, SHAPES, Geometry
from montecarlo_brdf.diagnosis.stored import Stored
from montecarlo_brdf.diagnosis.words import (
    PI,
    Factor,
    Word,
    constant,
    factor,
    relation,
)
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

CLOSE = 1e-7
MOST = 0.98  # of the nodes that must agree
LEAST = 1e-7  # of the largest value: where known models are compared
EVERY = 2  # nodes
FIRST = 60  # nodes of the first place, by which most are ruled out
ROUNDS = 6
#: models whose names a user's parameters may share
BUILT_IN = ("oren_nayar", "oren_nayar_full", "disney_diffuse", "eon", "fon", "fujii_qualitative",
            "lommel_seeliger", "ggx_anisotropic", "ward", "ashikhmin_shirley")  # fmt: skip
FRESNEL = " with Schlick's Fresnel"


class Identity(NamedTuple):
    """f is `factor` times a known model."""

    name: str
    words: str
    wrong: str
    factor: Factor

    @property
    def target(self) -> str:
        """'GGX, no masking (alpha^2)'."""
        return f"{self.name} ({self.words})" if self.words else self.name

    def __str__(self) -> str:
        told = str(self.factor)
        return f"f is {self.target}" if told == "1" else f"f is {told} times {self.target}"


class Nodes(NamedTuple):
    """f at some nodes of a place."""

    g: Geometry
    f: Array


def some_nodes(at: Stored) -> list[Nodes]:
    """Where known models are compared: not too near the horizon."""
    found = []
    for n in at.nodes:
        keep = np.flatnonzero((n.g.cos_i > 0.01) & (n.f > 0.0) & np.isfinite(n.f))[::EVERY]
        found.append(Nodes(Geometry(*(x[keep] for x in n.g)), n.f[keep]))
    return found


def identities(at: Stored) -> list[Identity]:
    """All known models that f is up to a factor."""
    nodes = some_nodes(at)
    if any(len(n.f) < 20 for n in nodes):
        return []
    with np.errstate(all="ignore"):
        found = [*_lambert(at, nodes), *_built_in(at, nodes), *_formulas(at, nodes)]
        return found or list(_anisotropic(at, nodes))


def _lambert(at: Stored, nodes: Sequence[Nodes]) -> Iterator[Identity]:
    """No monomials of the half vector: 2 n.h wo.h is cos_i + cos_o."""
    rows = [(n.f * PI, n.g) for n in nodes]
    shapes = [e for e in SHAPES if not e[2] and not e[3]]
    found = factor(rows, at.sets, at.names, 1e-9, MOST, shapes)
    if found and not found.each:
        yield Identity("Lambert", "", "", found)


@functools.cache
def _models() -> tuple[Model, ...]:
    return tuple(map(load, BUILT_IN))


def _built_in(at: Stored, nodes: Sequence[Nodes]) -> Iterator[Identity]:
    own = at.model.Params._fields
    for other in _models():
        shared = [k for k in other.Params._fields if k in own]
        if not shared and other.Params._fields and own:
            continue

        def values(k: int, most: int, other: Model = other, shared: list[str] = shared) -> Array:
            p = at.spots[k].p
            try:
                q = other.parameters(**{n: getattr(p, n) for n in shared})
            except ValueError:
                return np.full(min(most, len(nodes[k].f)), np.nan)
            ready = other.prepared(q)
            g = nodes[k].g
            pairs = zip(g.wo[:most].tolist(), g.wi[:most].tolist(), strict=True)
            return np.array([_number(other.f, a, b, ready) for a, b in pairs])

        if constant(nodes[0].f[:FIRST] / values(0, FIRST), CLOSE, 0.95) is None:
            continue
        rows = [(_ratio(n.f, values(k, len(n.f))), n.g) for k, n in enumerate(nodes)]
        found = factor(rows, at.sets, at.names, CLOSE, MOST, [NONE])
        if found and not found.each:
            yield Identity(other.name, ", ".join(shared), "", found)


def _number(f: Callable[..., float], wo: object, wi: object, p: object) -> float:
    try:
        value = f(wo, wi, p)
    except (ArithmeticError, ValueError):
        return float("nan")
    return float(value) if isinstance(value, float | int) else float("nan")


def _ratio(f: Array, v: Array) -> Array:
    top = np.nanmax(v) if np.isfinite(v).any() else np.nan
    return np.where(v > LEAST * top, f / v, np.nan)


def _formulas(at: Stored, nodes: Sequence[Nodes]) -> Iterator[Identity]:
    some = Nodes(Geometry(*(x[:FIRST] for x in nodes[0].g)), nodes[0].f[:FIRST])
    for k in at.model.Params._fields:
        xs = [float(getattr(s.p, k)) for s in at.spots]
        for one in (*known.reflections(), *known.lobes()):
            if not _plausible(_ratio(some.f, one.value(some.g, xs[0])), some.g):
                continue
            rows = [(_ratio(n.f, one.value(n.g, x)), n.g) for n, x in zip(nodes, xs, strict=True)]
            yield from _named(at, rows, one.name, one.words.format(k), one.wrong)


def _named(
    at: Stored, rows: list[tuple[Array, Geometry]], name: str, words: str, wrong: str
) -> Iterator[Identity]:
    if any(np.isfinite(r).sum() < 20 for r, _ in rows):
        return
    found = factor(rows, at.sets, at.names, CLOSE, MOST)
    if found and not found.each:
        yield Identity(name, words, wrong, found)
    elif fresnel := _schlick(at, rows):
        yield Identity(name + FRESNEL, words, wrong, Factor(*fresnel))


def _plausible(r: Array, g: Geometry) -> bool:
    """Whether a ratio is a constant times a monomial, or Schlick's Fresnel, at one place: by
    logarithms, as least absolute deviations have it."""
    ok = np.isfinite(r) & (r > 0.0)
    if ok.sum() < 20:
        return False
    y = np.log(r[ok])
    columns = [np.ones(len(y)), *(np.log(c[ok]) for c in (g.cos_i, g.normal_half, g.out_half))]
    a = np.stack(columns, axis=1)
    if _spread(a, y) < 1e-5:
        return True
    x = (1.0 - g.out_half[ok]) ** 5
    b = np.stack([np.ones(len(y)), x], axis=1) / r[ok][:, None]
    return _spread(b, np.ones(len(y))) < 1e-5


def _spread(a: Array, y: Array) -> float:
    weight, off = np.ones(len(y)), y
    if not np.isfinite(a).all():
        return np.inf
    for _ in range(ROUNDS):
        c = np.linalg.lstsq(a * weight[:, None], y * weight, rcond=None)[0]
        off = np.abs(a @ c - y)
        if np.quantile(off, 0.5) > 0.3:
            break
        weight = 1.0 / np.sqrt(np.maximum(off, 1e-9))
    return float(np.quantile(off, 0.9))


def _schlick(at: Stored, rows: list[tuple[Array, Geometry]]) -> tuple[float, Word] | None:
    """c (f0 + (1 - f0) (1 - wo.h)^5): c is what is left as wo.h goes to 0."""
    cs = []
    for r, g in rows:
        ok = np.isfinite(r) & (r > 0.0)
        a = np.stack([np.ones(ok.sum()), (1.0 - g.out_half[ok]) ** 5], axis=1)
        c = np.linalg.lstsq(a / r[ok][:, None], np.ones(ok.sum()), rcond=None)[0]
        if np.quantile(np.abs(a @ c / r[ok] - 1.0), 0.9) > 1e-6:
            return None
        cs.append(float(c.sum()))
    return relation(cs, at.sets, at.names, 1e-5) if min(cs) > 0.0 else None


def _anisotropic(at: Stored, nodes: Sequence[Nodes]) -> Iterator[Identity]:
    if at.model.isotropic:
        return
    for a, b in itertools.permutations(at.model.Params._fields, 2):
        tables = [
            {name: (wrong, v) for name, wrong, v in
             known.anisotropic(n.g, float(getattr(s.p, a)), float(getattr(s.p, b)))}
            for n, s in zip(nodes, at.spots, strict=True)
        ]  # fmt: skip
        for name in tables[0]:
            if not all(name in t for t in tables):
                continue
            rows = [(_ratio(n.f, t[name][1]), n.g) for n, t in zip(nodes, tables, strict=True)]
            if _plausible(*rows[0]):
                yield from _named(at, rows, name, f"{a}, {b}", tables[0][name][0])


class Sum(NamedTuple):
    """f is c0 Lambert + c1 of another model."""

    diffuse: Factor
    lobe: Factor
    name: str
    words: str

    def __str__(self) -> str:
        parts = f"{self.diffuse} Lambert + {self.lobe} {self.name}"
        return f"f = {parts} ({self.words})"


def sums(at: Stored) -> Iterator[Sum]:
    """Lambert and one lobe, by least squares, both coefficients named at all places."""
    nodes = some_nodes(at)
    if any(len(n.f) < 20 for n in nodes):
        return
    with np.errstate(all="ignore"):
        for k in at.model.Params._fields:
            xs = [float(getattr(s.p, k)) for s in at.spots]
            for one in (*known.reflections(), *known.lobes()):
                cs = _coefficients(one, xs, nodes)
                both = [relation([c[i] for c in cs], at.sets, at.names, 1e-5)
                        for i in (0, 1)] if cs else []
                if both and all(both):
                    diffuse, lobe = (Factor(*r) for r in both if r)
                    yield Sum(diffuse, lobe, one.name, one.words.format(k))


def _coefficients(
    one: known.Formula, xs: Sequence[float], nodes: Sequence[Nodes]
) -> list[tuple[float, float]]:
    found = []
    for n, x in zip(nodes, xs, strict=True):
        v = one.value(n.g, x)
        ok = np.isfinite(v)
        if ok.sum() < 20:
            return []
        a = np.stack([np.full(ok.sum(), 1.0 / PI), v[ok]], axis=1) / n.f[ok][:, None]
        c = np.linalg.lstsq(a, np.ones(len(a)), rcond=None)[0]
        if not (np.quantile(np.abs(a @ c - 1.0), 0.95) < 1e-6 and min(c) > 1e-6):
            return []
        found.append((float(c[0]), float(c[1])))
    return found


