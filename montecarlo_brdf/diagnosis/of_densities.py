"""Repairs by known densities: what sample draws, and what pdf is."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis import known as library
from montecarlo_brdf.diagnosis.geometry import SHAPES, cost
from montecarlo_brdf.diagnosis.laws import DENSITY, EXACT, Failures, Law
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.words import MOST, factor, mistake
from montecarlo_brdf.judge.diagnosis import Part

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array
    from montecarlo_brdf.diagnosis.of_pdf import Known

    #: of every place
    Values = list[Array]


def densities(known: Known, failed: Failures) -> Iterator[Repair]:
    """Which known density are the draws', which is pdf?"""
    if Law.DENSITY not in failed:
        return
    table = dict(_table(known))
    everywhere = list(range(len(known.draws)))
    bad = [i for i, k in enumerate(known.index) if k in known.bad]
    draws = next((n for n, v in table.items() if _are_draws(known, v)), None)
    if draws is None:
        yield from _powers(known)
        return
    pdf = next((n for n, v in table.items() if _is_pdf(known, v, everywhere)), None)
    pdf = pdf or _times_a_cosine(known, table)
    plain = {draws, pdf} <= {library.COSINE, library.UNIFORM}
    if pdf:
        said = f"sample draws {draws}, pdf is that of {pdf}"
        yield repair(Part.PDF, 2.4 if plain else 3.0, said, Part.WEIGHT)
        return
    others = (n for n, v in table.items() if n != draws and _is_pdf(known, v, bad))
    if there := next(others, None):
        said = f"sample draws {draws}, pdf is that of {there} at {len(bad)} of " \
               f"{len(known.index)} cases: look at its branches"
        yield repair(Part.PDF, 4.0, said, Part.WEIGHT)


def _table(known: Known) -> Iterator[tuple[str, Values]]:
    for name, plain in library.PLAIN.items():
        yield name, [plain(d.g) for d in known.draws]
    with np.errstate(all="ignore"):
        for k in known.at.model.Params._fields:
            xs = [float(getattr(p, k)) for p in known.sets]
            for one in library.densities():
                values = [one.value(d.g, x) for d, x in zip(known.draws, xs, strict=True)]
                yield one.name.format(k), values


def _are_draws(known: Known, values: Values) -> bool:
    rows = zip(values, known.draws, strict=True)
    return all(_alike(d.over(v), DENSITY) for v, d in rows)


def _is_pdf(known: Known, values: Values, index: list[int]) -> bool:
    with np.errstate(all="ignore"):
        return bool(index) and all(_alike(values[i] / known.draws[i].pdf, EXACT) for i in index)


def _alike(ratio: Array, tolerance: float) -> bool:
    ratio = ratio[np.isfinite(ratio)]
    return len(ratio) >= 10 and bool(np.quantile(np.abs(ratio - 1.0), MOST) < tolerance)


def _times_a_cosine(known: Known, table: dict[str, Values]) -> str | None:
    """A known density times one cosine and a constant that has a name."""
    shapes = [e for e in SHAPES if cost(e) <= 1]
    for name, values in table.items():
        with np.errstate(all="ignore"):
            rows = [(d.pdf / v, d.g) for d, v in zip(known.draws, values, strict=True)]
        found = factor(rows, known.sets, known.at.names, EXACT, shapes=shapes)
        if found is None or found.each or found.word.text:
            continue
        if abs(found.constant - 1.0) < EXACT or mistake(found.constant, 1e-5):
            return f"{name}, times {found}"
    return None


def _powers(known: Known) -> Iterator[Repair]:
    """Two powers of the cosine."""
    powers = []
    for d in known.draws:
        ok = np.isfinite(d.density) & (d.pdf > 0.0)
        if ok.sum() < 10:
            return
        a = np.stack([np.ones(ok.sum()), np.log(d.g.cos_i[ok])], axis=1)
        both = []
        for y in (np.log(d.density[ok]), np.log(d.pdf[ok])):
            c = np.linalg.lstsq(a, y, rcond=None)[0]
            if np.quantile(np.abs(a @ c - y), MOST) > DENSITY:
                return
            both.append(float(c[1]))
        powers.append(both)
    drawn, said = np.mean(powers, axis=0)
    if np.ptp([p[0] for p in powers]) < 0.01 and abs(drawn - said) > 1e-3:
        kind = "narrower" if said > drawn else "wider"
        text = f"sample draws cos_i^{drawn:.4g}, pdf is that of cos_i^{said:.4g}: pdf is {kind} " \
               "than the draws"
        yield repair(Part.PDF, 4.0, text, Part.WEIGHT)
