"""Means over draws of a sampler held against the measures that they are to follow."""

from __future__ import annotations

import math
from collections.abc import Iterator
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import BLACK, HEAVY, Survey
from montecarlo_brdf.estimate.mixture import (
    INNER,
    TOGETHER,
    Groups,
    blind_density,
    centres,
    estimated,
    functions_at,
    nodes_of,
)
from montecarlo_brdf.estimate.places import draws_of, rows_of
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.sampling.spread import net
from montecarlo_brdf.statistics import quantile

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Flags

NAME = "moments"
NODES, REPLICATES = 512, 8  # of a place of a survey
MOST = 1 << 20  # of an estimate
FINE = 64  # its replicates: Student's t of 63 degrees is half that of 15
FIRST = 1 << 14  # draws that tell whether it would decide
MARGIN = 0.5  # of the tolerance, that it would do so
LEVEL = 1e-11  # at which what can not be resolved is passed over
UNSEEN = 1e-4  # of light that the mixture hardly hits: it can say nothing then
HARMONICS = 8


class Kind(StrEnum):
    """What a mean is of, and what it must equal."""

    DRAWS = "mean over draws - int pdf"
    WEIGHTS = "mean over weighted draws - int f cos"


#: what means are taken of, in words
NAMES = (
    "1", "z", "z^2", "z > 0.2", "z > 0.5",
    *(f"{name} {k} phi" for k in range(1, HARMONICS + 1) for name in ("cos", "sin")),
)  # fmt: skip


class Moment(NamedTuple):
    """A mean."""

    kind: Kind
    number: int  # a place in NAMES

    @property
    def text(self) -> str:
        """In words."""
        name = NAMES[self.number]
        return str(self.kind) if name == "1" else f"{self.kind}, of {name}"


def functions(w: Array) -> Iterator[Array]:
    """The values at directions (..., 3) of what NAMES says."""
    x, y, z = w[..., 0], w[..., 1], w[..., 2]
    yield np.ones_like(z)
    yield from (z, z * z, np.where(z > 0.2, 1.0, 0.0), np.where(z > 0.5, 1.0, 0.0))
    across = np.hypot(x, y)
    turn = np.where(across > 0.0, (x + 1j * y) / np.where(across > 0.0, across, 1.0), 1.0)
    power = turn
    for _ in range(HARMONICS):
        yield power.real
        yield power.imag
        power = power * turn


class Draws(NamedTuple):
    """K draws for each of n groups."""

    w: Array  # (n, K, 3)
    up: Flags  # (n, K): whether they are above the horizon
    weight: Array  # f cos/pdf, or what the sampler says of it
    unseen: Array  # (n,): the mean of weights that the mixture hardly hits


def drawn(model: Model, at: Groups, centre: Array, u: Array) -> Draws:
    """The draws for numbers u (K, 3), the same for all groups."""
    n, size = len(at.wo), len(u)
    many = np.repeat(np.arange(n), size)
    w, weight = draws_of(model, at.wo[many], np.tile(u, (n, 1)), at.sets.at(many))
    w, weight = w.reshape(n, size, 3), weight.reshape(n, size)
    up = np.isfinite(w).all(axis=2) & (w[..., 2] > 0.0)
    w = np.where(up[..., None], w, (0.0, 0.0, 1.0))
    f, pdf = functions_at(model, at, w)
    if not weighted(model):
        weight = f * w[..., 2] / np.where(pdf > 0.0, pdf, np.inf)
    weight = np.where(up & np.isfinite(weight), weight, 0.0)
    usual = np.maximum(weight.mean(axis=1), BLACK)[:, None]
    value = f * w[..., 2]
    missed = value > HEAVY * (pdf + blind_density(centre, w)) * usual
    return Draws(w, up, weight, np.where(missed, weight, 0.0).mean(axis=1))


def difference(
    model: Model, at: Groups, centre: Array, size: int, replicates: int, key: int,
    only: Moment | None = None,
) -> tuple[dict[Kind, Array], Array]:  # fmt: skip
    """By kind (n, replicates, moments) of means over draws less what they must equal, in units of
    light, or of one moment alone; and what the mixture hardly hits."""
    each, rng = size // replicates, np.random.default_rng(key)
    u = np.concatenate([np.mod(net(each, 13) + rng.random(3), 1.0) for _ in range(replicates)])
    own = drawn(model, at, centre, np.clip(u, INNER, 1.0 - INNER))
    nodes = nodes_of(model, at, centre, size, replicates, key + 1)
    value = nodes.f * nodes.w[..., 2]
    light = np.maximum(np.abs(nodes.mean(value).mean(axis=1)), BLACK)[:, None]

    def means(x: Array) -> Array:
        cut: Array = x.reshape(len(x), replicates, -1).mean(axis=2)
        return cut

    off: dict[Kind, list[Array]] = {kind: [] for kind in ([only.kind] if only else kinds(model))}
    for k, (g, h) in enumerate(zip(functions(own.w), functions(nodes.w), strict=True)):
        if only and k != only.number:
            continue
        if Kind.WEIGHTS in off:
            off[Kind.WEIGHTS].append((means(own.weight * g) - nodes.mean(value * h)) / light)
        if Kind.DRAWS in off:  # of 1 it is the mass, which `pdf` asks about
            due = nodes.mean(nodes.pdf * h)
            off[Kind.DRAWS].append((means(np.where(own.up, g, 0.0)) - due) * (k > 0))
    return {kind: np.stack(columns, axis=-1) for kind, columns in off.items()}, own.unseen


def kinds(model: Model) -> list[Kind]:
    """What can be asked of a model."""
    return [Kind.WEIGHTS, *([Kind.DRAWS] if model.pdf is not None else [])]


def differences(at: Survey) -> dict[Kind, Array]:
    """`difference` at some places of a survey; 0 where nothing can be said."""
    key = stream(at.case.seed, at.model.identity, NAME)
    many, parts = max(1, TOGETHER // NODES), []
    for first in range(0, len(at.some), many):
        rows = at.some[first : first + many]
        found, unseen = difference(
            at.model, at.at.at(rows), at.centre[rows], NODES, REPLICATES, key
        )
        heavy = unseen > UNSEEN
        if at.model.pdf is not None:
            heavy |= at.undrawn[rows].mean(axis=1) > UNSEEN
        found[Kind.WEIGHTS][heavy] = 0.0  # few draws make the mean: the claim about cover tells
        parts.append(found)
    return {kind: np.concatenate([part[kind] for part in parts]) for kind in parts[0]}


def measured(case: Case, theta: float, moment: Moment, plan: Plan) -> list[Measurement]:
    """One difference at one place."""
    model, one, wo = case.model, case.one, case.wo(theta)
    size = min(plan.samples, MOST)
    at = Groups(rows_of(model, one, np.array([tuple(one)], dtype=float)), np.array([wo]))
    key = stream(plan.seed, model.identity, *model.picks.values(), NAME, *one, *wo, size)
    how = size, min(size, FINE), key, moment
    found, unseen = difference(model, at, centres(model, at), *how)
    unfit = "a lobe that the mixture hardly hits" if unseen[0] > UNSEEN else None
    return [Measurement(NAME, estimated(found[moment.kind][0, :, 0], size), unfit)]


def resolvable(case: Case, theta: float, moment: Moment, tolerance: float) -> bool:
    """Whether the last look would decide a difference: it is off already, or its error, falling
    like the root of the draws, would be within a tolerance."""
    (first,) = measured(case, theta, moment, Plan(samples=FIRST, seed=case.seed))
    e, t = first.estimate, quantile(LEVEL, FINE - 1)
    off = abs(e.mean) - t * e.stderr > tolerance
    return not first.unfit and (off or t * e.stderr * math.sqrt(FIRST / MOST) <= MARGIN * tolerance)
