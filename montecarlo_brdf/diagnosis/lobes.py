"""Repairs of a pdf of several lobes: pdf = sum of c_k p_k with which c_k?"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis.geometry import NONE, SHAPES, cost, monomial
from montecarlo_brdf.diagnosis.laws import DENSITY, Failures, Law
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.stored import missing
from montecarlo_brdf.diagnosis.words import constant, mistake, shape_said
from montecarlo_brdf.judge.diagnosis import Part

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array
    from montecarlo_brdf.diagnosis.of_pdf import Known
    from montecarlo_brdf.diagnosis.stored import Draws
    from montecarlo_brdf.estimate.density import Density

FEWEST = 3  # places
APART = 0.01  # of a probability: shares that differ by less are the same
CONDITION = 1e5  # lobes that cannot be told apart
ROUNDS = 30  # of reweighting towards least absolute deviations
FITS = 0.8  # of the draws: some may lack a root


def lobes(known: Known, failed: Failures) -> Iterator[Repair]:
    """Probabilities exchanged, one lobe alone, others, or one lobe with a factor."""
    mixed = [d for d in known.draws if d.of and len(d.of.shares) > 1]
    if Law.DENSITY not in failed or len(mixed) < FEWEST:
        return
    n = max(len(_of(d).shares) for d in mixed)
    mixed = [d for d in mixed if len(_of(d).shares) == n]
    if len(mixed) < FEWEST:
        return
    fits = [_fit(d) for d in mixed]
    if any(f is not None and not f[1] for f in fits):
        said = _one_with_a_factor(mixed, n)
    else:
        rows = [(f[0], _of(d).shares) for f, d in zip(fits, mixed, strict=True) if f]
        said = _shares(np.array([a for a, _ in rows]), np.array([b for _, b in rows])) \
            if len(rows) >= FEWEST else None
    if said:
        yield repair(Part.PDF, said[1], said[0], Part.WEIGHT)


def _of(d: Draws) -> Density:
    assert d.of
    return d.of


def _fit(d: Draws) -> tuple[Array, bool] | None:
    """(c_k, whether pdf is their sum); None where they cannot be told apart."""
    ok = np.isfinite(d.density) & np.isfinite(d.pdf) & (d.pdf > 0.0) & ~missing(_of(d))
    if ok.sum() < 10:
        return None
    a = _of(d).lobes[ok] / d.pdf[ok][:, None]
    if np.linalg.cond(a) > CONDITION:
        return None
    one = np.ones(len(a))
    c = np.linalg.lstsq(a, one, rcond=None)[0]
    for _ in range(ROUNDS):
        weight = 1.0 / np.sqrt(np.maximum(np.abs(a @ c - one), 1e-7))
        c = np.linalg.lstsq(a * weight[:, None], weight, rcond=None)[0]
    return c, bool(np.quantile(np.abs(a @ c - one), FITS) < 2.0 * DENSITY)


def _shares(got: Array, due: Array) -> tuple[str, float] | None:
    n = due.shape[1]
    if np.max(np.abs(got - due)) < APART:
        return None
    for order in itertools.permutations(range(n)):
        if order != tuple(range(n)) and np.max(np.abs(got - due[:, order])) < APART:
            return (f"pdf chooses among lobes with the probabilities exchanged: sample draws them "
                    f"{_listed(due[0])}, pdf weighs them {_listed(got[0])}"), 2.5
    for k in range(n):
        if np.max(np.abs(got - np.eye(n)[k])) < APART:
            return (f"pdf is that of one lobe alone (number {k + 1} of {n}); sample chooses among "
                    f"lobes {_listed(due[0])}"), 2.5
    if np.max(np.abs(got.sum(axis=1) - 1.0)) < 2.0 * APART and got.min() > -APART:
        worst = int(np.argmax(np.abs(got - due).max(axis=1)))
        return (f"pdf chooses among lobes with other probabilities than sample: sample draws them "
                f"{_listed(due[worst])}, pdf weighs them {_listed(got[worst])} (worst case)"), 3.0
    ratio = got / due
    k = int(np.argmax(np.abs(ratio - 1.0).max(axis=0)))
    others = np.max(np.abs(np.delete(ratio, k, axis=1) - 1.0))
    c = float(ratio[:, k].mean())
    if others < APART and np.ptp(ratio[:, k]) < APART and (named := mistake(c, APART)):
        return f"pdf, lobe {k + 1} of {n} alone: {named}", 3.0
    return None


def _listed(shares: Array) -> str:
    return " : ".join(f"{x:.3g}" for x in shares)


def _one_with_a_factor(mixed: list[Draws], n: int) -> tuple[str, float] | None:
    """One lobe's part has a monomial too much."""
    for k in range(n):
        for e in SHAPES:
            if e == NONE or cost(e) > 2:
                continue
            cs = []
            for d in mixed:
                c = _alone(d, k, monomial(d.g, e))
                if c is None:
                    break
                cs.append(c)
            else:
                c = float(np.mean(cs))
                named = mistake(c, 5e-3)
                if np.ptp(cs) < APART * c and (abs(c - 1.0) < 5e-3 or named):
                    more = f" and {named}" if named else ""
                    return f"pdf, lobe {k + 1} of {n} alone: {shape_said(e)}{more}", 3.0 + cost(e)
    return None


def _alone(d: Draws, k: int, shape: Array) -> float | None:
    of = _of(d)
    ok = np.isfinite(d.density) & np.isfinite(d.pdf)
    part = of.lobes[ok, k] * of.shares[k]
    rest = of.lobes[ok] @ of.shares - part
    mine = part > 0.05 * (part + rest)
    if mine.sum() <= 8:
        return None
    return constant((d.pdf[ok] - rest)[mine] / (part * shape[ok])[mine], 4.0 * DENSITY, FITS)
