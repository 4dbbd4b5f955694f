"""Repairs of the weight that a sampler returns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis.geometry import cost
from montecarlo_brdf.diagnosis.laws import DENSITY, Failures, Law, Laws
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.stored import Draws
from montecarlo_brdf.diagnosis.words import factor, mistake, shape_said
from montecarlo_brdf.judge.diagnosis import Part

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array


def on_average(laws: Laws) -> bool:
    """Whether weights are f cos/density on average over the numbers that give a direction, as of
    one lobe out of several: unbiased, no fault."""
    some = [laws.at.draws[k] for k in laws.usable]
    some = [d for d in some if d.of is not None and np.isfinite(d.weight).any()]
    if not some:
        return False
    for d in some:
        assert d.of
        with np.errstate(all="ignore"):
            ratio = d.of.mean_weight * d.density / (d.f * d.g.cos_i)
        ratio = ratio[np.isfinite(ratio)]
        if len(ratio) > 8 and np.quantile(np.abs(ratio - 1.0), 0.9) > 3.0 * DENSITY:
            return False
    return any(np.isfinite(d.density).sum() > 8 for d in some)


def weights(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """What the weight is, in place of f cos/pdf."""
    if Law.WEIGHT not in failed:
        return
    known = [laws.at.draws[k] for k in laws.usable]
    index = [k for k in laws.usable if np.isfinite(laws.at.draws[k].weight).any()]
    known = [laws.at.draws[k] for k in index]
    slips = list(_slips(laws, known))
    yield from slips
    with np.errstate(all="ignore"):
        rows = [(d.weight / laws.due(d), d.g) for d in known]
    sets = [laws.at.spots[k].p for k in index]
    found = factor(rows, sets, laws.at.names, laws.weight_tolerance)
    if found is None or found.each:
        return
    c, named = found.constant, mistake(found.constant, 1e-3)
    if cost(found.exponents):
        rest = found._replace(exponents=(0, 0, 0, 0))
        more = "" if rest.plain and abs(c - 1.0) < 1e-3 else f", and a factor {rest}"
        if not slips:
            yield _weight(3.0, f"weight: {shape_said(found.exponents)}{more}")
    elif found.word.text:
        inverse = found.word.text.startswith("1/")
        said = f"{found.word.text[2:]} is missing" if inverse else \
            f"{found.word.text} is included, which does not belong"
        more = f", {named}" if named else ""
        if not slips:
            yield _weight(3.0, f"weight: {said}{more}: weight pdf/(f cos) = {found}")
    else:
        said = named or f"constant factor {c:.5g}: normalisation"
        yield _weight(1.9 if named and _flat(known) else 2.0,
                      f"weight: {said} (weight pdf/(f cos) = {c:.6g})")


def _weight(penalty: float, sentence: str) -> Repair:
    return repair(Part.WEIGHT, penalty, sentence)


def _flat(known: list[Draws]) -> bool:
    """Whether f is a constant: then a weight of f is a constant factor too."""
    return all(np.ptp(d.f) < 1e-9 * np.max(d.f) for d in known)


def _slips(laws: Laws, known: list[Draws]) -> Iterator[Repair]:
    """What people return in place of f cos/pdf."""

    def density(d: Draws) -> Array:
        return d.pdf if laws.at.model.pdf else d.density

    slips: dict[str, Callable[[Draws], Array]] = {
        "the weight is f cos: it is not divided by the pdf": lambda d: d.f * d.g.cos_i,
        "the weight is f/pdf: cos_i is missing": lambda d: d.f / density(d),
        "the weight is f: neither cos_i nor 1/pdf": lambda d: d.f,
        "the weight is 1/pdf: f cos is missing": lambda d: 1.0 / density(d),
    }
    tolerance = max(laws.weight_tolerance, 1e-5)
    for said, slip in slips.items():
        with np.errstate(all="ignore"):
            offs = [np.abs(d.weight / slip(d) - 1.0) for d in known]
        finite = [off[np.isfinite(off)] for off in offs]
        if all(len(off) > 8 and np.quantile(off, 0.95) < tolerance for off in finite):
            yield _weight(2.0, said)
