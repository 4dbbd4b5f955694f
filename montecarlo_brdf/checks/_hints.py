"""Likely causes: numbers that name the mistake behind them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.judge.hint import CLOSE, factor_named

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, At, Pairs

    Move = Callable[[Array, Array], Pairs]

FEWEST = 20  # pairs that a dependence must show in
MIRRORED = np.array([-1.0, -1.0, 1.0])


def shape_named(ratio: Array, wo: Array, wi: Array) -> str | None:
    """The factor and shape by which many values are off, if it is one of the usual ones."""
    h = wo + wi
    h = h / np.sqrt(np.sum(h * h, axis=1))[:, None]
    mu_i, mu_o, mu_h = wi[:, 2], wo[:, 2], h[:, 2]
    alone = bool(np.all(mu_o == mu_o[:1]))  # one wo: its cosine is a number like any other
    dot = np.sum(wo * h, axis=1)
    shapes = {
        "": np.ones_like(ratio),
        " cos_i": mu_i,
        " cos_o": mu_o,
        " cos_i cos_o": mu_i * mu_o,
        " n.h": mu_h,
        " wo.h": dot,
        " n.h/wo.h": mu_h / dot,
    }
    inverse = {f"/{name.strip()}": 1.0 / shape for name, shape in shapes.items() if name}
    for name, shape in {**shapes, **inverse}.items():
        quotient = ratio / shape
        if len(quotient) < 100 or not np.median(quotient) or (alone and "cos_o" in name):
            continue
        middle = float(np.median(quotient))
        spread = np.quantile(abs(quotient / middle - 1.0), 0.98)
        if not name and abs(middle - 1.0) <= spread + 1e-9:
            continue  # right nearly everywhere: no factor
        if spread < CLOSE:
            cause = _cause(name) if name else factor_named(middle) or _cause(name)
            return f"{middle:.6g}{name} everywhere: {cause}"
    return None


#: directions that a function is asked for by mistake -> how
MOVES: dict[str, Move] = {
    "with wo and wi swapped": lambda wo, wi: (wi, wo),
    "with wi turned by 180 degrees: around wo, or its mirror direction": lambda wo, wi: (
        wo,
        wi * MIRRORED,
    ),
    "turned by 90 degrees: tangent and bitangent are swapped": lambda wo, wi: (
        _quarter(wo),
        _quarter(wi),
    ),
}


def _quarter(w: Array) -> Array:
    return np.stack([-w[:, 1], w[:, 0], w[:, 2]], axis=-1)


def moved_named(ratio: At, wo: Array, wi: Array) -> str | None:
    """How directions must be changed for ratio(wo, wi) to become 1, if it is one of the usual ways
    of confusing them."""

    def one(values: Array) -> bool:
        values = values[np.isfinite(values)]
        return len(values) >= 100 and bool(np.quantile(np.abs(values - 1.0), 0.9) < CLOSE)

    if one(ratio(wo, wi)):  # it deviates in few places: not by confusing directions
        return None
    return next((name for name, move in MOVES.items() if one(ratio(*move(wo, wi)))), None)


def wider_named(ratio: Array, density: Array) -> str:
    """Whether a density is too high where it is high: then its lobe is narrower than what it is
    held against."""
    order = np.argsort(density)
    outer, inner = (np.median(part) for part in np.array_split(ratio[order], 2))
    if not abs(inner - outer) > 5.0 * CLOSE * abs(inner + outer):
        return ""
    kind = "narrower" if inner > outer else "wider"
    return f": pdf is {kind} than the draws, compare their roughness or exponent"


def azimuth_named(ratio: Array, w: Array) -> str:
    """Whether a ratio changes with the azimuth of w and with hardly anything else."""
    order = np.argsort(np.arctan2(w[:, 1], w[:, 0]))
    within = np.mean([np.var(part) for part in np.array_split(ratio[order], 32)])
    total = float(np.var(ratio))
    changes = within < 0.1 * total and total > CLOSE**2
    return ": it changes with the azimuth, look at how phi is drawn" if changes else ""


def dependence_named(ratio: At, wo: Array, wi: Array) -> str | None:
    """What the deviation of a ratio from 1 depends on, asked by moving the directions: on the half
    vector alone (distribution, Fresnel) or on the two polar angles alone (masking, cosines)."""
    before = ratio(wo, wi)
    for said, moved in (
        ("the half vector alone: look at the distribution and Fresnel", _about_half(wo, wi)),
        ("the polar angles alone: look at masking and cosines", (wo, _about_normal(wi))),
    ):
        above = (moved[0][:, 2] > 0.05) & (moved[1][:, 2] > 0.05)
        after = ratio(*moved)
        told = above & (np.abs(before - 1.0) > CLOSE) & np.isfinite(before) & np.isfinite(after)
        change = np.abs(after - before)[told] / np.abs(before - 1.0)[told]
        if len(change) >= FEWEST and np.quantile(change, 0.9) < 0.01:
            return f"the ratio depends on {said}"
    return None


def _about_half(wo: Array, wi: Array) -> Pairs:
    """Both directions turned by 0.7 rad about their half vector, which stays."""
    h = wo + wi
    h = h / np.sqrt(np.sum(h * h, axis=1))[:, None]
    c, s = math.cos(0.7), math.sin(0.7)

    def turned(w: Array) -> Array:
        along = np.sum(w * h, axis=1)[:, None] * h
        found: Array = c * w + s * np.cross(h, w) + (1.0 - c) * along
        return found

    return turned(wo), turned(wi)


def _about_normal(w: Array) -> Array:
    c, s = math.cos(0.7), math.sin(0.7)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)


def _cause(shape: str) -> str:
    if not shape:
        return "a constant factor: look at the normalisation"
    inverse = shape.startswith("/")
    return f"{shape.strip(' /')} is {'missing' if inverse else 'included, which does not belong'}"
