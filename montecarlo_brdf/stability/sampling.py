"""A model's sampler at random numbers that a generator may give and a test never draws."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.rung import Rung, rounded
from montecarlo_brdf.arithmetic.types import Arithmetic, Array
from montecarlo_brdf.model import Model
from montecarlo_brdf.stability import designed

#: A direction may be this many roundings longer or shorter than 1: two rotations' worth.
LENGTH_ROUNDINGS = 32.0
ANGLES = 8
#: what makes a draw unusable: it is no number, pdf is 0 or NaN there, f cos/pdf is not finite
UNUSABLE = ("nan", "unreachable", "weightless")


@dataclass
class Draws:
    """What went wrong among the draws of one precision: how often, and where."""

    length: float = 0.0  # worst | |w| - 1 |
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(UNUSABLE, 0))
    where: dict[str, Any] = field(default_factory=dict)  # the first of each, the worst length

    def add(self, rung: Rung, wo: Array, u: Array, p: NamedTuple) -> None:
        """Draw for numbers u at directions wo."""
        w = rung.sample(wo, u, p)
        bad = np.asarray(~np.isfinite(w[:3]).all(axis=0))
        self._count("nan", bad, (wo, u, p))
        kept = ~bad & (w[2] > 0)
        wo, u, w = wo[kept], u[kept], w[:, kept]
        length = np.sqrt((w[:3].astype(np.longdouble) ** 2).sum(axis=0))
        off = np.abs(length - 1.0).astype(np.float64)
        if len(off) and ("length" not in self.where or off.max() > self.length):
            self.length, self.where["length"] = float(off.max()), _place(wo, u, p, off)
        with np.errstate(all="ignore"):
            weight, density = _weights(rung, wo, w, p)
        self._count("unreachable", ~(density > 0), (wo, u, p))
        self._count("weightless", ~np.isfinite(weight) & (density > 0), (wo, u, p))

    def _count(self, kind: str, wrong: Array, drawn: tuple[Array, Array, NamedTuple]) -> None:
        self.counts[kind] += int(wrong.sum())
        if wrong.any() and kind not in self.where:
            self.where[kind] = _place(*drawn, wrong)


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
    total = Draws()
    for p in sets:
        q = rounded(p, arithmetic)
        if q is not None:
            total.add(rung, wo, many, q)
    return total


def _weights(rung: Rung, wo: Array, w: Array, p: NamedTuple) -> tuple[Any, Any]:
    """(f cos/pdf, pdf) of drawn directions; a sampler's own weight where it returns one."""
    wi = w[:3].T
    if rung.model.pdf is None:
        return (w[3] if len(w) > 3 else np.zeros(len(wi))).astype(np.float64), np.ones(len(wi))
    density = rung.pdf(wo, wi, p).astype(np.float64)
    if len(w) > 3:
        return w[3].astype(np.float64), density
    return rung.f(wo, wi, p).astype(np.float64) * wi[:, 2].astype(np.float64) / density, density


def _place(wo: Array, u: Array, p: NamedTuple, score: Array) -> dict[str, Any]:
    """Where a score is largest."""
    i = int(np.argmax(score))
    vectors = {"wo": [float(x) for x in wo[i]], "u": [float(x) for x in u[i]]}
    return {**vectors, "p": {n: float(v) for n, v in zip(p._fields, p, strict=False)}}
