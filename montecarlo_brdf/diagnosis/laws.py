"""The laws, asked of stored values as they are or as a repair would make them."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from enum import StrEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.diagnosis.geometry import Geometry
from montecarlo_brdf.diagnosis.stored import Draws, Stored
from montecarlo_brdf.diagnosis.words import MOST
from montecarlo_brdf.judge.diagnosis import Part
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

EXACT = 1e-6  # of laws of f, relative
DENSITY = 2e-3  # pdf against the density of the draws, which is a quotient of differences
ENERGY = 2e-3  # beyond 1
SURE = 4.5  # standard errors
KNOWN_ERROR = 1e-4  # of an albedo that a check measured
LOST = 0.01  # of the albedo, that is never drawn
DARK = 1e-9  # of the largest value: rounding


class Law(StrEnum):
    """What must hold, as a sentence has it."""

    FINITE = "f is finite"
    POSITIVE = "f >= 0"
    ENERGY = "A <= 1"
    REVERSE = "R <= 1"
    ALBEDO = "A = declared"
    RECIPROCITY = "f = f'"
    ISOTROPY = "f turned = f"
    SAME = "f = declared"
    DENSITY = "pdf = density of the draws"
    MASS = "int pdf + rejected = 1"
    COVER = "pdf > 0 where f > 0"
    WEIGHT = "weight = f cos/pdf"
    WEIGHT_FINITE = "weight is finite"
    DRAWN = "draws are finite"
    UNIT = "draws are of unit length"
    ABOVE = "draws are above the horizon"


#: what is at fault where a law is broken
PARTS = {
    Part.VALUES: (Law.FINITE, Law.POSITIVE),
    Part.F: (Law.ENERGY, Law.REVERSE, Law.ALBEDO, Law.RECIPROCITY, Law.ISOTROPY, Law.SAME),
    Part.PDF: (Law.DENSITY, Law.MASS, Law.COVER),
    Part.WEIGHT: (Law.WEIGHT, Law.WEIGHT_FINITE),
    Part.DRAWS: (Law.DRAWN, Law.UNIT, Law.ABOVE),
}
PART_OF = {law: part for part, some in PARTS.items() for law in some}


class Broken(NamedTuple):
    """By how much a law is broken, and at which spot."""

    amount: float
    spot: int


Failures = dict[Law, list[Broken]]
#: by what f is divided, for geometry and the number of a spot
Divisor = Callable[[Geometry, int], "Array"]


class Laws:
    """The laws of one stored model."""

    def __init__(self, at: Stored) -> None:
        self.at = at
        self.usable = [k for k, d in enumerate(at.draws) if len(d.f) >= 12]

    def of_f(self, divisor: Divisor | None = None) -> Failures:
        """Laws of f, of f divided."""
        failed: Failures = {}
        for k in range(len(self.at.nodes)):
            _add(failed, self._energy(k, divisor))
            _add(failed, self._symmetries(k, divisor))
        for t in self.at.targets:
            by = divisor(self.at.nodes[t.spot].g, t.spot) if divisor else 1.0
            off = _apart(t.have / by, t.want, 1e-6 * float(np.nanmedian(t.want)))
            if off > EXACT:
                failed.setdefault(Law.SAME, []).append(Broken(off, t.spot))
        return failed

    def albedo(self, k: int, by: Array | float = 1.0) -> tuple[float, float]:
        """(A, standard error) by the nodes; a constant's integral is known."""
        n = self.at.nodes[k]
        f = np.where(np.isfinite(n.f), n.f, 0.0) / by
        middle = float(np.median(f))
        both = [n.mean(n.g.cos_i * f), n.mean(n.g.cos_i * (f - middle))]
        both[1] = both[1][0] + middle * math.pi, both[1][1]
        return min(both, key=lambda e: e[1])

    def _energy(self, k: int, divisor: Divisor | None) -> Failures:
        spot, n, found = self.at.spots[k], self.at.nodes[k], Failures()
        by = divisor(n.g, k) if divisor else 1.0
        disclaims = self.at.model.disclaims
        value, error = self.albedo(k, by)
        if spot.albedo is not None and not (spot.own and self.at.draws and self.pdf_broken):
            plain = self.albedo(k)[0]
            moved = value / plain if divisor and plain > 0.0 else 1.0
            value, error = spot.albedo * moved, KNOWN_ERROR
        over = value - SURE * error > 1.0 + ENERGY and error < 0.05 * value
        if over and Property.ENERGY not in disclaims:
            found[Law.ENERGY] = [Broken(value, k)]
        if Property.ENERGY not in disclaims:
            finite = np.where(np.isfinite(n.back), n.back, 0.0)
            back, e = n.mean(n.g.cos_i * finite / (divisor(n.g.swapped(), k) if divisor else 1.0))
            if spot.reverse is not None:
                plain = n.mean(n.g.cos_i * finite)[0]
                moved = back / plain if divisor and plain > 0.0 else 1.0
                back, e = spot.reverse * moved, KNOWN_ERROR
            if back - SURE * e > 1.0 + ENERGY and e < 0.05 * back and not over:
                found[Law.REVERSE] = [Broken(back, k)]
        due = self.at.declared[k]
        known = due is not None and error < 0.02 * max(value, 1e-9)
        if due is not None and known and abs(value - due) > SURE * error + 5e-4 * due:
            found[Law.ALBEDO] = [Broken(value / due if due else math.inf, k)]
        return found

    @functools.cached_property
    def pdf_broken(self) -> bool:
        """Whether pdf is not the density of the draws."""
        return bool(self.of_pdf())

    def _symmetries(self, k: int, divisor: Divisor | None) -> Failures:
        m, v, found = self.at.model, self.at.pairs[k], Failures()
        if Property.RECIPROCITY not in m.disclaims:
            a, b = v.ab, v.ba
            if divisor:
                a, b = a / divisor(v.g, k), b / divisor(v.g.swapped(), k)
            off = _apart(a, b, DARK * _top(np.maximum(abs(a), abs(b))))
            if off > EXACT:
                found[Law.RECIPROCITY] = [Broken(off, k)]
        if m.isotropic and Property.ISOTROPY not in m.disclaims:
            some = v.ab[: len(v.turned)]
            least = DARK * _top(abs(some))
            off = max(_apart(some, other, least) for other in (v.turned, v.mirrored))
            if off > EXACT:
                found[Law.ISOTROPY] = [Broken(off, k)]
        return found

    def of_pdf(self, pdf: Callable[[Draws, int], Array] | None = None) -> Failures:
        """Laws of pdf; of another pdf at the draws, what is known of it there."""
        failed: Failures = {}
        if not self.at.model.pdf:
            return failed
        for k in self.usable:
            d = self.at.draws[k]
            ratio = d.over(pdf(d, k)) if pdf else d.ratio
            ratio = ratio[np.isfinite(ratio)]
            if len(ratio) >= 10:
                off = float(np.quantile(np.abs(ratio - 1.0), MOST))
                if off > DENSITY:
                    failed.setdefault(Law.DENSITY, []).append(Broken(off, k))
        if pdf is None:
            for k in range(len(self.at.draws)):
                _add(failed, self._mass(k, Law.DENSITY in failed))
        return failed

    def mass(self, k: int) -> tuple[float, float]:
        """(int pdf, standard error) by the nodes."""
        n = self.at.nodes[k]
        assert n.pdf is not None
        return n.mean(np.where(np.isfinite(n.pdf), n.pdf, 0.0))

    def _mass(self, k: int, resolved: bool) -> Failures:
        """int pdf, unless it is too little alone: then the nodes may miss its lobe."""
        found, n, rejected = Failures(), self.at.nodes[k], self.at.draws[k].rejected
        assert n.pdf is not None
        value, error = self.mass(k)
        off = value + rejected - 1.0
        luck = math.sqrt(rejected * (1.0 - rejected) / len(self.at.draws[k].many) + 1e-5)
        known = (off > 0.0 or resolved) and error < 0.05
        if known and abs(off) > SURE * (error + luck) + 0.01:
            found[Law.MASS] = [Broken(off, k)]
        light = np.where(np.isfinite(n.f), n.f, 0.0) * n.g.cos_i * n.weight
        lost = float(light[n.pdf == 0.0].sum() / max(light.sum(), 1e-300))
        if lost > LOST:
            found[Law.COVER] = [Broken(lost, k)]
        return found

    def due(self, d: Draws) -> Array:
        """f cos/pdf of draws, or over their density if there is no pdf."""
        density = d.pdf if self.at.model.pdf else d.density
        with np.errstate(all="ignore"):
            return d.f * d.g.cos_i / density

    @property
    def weight_tolerance(self) -> float:
        """Against pdf weights are exact."""
        return EXACT if self.at.model.pdf else DENSITY

    def of_weight(self) -> Failures:
        """Laws of weights."""
        failed: Failures = {}
        for k in self.usable:
            d = self.at.draws[k]
            if not np.isfinite(d.weight).any():
                continue
            above = d.finite & (d.many[:, 2] > 0.0)
            lost = float(np.mean(~np.isfinite(d.many_weight[above])))
            if lost > 0.0:
                failed.setdefault(Law.WEIGHT_FINITE, []).append(Broken(lost, k))
            due = self.due(d)
            ok = np.isfinite(d.weight) & np.isfinite(due) & (due > 0.0)
            if ok.sum() >= 8:
                off = float(np.quantile(np.abs(d.weight / due - 1.0)[ok], MOST))
                if off > self.weight_tolerance:
                    failed.setdefault(Law.WEIGHT, []).append(Broken(off, k))
        return failed

    def of_draws(self) -> Failures:
        """Laws of draws."""
        failed: Failures = {}
        for k, d in enumerate(self.at.draws):
            length = np.linalg.norm(np.where(d.finite[:, None], d.many, 0.0), axis=1)
            up = d.finite & (d.many[:, 2] > 0.0)
            apart = np.abs(length - 1.0)[up]
            if not d.finite.all():
                failed.setdefault(Law.DRAWN, []).append(Broken(float(np.mean(~d.finite)), k))
            if (apart > EXACT).any():
                failed.setdefault(Law.UNIT, []).append(Broken(float(apart.max()), k))
            if d.rejected > 0.999:
                failed.setdefault(Law.ABOVE, []).append(Broken(1.0, k))
        return failed


def _add(failed: Failures, more: Failures) -> None:
    for law, found in more.items():
        failed.setdefault(law, []).extend(found)


def _top(values: Array) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.max()) if len(finite) else 0.0


def _apart(a: Any, b: Any, least: float) -> float:
    """The largest relative difference; least: what is rounding of the larger value."""
    ok = np.isfinite(a) & np.isfinite(b)
    with np.errstate(all="ignore"):
        larger = np.maximum(np.maximum(abs(a), abs(b)), (least if least > 0.0 else 0.0) + 1e-300)
        off = np.where(ok, abs(a - b) / larger, 0.0)
    return float(off.max(initial=0.0))
