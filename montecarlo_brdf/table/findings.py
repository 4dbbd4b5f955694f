"""What is said of a table, as findings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from montecarlo_brdf.judge.finding import Bound, Finding, Verdict
from montecarlo_brdf.table.accord import LEVEL, Truth
from montecarlo_brdf.table.axes import points, said
from montecarlo_brdf.table.fresh import Deviation, Stand
from montecarlo_brdf.table.interpolation import Interpolation
from montecarlo_brdf.table.spot import Spot

MEASURED = "measured, not judged"


def of_cells(truth: Truth, checked: Sequence[Spot]) -> list[Finding]:
    """How well the cells are known, and whether another method says the same."""
    found = [_cells(truth, k) for k in range(len(truth.subject.measures))]
    return found + [_spot(spot) for spot in checked]


def _cells(truth: Truth, k: int) -> Finding:
    measure, places = truth.subject.measures[k], list(points(truth.subject.axes))
    values, errors = truth.cells.values[k].ravel(), truth.cells.errors[k].ravel()
    target, bad = truth.terms.target, ~np.isfinite(values)
    worst = int(np.argmax(np.where(bad, np.inf, errors)))
    where = said(truth.subject.axes, places[worst])
    if bad.any():
        note = f"{int(bad.sum())} of {len(values)} values are no numbers"
        return Finding(measure, where, Verdict.FAIL, value=float(values[worst]), note=note)
    late = int((errors > target).sum())
    spread = f"from {values.min():.6g} to {values.max():.6g}"
    missed = f"; {late} of {len(values)} cells did not get there" if late else ""
    return Finding(
        f"error of {measure}", where, Verdict.INCONCLUSIVE if late else Verdict.PASS,
        Bound.AT_MOST, float(errors[worst]), 0.0, target, 0.0, note=spread + missed,
    )  # fmt: skip


def _spot(spot: Spot) -> Finding:
    """A cell by quadrature: the tool's own numbers must not differ."""
    held = spot.apart <= 0.0
    note = None if held else (
        "two methods of this tool differ: no certificate of this table is worth anything, and the "
        "model has what one of them misses, as a narrow lobe that it does not declare"
    )  # fmt: skip
    return Finding(
        f"{spot.measure} by quadrature", spot.where,
        Verdict.PASS if held else Verdict.INCONCLUSIVE, Bound.EQUAL, spot.other, 0.0, spot.value,
        max(0.0, spot.apart + abs(spot.other - spot.value)), note=note,
    )  # fmt: skip


def of_interpolation(truth: Truth) -> list[Finding]:
    """What a table loses between its cells, and where it is clamped."""
    found = []
    for kind in Interpolation:
        inside, whole = truth.of_interpolation(kind)
        for k, measure in enumerate(truth.subject.measures):
            if inside:
                found.append(_measured(f"{measure}, {kind}", inside[k]))
            if not inside or abs(whole[k].worst) > abs(inside[k].worst):
                found.append(_measured(f"{measure}, {kind}, clamped", whole[k]))
    return found


def _measured(quantity: str, one: Deviation) -> Finding:
    return Finding(
        quantity, one.where, Verdict.SKIPPED, Bound.EQUAL, one.worst, one.error, samples=one.places,
        note=f"{MEASURED}; rms {one.rms:.1e}",
    )  # fmt: skip


def between_theirs(truth: Truth, stand: Stand) -> list[Finding]:
    """What a table of somebody else's is off between its cells."""
    if not len(truth.fresh.points):
        return []
    rows = truth.of_fresh(stand)
    return [_measured(f"{n} - truth, {Interpolation.LINEAR}", r)
            for n, r in zip(truth.subject.measures, rows, strict=True)]  # fmt: skip


def of_stand(
    truth: Truth, rows: Sequence[Deviation], tolerance: float | None
) -> list[Finding]:
    """How far something that stands for the table is off at most."""
    names = truth.subject.measures
    if tolerance is None:
        return [_measured(f"{n} - truth", r) for n, r in zip(names, rows, strict=True)]
    return [_judged(truth, k, row, tolerance) for k, row in enumerate(rows)]


def _judged(truth: Truth, k: int, row: Deviation, tolerance: float) -> Finding:
    verdict, level = Verdict.INCONCLUSIVE, None
    if math.isnan(row.worst) and math.isfinite(row.error):  # no number stands for none
        verdict = Verdict.FAIL
    elif row.most <= tolerance:
        verdict = Verdict.PASS
    elif not row.least <= tolerance:  # fresh randomisations must say so too
        row, level = truth.again(k, row), LEVEL
        refuted = not math.isfinite(row.worst) or row.least > tolerance
        verdict = Verdict.FAIL if refuted else Verdict.INCONCLUSIVE
    return Finding(
        f"{truth.subject.measures[k]} - truth", row.where, verdict, Bound.EQUAL, row.worst,
        row.error, 0.0, tolerance, level=level, samples=row.places, note=f"rms {row.rms:.1e}",
    )  # fmt: skip


def curve(truth: Truth, values: Any) -> list[list[tuple[float, ...]]]:
    """Cells as rows, one list per measure."""
    places = list(points(truth.subject.axes))
    flat = np.asarray(values).reshape(len(truth.subject.measures), -1)
    return [[(*p, float(v)) for p, v in zip(places, row, strict=True)] for row in flat]
