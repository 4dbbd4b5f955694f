"""How wrong a value is, and how much of that its inputs explain."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.rung import Rung, rounded, unit
from montecarlo_brdf.arithmetic.types import Arithmetic, Array
from montecarlo_brdf.stability.designed import Points

#: Darker than this, per steradian, nobody sees the error (f0 = 0 leaves (1 - h.v)^5 = 1e-40).
BLACK = 1e-20
#: Where one rounding of the directions moves f by this part of itself, it has no digit to lose.
UNDETERMINED = 0.25
#: times what one rounding of the directions does: rounded inputs, and as much for the formula
GRANTED = 2


class Errors(NamedTuple):
    """Per point: the value, the truth, the relative errors, and what happened to the number."""

    value: Array
    truth: Array
    total: Array  # |value - truth|/|truth| beyond eps times the largest |f| of the same wo
    own: Array  # the same beyond what one rounding of the inputs does to the truth
    kinds: dict[str, Array]  # "nan", "inf", "negative", "flushed": conditions per point
    low: Array  # directions lower than any angle of the type


def errors(narrow: Rung, wide: Rung, points: Points, p: NamedTuple) -> Errors:
    """Errors of f at points and parameters of the narrow type; truth at renormalised directions."""
    type_, truth_type = narrow.arithmetic, wide.arithmetic
    value = narrow.f(points.wo, points.wi, p)
    q = rounded(p, truth_type)
    wo, wi = unit(points.wo, truth_type), unit(points.wi, truth_type)
    given = truth_type.array(points.wo), truth_type.array(points.wi)
    truth, raw = _together(wide, [(wo, wi), given], q)
    unscaled = _finite_distance(raw, truth, truth_type)

    def judge(conditioning: Array) -> Errors:
        return judged(value, truth, conditioning, points, type_, truth_type)

    def moved(at: Array, eps: float) -> Array:
        turned = _together(wide, _moves(wo[at], wi[at], eps, truth_type), q)
        return _conditioning(turned, truth[at], truth_type)

    with np.errstate(all="ignore"):
        found = judge(unscaled)
        at = np.flatnonzero((found.own > 0) | found.kinds["flushed"])
        if not len(at):
            return found
        step = np.zeros_like(unscaled)  # where nothing is wrong it does not matter
        step[at] = moved(at, type_.eps)
        found = judge(step + unscaled)
        at = np.flatnonzero(found.own > type_.tolerance)
        if not len(at):
            return found
        # A step or a root of f may lie behind, within eps of both directions together: r.v = 0 of
        # Phong with n < 1. Where f is smooth, twice the move does twice as much.
        back = moved(at, -2.0 * type_.eps)
        step[at] = np.where(back > 3 * step[at], back, step[at])
        return judge(step + unscaled)


def lower_than_any_angle(points: Points, type_: Arithmetic) -> Array:
    """Pairs with a cosine below eps/8: the smallest of any angle of the type is about eps/4.

    There products leave the range of normal numbers, and with it their digits: no error is judged.
    """
    return np.minimum(points.wo[:, 2], points.wi[:, 2]).astype(np.float64) < type_.eps / 8


def judged(
    value: Array,
    truth: Array,
    conditioning: Array,
    points: Points,
    type_: Arithmetic,
    truth_type: Arithmetic,
) -> Errors:
    """The relative errors of values against their truth."""
    shown, size, low = truth_type.array(value), np.abs(truth), lower_than_any_angle(points, type_)
    plain = _double(shown) if shown.dtype == object else shown
    real = _finite(truth) & ~low
    largest = largest_of(np.where(real, size, truth_type.array(0.0)), points.group)
    granted = truth_type.array(type_.eps) * largest + truth_type.array(type_.least + BLACK)
    off = np.abs(shown - truth) - granted
    beyond = off - GRANTED * conditioning
    lost = (shown == 0) & (size >= type_.tiny) & (beyond > 0) & ~low
    kinds = {
        "nan": np.isnan(plain),
        "inf": np.isinf(plain) & (size <= type_.most),
        "negative": (shown < 0) & (truth >= 0) & (-shown > granted),
        "flushed": lost & (conditioning < UNDETERMINED * size),
    }
    broken = (kinds["nan"] | kinds["inf"]) & ~low
    counted = real & (size <= type_.most) & (size > 0)
    size = np.where(counted, size, truth_type.array(1.0))
    determined = ~(_double(conditioning / size) >= UNDETERMINED)

    def relative(error: Array, judged: Array) -> Array:
        some = np.where(counted & (error > 0) & judged, _double(error / size), 0.0)
        return np.where(broken, np.inf, some)

    return Errors(value, truth, relative(off, counted), relative(beyond, determined), kinds, low)


def _together(wide: Rung, pairs: list[Any], q: NamedTuple) -> Array:
    """f at lists of pairs of directions, a row each: all at once, since every call costs time."""
    wo, wi = (np.concatenate(w) for w in zip(*pairs, strict=True))
    return wide.f(wo, wi, q).reshape(len(pairs), -1)


def _moves(wo: Array, wi: Array, eps: float, arithmetic: Arithmetic) -> list[Any]:
    """Both directions moved by eps along each axis in turn, and renormalised."""
    steps = arithmetic.array(eps * np.eye(3))
    moved = [(unit(wo + step, arithmetic), wi) for step in steps]
    return [*moved, *((wo, unit(wi + step, arithmetic)) for step in steps)]


def _conditioning(turned: Array, truth: Array, arithmetic: Arithmetic) -> Array:
    """How far the true value moves when a direction is known to eps radians, as rounded ones are.
    What vectors that are not quite of unit length do to the formula is added by the caller.

    The sum of |f(w moved) - f(w)|/2 over the `_moves`: a property of f on the sphere, not of how a
    formula behaves off it.
    """
    half = arithmetic.array(0.5)
    return np.asarray(sum(_finite_distance(f, truth, arithmetic) * half for f in turned))


def _finite_distance(a: Array, b: Array, arithmetic: Arithmetic) -> Array:
    """|a - b|, 0 where it is not finite."""
    with np.errstate(all="ignore"):
        step = np.abs(a - b)
    return np.where(_finite(step), step, arithmetic.array(0.0))


def largest_of(size: Array, group: Array) -> Array:
    """The largest size within each group, at every member of it."""
    starts = np.flatnonzero(np.r_[True, group[1:] != group[:-1]])
    tops = np.maximum.reduceat(size, starts)
    return np.repeat(tops, np.diff(np.r_[starts, len(group)]))


def _double(x: Array) -> Array:
    return np.asarray(x).astype(np.float64)


def _finite(x: Array) -> Array:
    return np.isfinite(_double(x)) if x.dtype == object else np.isfinite(x)
