"""What is stored of a model: values at a few places, the same for every law and every repair.

A place is a parameter set and a viewer: the defaults at two angles, six sets inside the ranges at
others, and where checks failed. There: f both ways and pdf at nodes of a quadrature, f for random
pairs turned, mirrored and exchanged, and draws with the density that they really have.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters, search_range
from montecarlo_brdf.cases.parameters import between
from montecarlo_brdf.diagnosis.ask import asked, drawn
from montecarlo_brdf.diagnosis.geometry import Geometry, geometry, turned
from montecarlo_brdf.estimate.density import Density, density
from montecarlo_brdf.estimate.probe import number_from
from montecarlo_brdf.judge.finding import Finding, Result, Verdict
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import from_degrees

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

REPLICATES = 8  # randomly shifted quadratures
PAIRS, TRIPLES, DRAWS, MANY = 60, 24, 40, 400
MOST_FOUND = 5  # places where checks failed
#: (polar angle, azimuth) in degrees: the defaults at two, sets inside the ranges at the others
ANGLES = ((35, 25), (75, 130), (60, 250), (10, 20), (50, 200), (82, 310), (25, 100), (66, 170))
GOLDEN = (0.6180339887, 0.7548776662, 0.8191725134, 0.8566748838, 0.8812714616, 0.8986, 0.911)
LESS = 0.2  # of a parameter without a range, by which it is varied
TURN = 1.1  # radians
FLIP = np.array([1.0, -1.0, 1.0])
MIRROR = np.array([-1.0, -1.0, 1.0])
LAST = 89.9  # degrees


class Spot(NamedTuple):
    """A place: parameters and a viewer. `albedo`, `reverse`: what a check measured there."""

    p: Parameters
    theta: float
    phi: float
    found: bool = False
    albedo: float | None = None
    reverse: float | None = None
    own: bool = False  # measured by the model's own draws

    @property
    def wo(self) -> Array:
        """The viewer's direction."""
        return np.array(from_degrees(self.theta, self.phi))


class Nodes(NamedTuple):
    """A quadrature over the hemisphere, and f, f' and pdf there."""

    g: Geometry
    weight: Array
    replicate: Any
    f: Array
    back: Array
    pdf: Array | None

    def mean(self, values: Array) -> tuple[float, float]:
        """(integral, standard error)."""
        parts = np.bincount(self.replicate, values * self.weight, REPLICATES)
        return float(parts.mean()), float(parts.std(ddof=1) / math.sqrt(REPLICATES))


class Pairs(NamedTuple):
    """f for random pairs a, b; of some of them for a third c, turned and mirrored."""

    g: Geometry
    ab: Array
    ba: Array
    bc: Array
    cb: Array
    ca: Array
    ac: Array
    turned: Array
    mirrored: Array


@dataclass
class Draws:
    """Draws at a place: those above the horizon, with f, pdf and the density that they have."""

    g: Geometry
    u: Array
    weight: Array
    f: Array
    pdf: Array  # nan without one
    swapped: Array  # pdf with wo and wi exchanged
    moved: dict[str, Array]  # pdf of directions taken by mistake
    density: Array
    of: Density | None
    many: Array  # all of them
    many_weight: Array

    @property
    def ratio(self) -> Array:
        """pdf over the density of the draws."""
        return self.over(self.pdf)

    def over(self, pdf: Array) -> Array:
        """Another pdf over it."""
        ok = np.isfinite(self.density) & (self.density > 0.0)
        return np.where(ok, pdf / np.where(ok, self.density, 1.0), np.nan)

    @property
    def known(self) -> bool:
        """Whether the density is."""
        return int(np.isfinite(self.density).sum()) >= 10

    @property
    def finite(self) -> Any:
        """Which of all are numbers."""
        return np.isfinite(self.many).all(axis=1)

    @property
    def rejected(self) -> float:
        """The share below the horizon."""
        return float(np.mean(self.finite & (self.many[:, 2] <= 0.0)))


class Target(NamedTuple):
    """f, and the values of a model that it must equal, at the nodes of a place."""

    spot: int
    p: Parameters
    have: Array
    want: Array
    model: Model
    q: Parameters


class Stored:
    """All of it."""

    def __init__(self, case: Case, results: Sequence[Result]) -> None:
        self.case = case
        self.model = case.model.of(case.one)
        self.names, sets = _sets(case)
        usual = zip([sets[0], *sets], ANGLES, strict=False)
        self.spots = [Spot(p, *angles) for p, angles in usual]
        self.spots += _failed_at(case, results)
        rngs = [np.random.default_rng(1000 + k) for k in range(len(self.spots))]
        self.nodes = _nodes(self.model, self.spots, rngs)
        self.pairs = _pairs(self.model, self.spots, rngs)
        self.draws = _draws(self.model, self.spots) if self.model.sample else []
        self.targets = self._targets()
        self.declared = [_declared(self.model, s) for s in self.spots]

    @property
    def sets(self) -> list[Parameters]:
        """The parameter set of each spot."""
        return [s.p for s in self.spots]

    def _targets(self) -> list[Target]:
        """What `same_as`, `limits` and --against promise."""
        m, found = self.model, []
        other = self.case.against or (load(m.same_as) if m.same_as else None)
        if other is not None:
            found += [_target(self, k, s.p, other) for k, s in enumerate(self.spots)]
        for changes, name in m.limits:
            limit = load(name)
            sets = [s.p._replace(**changes) for s in self.spots]
            found += [_target(self, k, p, limit) for k, p in enumerate(sets)]
        return found


def _target(at: Stored, k: int, p: Parameters, other: Model) -> Target:
    shared = {n: v for n, v in p._asdict().items() if n in other.Params._fields}
    q, g = other.parameters(**shared), at.nodes[k].g
    have = at.nodes[k].f
    if p != at.spots[k].p:
        have = asked(at.model, at.model.f, [(p, g.wo, g.wi)])[0]
    return Target(k, p, have, asked(other, other.f, [(q, g.wo, g.wi)])[0], other, q)


def _declared(model: Model, s: Spot) -> float | None:
    """The albedo that a model promises."""
    if model.albedo:
        return number_from(model, "albedo", model.albedo, float(s.wo[2]), s.p)
    return 1.0 if model.lossless is True else None


def _sets(case: Case) -> tuple[list[str], list[Parameters]]:
    """Names of parameters that vary, and sets: the one asked about, then six inside the ranges.

    A parameter without a range is taken up to a fifth less, or its power could not be told.
    """
    model, base = case.model, case.one
    ranges = {k: ends for k in base._fields if (ends := search_range(model, k))}
    fixed = [k for k in base._fields if k not in ranges and getattr(base, k) not in (0.0, 1.0)]
    sets = [base]
    for k in range(1, len(ANGLES) - 1):
        t = [0.06 + 0.88 * ((0.37 + k * GOLDEN[(i + len(ranges)) % 7]) % 1.0)
             for i in range(len(ranges))]
        less = [1.0 - LESS * ((0.31 + k * GOLDEN[(i + 3) % 7]) % 1.0) for i in range(len(fixed))]
        places = zip(ranges.items(), t, strict=True)
        inside = {n: float(between(*ends, x)) for (n, ends), x in places}
        inside |= {n: getattr(base, n) * x for n, x in zip(fixed, less, strict=True)}
        sets.append(base._replace(**inside))
    return [*ranges, *fixed], sets


#: whose places are stored first
FIRST = ("energy", "positivity", "pdf", "sampling")


def _failed_at(case: Case, results: Sequence[Result]) -> list[Spot]:
    """The places of failed findings, one or two a quantity."""
    found: list[tuple[int, Spot]] = []
    seen: dict[tuple[str, str], int] = {}
    for result in results:
        for f in result.findings:
            if f.verdict != Verdict.FAIL or result.check in ("radiance", "precision"):
                continue
            spot = _spot(case, result.check, f)
            key = (result.check, f.quantity)
            if spot is None or seen.get(key, 0) >= 2:
                continue
            seen[key] = seen.get(key, 0) + 1
            rank = FIRST.index(result.check) if result.check in FIRST else len(FIRST)
            found.append((rank, spot))
    return [spot for _, spot in sorted(found, key=lambda x: x[0])][:MOST_FOUND]


def _spot(case: Case, check: str, f: Finding) -> Spot | None:
    theta = f.where.get("theta_o_deg", f.where.get("theta_i_deg"))
    if not isinstance(theta, (int, float)) or not math.isfinite(theta):
        return None
    phi = f.where.get("phi_o_deg", f.where.get("phi_i_deg", 0.0))
    fields = {case.model.labels.get(n, n): n for n in case.one._fields}
    changed = {fields[k]: float(v) for k, v in f.where.items() if k in fields}
    known = f.value if check in ("energy", "furnace") and math.isfinite(f.value) else None
    a = known if f.quantity in ("worst A <= 1", "A <= 1") else None
    r = known if f.quantity == "worst R <= 1" else None
    p, own = case.one._replace(**changed), f.estimator == Sampler.OWN
    return Spot(p, min(float(theta), LAST), float(phi), True, a, r, own)


# nodes --------------------------------------------------------------------------------------------

#: (kind, width or exponent, nodes in a replicate)
LOBES = (("cosine", 0.0, 20), ("uniform", 0.0, 20), ("normals", 0.5, 12), ("normals", 0.15, 12),
         ("normals", 0.04, 8), ("mirror", 15.0, 12), ("mirror", 400.0, 12))  # fmt: skip
PLASTIC = (0.7548776662466927, 0.5698402909980532)


def _hemisphere(v: Array) -> Array:
    z = v[:, 0]
    return _around_z(z, v[:, 1])


def _around_z(z: Array, turn: Array) -> Array:
    s, phi = np.sqrt(np.maximum(0.0, 1.0 - z * z)), 2.0 * np.pi * turn
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=1)


def _quadrature(wo: Array, rng: np.random.Generator) -> tuple[Array, Array, Any]:
    """(wi, weight, replicate): cosine, uniform, lobes about half vectors and the mirror direction,
    under the balance heuristic."""
    n = wo * MIRROR
    t = np.cross(n, [0.0, 0.0, 1.0] if abs(n[2]) < 0.9 else [1.0, 0.0, 0.0])
    t /= np.linalg.norm(t)
    s = np.cross(n, t)
    out, replicate = [], []
    for r in range(REPLICATES):
        for kind, a, m in LOBES:
            v = (np.outer(np.arange(m), PLASTIC) + rng.random(2)) % 1.0
            if kind == "cosine":
                w = _around_z(np.sqrt(1.0 - v[:, 0]), v[:, 1])
            elif kind == "uniform":
                w = _around_z(1.0 - v[:, 0], v[:, 1])
            elif kind == "normals":
                h = _around_z(np.sqrt((1 - v[:, 0]) / (1 + (a * a - 1) * v[:, 0])), v[:, 1])
                w = 2.0 * (h @ wo)[:, None] * h - wo
            else:
                x = _around_z((1.0 - v[:, 0]) ** (1.0 / (a + 1.0)), v[:, 1])
                w = x[:, :1] * t + x[:, 1:2] * s + x[:, 2:] * n
            out.append(w)
            replicate.append(np.full(m, r))
    w, which = np.concatenate(out), np.concatenate(replicate)
    ok = w[:, 2] > 1e-6
    w, which = w[ok], which[ok]
    w /= np.linalg.norm(w, axis=1)[:, None]
    return w, 1.0 / _mixture(wo, w, n), which


def _mixture(wo: Array, w: Array, n: Array) -> Array:
    g = geometry(wo, w)
    found = np.zeros(len(w))
    for kind, a, m in LOBES:
        if kind == "cosine":
            d = g.cos_i / np.pi
        elif kind == "uniform":
            d = np.full(len(w), 0.5 / np.pi)
        elif kind == "normals":
            q = g.normal_half**2 * (a * a - 1.0) + 1.0
            d = a * a / (np.pi * q * q) * g.normal_half / (4.0 * np.maximum(g.out_half, 1e-9))
        else:
            d = (a + 1.0) / (2.0 * np.pi) * np.maximum(w @ n, 0.0) ** a
        found = found + m * d
    return found


def _nodes(
    model: Model, spots: Sequence[Spot], rngs: Sequence[np.random.Generator]
) -> list[Nodes]:
    made = [_quadrature(s.wo, rng) for s, rng in zip(spots, rngs, strict=True)]
    there = [(s.p, s.wo, wi) for s, (wi, *_) in zip(spots, made, strict=True)]
    f = asked(model, model.f, there)
    back = asked(model, model.f, [(p, wi, wo) for p, wo, wi in there])
    pdf: list[Any] = asked(model, model.pdf, there) if model.pdf else [None] * len(spots)
    return [
        Nodes(geometry(s.wo, wi), q, r, *values)
        for s, (wi, q, r), *values in zip(spots, made, f, back, pdf, strict=True)
    ]


def _pairs(
    model: Model, spots: Sequence[Spot], rngs: Sequence[np.random.Generator]
) -> list[Pairs]:
    n, found = TRIPLES, []
    rows: list[Any] = []
    some = []
    for s, rng in zip(spots, rngs, strict=True):
        a, b, c = (_hemisphere(rng.random((PAIRS, 2)) * [0.98, 1] + [0.02, 0]) for _ in range(3))
        some.append((a, b))
        ends = [(a, b), (b, a), (b[:n], c[:n]), (c[:n], b[:n]), (c[:n], a[:n]), (a[:n], c[:n]),
                (turned(a[:n], TURN), turned(b[:n], TURN)), (a[:n] * FLIP, b[:n] * FLIP)]
        rows += [(s.p, x, y) for x, y in ends]
    values = asked(model, model.f, rows)
    for k, (a, b) in enumerate(some):
        found.append(Pairs(geometry(a, b), *values[8 * k : 8 * k + 8]))
    return found


# draws --------------------------------------------------------------------------------------------

TURNED, QUARTER, AZIMUTH, BELOW = (
    "with wi turned by 180 degrees: around wo in place of its mirror direction, or the reverse",
    "turned by 90 degrees: tangent and bitangent are swapped, or the azimuth",
    "for a viewer at azimuth 0: sample or pdf ignores the azimuth of wo",
    "below the horizon",
)


def _draws(model: Model, spots: Sequence[Spot]) -> list[Draws]:
    us = [np.random.default_rng(77 + k).random((MANY, 3)) * (1.0 - 2e-3) + 1e-3
          for k in range(len(spots))]
    many = drawn(model, [(s.p, s.wo, u) for s, u in zip(spots, us, strict=True)])
    picks = [np.flatnonzero(np.isfinite(w).all(axis=1) & (w[:, 2] > 1e-3))[:DRAWS] for w, _ in many]
    w = [a[0][k] for a, k in zip(many, picks, strict=True)]
    u = [a[k] for a, k in zip(us, picks, strict=True)]
    of = [_density(model, s, a) for s, a in zip(spots, u, strict=True)]
    there = [(s.p, s.wo, x) for s, x in zip(spots, w, strict=True)]
    f = _each(model, model.f, there)
    nothing = [np.full(len(x), np.nan) for x in w]
    pdf = _each(model, model.pdf, there) if model.pdf else nothing
    swapped = _each(model, model.pdf, [(p, b, a) for p, a, b in there]) if model.pdf else nothing
    moved = _moved(model, there) if model.pdf else [{} for _ in spots]
    found = []
    for k, s in enumerate(spots):
        d = of[k]
        due = nothing[k] if d is None else d.density.copy()
        if d is not None:
            due[missing(d) & (pdf[k] > due)] = np.nan
        found.append(
            Draws(geometry(s.wo, w[k]), u[k], many[k][1][picks[k]], f[k], pdf[k], swapped[k],
                  moved[k], due, d, *many[k])
        )  # fmt: skip
    return found


def _density(model: Model, s: Spot, u: Array) -> Density | None:
    """The density of the draws, if it is known."""
    found = density(model, s.p, from_degrees(s.theta, s.phi), u) if len(u) else None
    return found if found and found.unknown is None else None


def missing(d: Density) -> Any:
    """Draws for which a piece has no root: their density is a lower bound."""
    return (d.roots == 0).any(axis=1)


def _each(model: Model, function: Any, rows: Sequence[Any]) -> list[Array]:
    """`asked`, where some rows may be empty."""
    full = [r for r in rows if len(r[1]) and len(r[2])]
    values = iter(asked(model, function, full) if full else [])
    return [next(values) if len(r[1]) and len(r[2]) else np.zeros(0) for r in rows]


def _moved(model: Model, rows: Sequence[Any]) -> list[dict[str, Array]]:
    """pdf for directions that are taken by mistake."""
    made: dict[str, list[Any]] = {TURNED: [], QUARTER: [], AZIMUTH: [], BELOW: []}
    for p, wo, wi in rows:
        ahead = np.array([math.hypot(wo[0], wo[1]), 0.0, wo[2]])
        made[TURNED].append((p, wo, wi * MIRROR))
        made[QUARTER].append((p, turned(wo, math.pi / 2)[0], turned(wi, math.pi / 2)))
        made[AZIMUTH].append((p, ahead, wi))
        made[BELOW].append((p, wo, wi * [1.0, 1.0, -1.0]))
    values = {name: _each(model, model.pdf, some) for name, some in made.items()}
    return [{name: v[k] for name, v in values.items()} for k in range(len(rows))]
