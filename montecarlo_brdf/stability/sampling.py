"""A model's sampler at random numbers that a generator may give and a test never draws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.types import Arithmetic, Array
from montecarlo_brdf.model import Model
from montecarlo_brdf.stability import designed
from montecarlo_brdf.stability.ladder import Rung, rounded

#: A direction may be this many roundings longer or shorter than 1: two rotations' worth.
LENGTH_ROUNDINGS = 32.0
ANGLES = 8


@dataclass(frozen=True)
class Draws:
    """What went wrong among `count` draws of one precision: how often, and where first."""

    count: int
    nan: int
    length: float  # worst | |w| - 1 |
    unreachable: int  # pdf 0 or NaN where it samples
    weightless: int  # f cos/pdf infinite or NaN
    largest_weight: float
    where: dict[str, Any]  # the first of each kind, the worst for length


def draws(model: Model, sets: list[Any], arithmetic: Arithmetic) -> Draws | None:
    """All adversarial numbers at eight directions, for every parameter set."""
    if model.sample is None:
        return None
    rung = Rung(model, arithmetic)
    u = designed.uniforms(arithmetic)
    polar = designed.polar(arithmetic, quick=True)
    wos = arithmetic.array(
        np.array([(s * 0.8, -s * 0.6, c) for s, c in polar if c >= arithmetic.eps])
    )
    wos = wos[:: max(1, len(wos) // ANGLES)]
    wo, many = np.repeat(wos, len(u), axis=0), np.tile(u, (len(wos), 1))
    total = Draws(0, 0, 0.0, 0, 0, 0.0, {})
    for p in sets:
        q = rounded(p, arithmetic)
        if q is not None:
            total = _together(total, _one(rung, wo, many, q))
    return total


def _one(rung: Rung, wo: Array, u: Array, p: NamedTuple) -> Draws:
    w = rung.sample(wo, u, p)
    bad = ~np.isfinite(w[:3]).all(axis=0)
    kept = ~bad & (w[2] > 0)
    nowhere = {"nan": _place(wo, u, p, int(np.argmax(bad)))} if bad.any() else {}
    wo, u, w = wo[kept], u[kept], w[:, kept]
    off = np.abs(np.sqrt((w[:3].astype(np.longdouble) ** 2).sum(axis=0)) - 1.0).astype(np.float64)
    with np.errstate(all="ignore"):
        weight, density = _weights(rung, wo, w, p)
    unreachable = ~(density > 0)
    blown = ~np.isfinite(weight) & ~unreachable
    places = {"unreachable": unreachable, "weightless": blown}
    where = {k: _place(wo, u, p, int(np.argmax(v))) for k, v in places.items() if v.any()}
    where |= nowhere
    if len(off):
        where["length"] = _place(wo, u, p, int(np.argmax(off)))
    return Draws(
        len(bad),
        int(bad.sum()),
        float(off.max(initial=0.0)),
        int(unreachable.sum()),
        int(blown.sum()),
        float(np.where(np.isfinite(weight), weight, 0.0).max(initial=0.0)),
        where,
    )


def _weights(rung: Rung, wo: Array, w: Array, p: NamedTuple) -> tuple[Any, Any]:
    """(f cos/pdf, pdf) of drawn directions; a sampler's own weight where it returns one."""
    wi = w[:3].T
    if rung.model.pdf is None:
        return (w[3] if len(w) > 3 else np.zeros(len(wi))).astype(np.float64), np.ones(len(wi))
    density = rung.pdf(wo, wi, p).astype(np.float64)
    if len(w) > 3:
        return w[3].astype(np.float64), density
    return rung.f(wo, wi, p).astype(np.float64) * wi[:, 2].astype(np.float64) / density, density


def _place(wo: Array, u: Array, p: NamedTuple, i: int) -> dict[str, Any]:
    vectors = {"wo": [float(x) for x in wo[i]], "u": [float(x) for x in u[i]]}
    return {**vectors, "p": {n: float(v) for n, v in zip(p._fields, p, strict=False)}}


def _together(a: Draws, b: Draws) -> Draws:
    where = {**b.where, **a.where}
    if b.length > a.length:
        where["length"] = b.where["length"]
    return Draws(
        a.count + b.count,
        a.nan + b.nan,
        max(a.length, b.length),
        a.unreachable + b.unreachable,
        a.weightless + b.weightless,
        max(a.largest_weight, b.largest_weight),
        where,
    )
