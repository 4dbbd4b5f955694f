"""Repairs of values: leave out a region; of draws: leave out those at fault."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.diagnosis.laws import Failures, Law, Laws
from montecarlo_brdf.diagnosis.region import Region, region
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.judge.diagnosis import Part
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    Flags = Any

ROUNDING = 1e-12  # of the median of |f|
UNIT = 1e-6  # of a length


def negative(at: Look) -> Flags:
    """Which values lie below zero by more than rounding."""
    usual = float(np.nanmedian(np.abs(at.f[np.isfinite(at.f)]))) if np.isfinite(at.f).any() else 0.0
    return np.isfinite(at.f) & (at.f < -ROUNDING * usual)


def of_points(laws: Laws) -> Failures:
    """The laws of values, at the points that all checks look at."""
    at, failed = look(laws.at.case), Failures()
    if (lost := ~np.isfinite(at.f)).any():
        failed[Law.FINITE] = [(float(lost.sum()), 0)]  # type: ignore[list-item]
    if (low := negative(at)).any() and Property.POSITIVITY not in laws.at.model.disclaims:
        failed[Law.POSITIVE] = [(float(low.sum()), 0)]  # type: ignore[list-item]
    return failed


def regions(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """Where f is not finite, or negative; it mends laws of f if these hold on the rest."""
    at = look(laws.at.case)
    lost, low = ~np.isfinite(at.f), negative(at)
    if Law.POSITIVE not in failed:
        low = np.zeros(len(at), dtype=bool)
    kinds = [(lost, "f is not finite"), (low, "f is negative")]
    if lost.any() and low.any():
        kinds = [(lost | low, "f is negative or not finite"), (lost, "f is not finite")]
    names = list(at.case.free)
    for bad, said in kinds:
        if bad.any() and (found := region(at, bad, names)):
            more = " (it is also negative elsewhere)" if (low & ~bad).any() else ""
            holds = not any(law in failed for law in _OF_F)
            also = (Part.F,) if holds else ()
            yield repair(Part.VALUES, 1.0, f"{said} {_exactly(found)}{more}", *also)
            return


_OF_F = (Law.ENERGY, Law.REVERSE, Law.ALBEDO, Law.RECIPROCITY, Law.ISOTROPY, Law.SAME)


def _exactly(found: Region) -> str:
    if found.where == "everywhere":
        return "everywhere"
    return f"exactly where {found}" if found.whole else f"where {found}"


def draws(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """Draws that are not unit vectors, not finite, or all below the horizon: leave these out, or
    normalise them."""
    at = look(laws.at.case)
    w, weights = at.draws
    finite: Flags = np.isfinite(w).all(axis=1)
    length = np.sqrt(np.sum(np.where(finite[:, None], w, 0.0) ** 2, axis=1))
    above = finite & (w[:, 2] > 0.0)
    odd = above & (np.abs(length - 1.0) > UNIT)
    names = list(at.case.free)
    if odd.any() and finite.all():
        far = float(np.max(np.abs(length - 1.0)[odd]))
        share = 100.0 * float(odd[above].mean())
        said = "sample: directions are not of unit length"
        said += f" ({share:.0f} % of them, by up to {far:.2g})"
        yield repair(Part.DRAWS, 0.0, said, Part.PDF, Part.WEIGHT)
    elif not finite.all():
        found = region(at, ~finite, names, of_wo=True)
        if found is None:
            found = _of_numbers(at, ~finite)
        if found and not odd.any():
            also = () if Law.DENSITY in failed else (Part.PDF, Part.WEIGHT)
            said = f"sample: directions are not finite {_exactly(found)}"
            yield repair(Part.DRAWS, 0.0, said, *also)
    elif not above.any():
        yield repair(Part.DRAWS, 0.0, "sample: all draws are below the horizon", Part.PDF)
    elif weighted(at.model) and (bad := above & ~np.isfinite(weights)).any():
        turned = _drawn(at, w, above)
        if found := region(turned, bad[above], names):
            said = f"sample: the weight is not finite {_exactly(found)}"
            yield repair(Part.WEIGHT, 1.0, said.replace("cos_i", "the draw's cos_i"))


def _of_numbers(at: Look, bad: Flags) -> Region | None:
    """A number u at an end of its range."""
    u = at.points.u
    for k in range(3):
        for end in (0.0, 1.0):
            inside = np.abs(u[:, k] - end) < 1e-9
            if inside.any() and not (bad & ~inside).any():
                return Region(f"u[{k}] = {end:g}", bool(bad[inside].all()))
    return None


class _Some:
    """Points of a look with other wi, some of them."""

    def __init__(self, at: Look, w: Any, keep: Flags) -> None:
        self.case, self.model = at.case, at.model
        self.points = at.points._replace(wi=np.where(keep[:, None], w, at.points.wi)).at(keep)


def _drawn(at: Look, w: Any, keep: Flags) -> Any:
    return _Some(at, w, keep)
