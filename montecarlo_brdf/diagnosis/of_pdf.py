"""Repairs of pdf, held against the density that draws really have."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis.ask import asked
from montecarlo_brdf.diagnosis.geometry import Geometry, cost
from montecarlo_brdf.diagnosis.laws import DENSITY, SURE, Failures, Law, Laws
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.stored import AZIMUTH, BELOW, QUARTER, TURNED, Draws
from montecarlo_brdf.diagnosis.words import MOST, Factor, constant, factor, mistake, shape_said
from montecarlo_brdf.judge.diagnosis import Part

if TYPE_CHECKING:
    from montecarlo_brdf.cases.case import Parameters
    from montecarlo_brdf.diagnosis.geometry import Array

PROBABLE = 0.005  # error of a share of draws
MASS_ERROR = 0.01


class Known:
    """The spots where the density of the draws is known, and how pdf fails there."""

    def __init__(self, laws: Laws, failed: Failures) -> None:
        self.laws, self.at = laws, laws.at
        self.index = [k for k in laws.usable if self.at.draws[k].known]
        self.draws = [self.at.draws[k] for k in self.index]
        self.sets = [self.at.spots[k].p for k in self.index]
        self.bad = {b.spot for b in failed.get(Law.DENSITY, [])}
        self.mass_holds = Law.MASS not in failed

    def ratios(self) -> list[tuple[Array, Geometry]]:
        """pdf over density of each."""
        return [(d.ratio, d.g) for d in self.draws]


def _pdf(sentence: str, penalty: float, **more: Callable[[Geometry, int], Array]) -> Repair:
    return repair(Part.PDF, penalty, sentence, Part.WEIGHT, **more)


def uncovered(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf is right where draws are: they are not everywhere, or it is."""
    if Law.DENSITY in failed:
        return
    if Law.COVER in failed:
        worst = max(failed[Law.COVER])
        theta = known.at.spots[worst.spot].theta
        said = f"sample never draws where f is not 0 (pdf is 0 there): {100 * worst.amount:.3g} %"
        yield _pdf(f"{said} of A at {theta:.4g} degrees", 5.0)
    elif Law.MASS in failed and all(b.amount > 0.0 for b in failed[Law.MASS]):
        low, high = (1.0 + f([b.amount for b in failed[Law.MASS]]) for f in (min, max))
        said = "pdf is right where sample draws, but not 0 where it never does"
        yield _pdf(f"{said}: int pdf + rejected = {low:.3g} to {high:.3g}", 6.0)


def folded(known: Known, failed: Failures) -> Iterator[Repair]:
    """Draws below the horizon folded up: pdf counts one of the two that give a direction."""
    if Law.DENSITY not in failed or any(d.rejected for d in known.draws):
        return
    several = [float(np.mean(d.of.roots.max(axis=1) > 1)) for d in known.draws if d.of]
    if np.mean(several) > 0.02:
        up = [_nearly(d.moved[BELOW], d) for d in known.draws]
        single = all(len(d.of.shares) == 1 for d in known.draws if d.of)
        one = [float(np.mean(_best(d) < DENSITY)) for d in known.draws]
        if min(up) > 0.85 or (single and min(one) > 0.8 and np.mean(one) > 0.9):
            yield _pdf("sample: draws below the horizon are folded up, not rejected: pdf is the "
                       "density of one of the two draws that give a direction", 3.0)
            return
    if _one_root_each(known):
        yield _pdf("sample: draws of a lobe below the horizon are folded up, not rejected: pdf "
                   "counts one of the two draws that give a direction", 3.0)


def _nearly(other: Array, d: Draws) -> float:
    assert d.of
    with np.errstate(all="ignore"):
        off = np.fmin(np.abs(d.pdf / d.of.own - 1.0), np.abs(other / d.of.own - 1.0))
    return float(np.nanmean(off < DENSITY))


def _best(d: Draws) -> Array:
    """How far pdf is from what one of at most two roots adds to the density."""
    assert d.of
    with np.errstate(all="ignore"):
        own, rest = d.pdf / d.of.own, d.pdf / (d.of.density - d.of.own)
        off = np.where(d.of.roots.sum(axis=1) > 1, np.fmin(abs(own - 1.0), abs(rest - 1.0)),
                       abs(own - 1.0))  # fmt: skip
    return np.where(np.isfinite(off), off, math.inf)


def _one_root_each(known: Known) -> bool:
    """Whether pdf counts, of two roots in the lobe that was drawn, one alone, where it is wrong."""
    rows: list[tuple[bool, bool]] = []
    for d in known.draws:
        if d.of is None or len(d.of.shares) < 2:
            continue
        lobe = np.argmax([piece.within(d.u) for piece in d.of.pieces], axis=0)
        each = np.arange(len(d.u))
        part = d.of.lobes[each, lobe] * d.of.shares[lobe]
        others = d.of.roots.sum(axis=1) - d.of.roots[each, lobe]
        single = others <= len(d.of.shares) - 1
        with np.errstate(all="ignore"):
            off = np.abs(d.pdf / d.of.density - 1.0)
            options = [d.of.density, d.of.density - d.of.own, d.of.density - part + d.of.own]
            least = np.min([np.abs(x / d.pdf - 1.0) for x in options], axis=0)
        ok = np.isfinite(off) & single
        rows += list(zip(off[ok] > 2.0 * DENSITY, least[ok] < 2.0 * DENSITY, strict=True))
    if not rows:
        return False
    bad, fits = np.array(rows, dtype=bool).T
    return bool(bad.sum() > 10 and fits.mean() > 0.75 and fits[bad].mean() > 0.4)


def rejected(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf integrates to 1 although draws are rejected."""
    lost = [d.rejected for d in known.draws]
    if Law.DENSITY not in failed or max(lost, default=0.0) < 0.02:
        return
    for k, d, r in zip(known.index, known.draws, lost, strict=True):
        c, (mass, error) = constant(d.ratio, DENSITY), known.laws.mass(k)
        luck = SURE * math.sqrt(r * (1.0 - r) / len(d.many)) + PROBABLE
        if c is None or abs(c * (1.0 - r) - 1.0) > luck:
            return
        if abs(mass - 1.0) > SURE * error + MASS_ERROR:
            return
    yield _pdf(f"pdf knows nothing of the rejected draws: it integrates to 1, yet "
               f"{min(lost):.3g} to {max(lost):.3g} of the draws are rejected (horizon)", 1.5)


def factors(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf times a factor that is the same everywhere, or one for each place."""
    if Law.DENSITY not in failed:
        return
    names = known.at.names
    found = factor(known.ratios(), known.sets, names, DENSITY)
    if found is None:
        return
    if found.each:
        yield from _by_place(known, found.each)
        return
    if found.plain and abs(found.constant - 1.0) < DENSITY:
        return
    share = found.constant < 1.0 and known.mass_holds
    if found.plain and not share and _too_full(known, found.constant):
        return  # divided by it, pdf would add up to more than 1: the fault may be the draws'
    said = _factor_said(known, found)
    extra = 0.5 * cost(found.exponents) + (1.0 if found.word.text else 0.0)
    spots = known.at.spots
    yield _pdf(said, 2.0 + extra,
               divisor=lambda g, k: found.at(g, spots[k].p))


def _too_full(known: Known, c: float) -> bool:
    """Whether pdf/c surely has more mass somewhere than its draws that are not rejected."""
    masses = ((known.laws.mass(k), known.at.draws[k].rejected) for k in known.index)
    return any(m / c + rejected - 1.0 > SURE * e / c + MASS_ERROR for (m, e), rejected in masses)


def _factor_said(known: Known, found: Factor) -> str:
    c = found.constant
    named = mistake(c, 1e-3)
    if found.plain:
        if c < 1.0 and known.mass_holds:
            return f"sample draws only a share {c:.4g} of the directions, all of which pdf " \
                   f"covers: {_gap(known)}"
        return f"pdf: {named or f'a constant factor {c:.6g}: normalisation'}"
    if cost(found.exponents):
        rest = found._replace(exponents=(0, 0, 0, 0))
        left = "" if rest.plain and abs(c - 1.0) < DENSITY else f", and a factor {rest}"
        left = f", and {named}" if named and rest.plain else left
        return f"pdf: {shape_said(found.exponents)}{left}"
    return f"pdf: normalisation: {found} times the density of the draws"


def _by_place(known: Known, each: tuple[float, ...]) -> Iterator[Repair]:
    masses = [known.laws.mass(k) for k in known.index]
    low, high = min(each), max(each)
    if all(abs(c / m - 1.0) < SURE * e / m + MASS_ERROR
           for c, (m, e) in zip(each, masses, strict=True)):
        yield _pdf(f"pdf: normalisation: it lacks the division by its own integral ({low:.4g} to "
                   f"{high:.4g}): the draws are confined to what is kept, pdf is not", 4.0)
    elif high < 1.0 + DENSITY and known.mass_holds:
        yield _pdf(f"sample draws only a share {low:.4g} to {high:.4g} of the directions that pdf "
                   "covers, evenly: normalisation: its map of u does not reach the rest", 5.0)
    else:
        yield _pdf(f"pdf: a factor that depends on wo and the parameters alone, {low:.4g} to "
                   f"{high:.4g}: normalisation, or masking of wo", 7.0)


def _gap(known: Known) -> str:
    """Whether the azimuths of the draws leave one."""
    gaps = []
    for d in known.draws:
        w = d.many[d.finite]
        phi = np.sort(np.arctan2(w[:, 1], w[:, 0]) % (2.0 * np.pi))
        gaps.append(float(np.diff(np.append(phi, phi[0] + 2.0 * np.pi)).max()))
    wide = [x for x in gaps if x > 16.0 * np.pi / len(known.draws[0].many)]
    if len(wide) >= 0.8 * len(gaps):
        degrees = math.degrees(float(np.median(wide)))
        return f"the azimuths leave a gap of about {degrees:.0f} degrees"
    phi = np.concatenate([np.arctan2(d.many[:, 1], d.many[:, 0]) for d in known.draws])
    phi = np.sort(phi[np.isfinite(phi)] % (2.0 * np.pi))
    small = np.diff(np.append(phi, phi[0] + 2.0 * np.pi)).max() > 28.0 * np.pi / len(phi)
    return "the azimuths leave a gap" if small else "some directions are never drawn"


def moved(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf asked for other directions than were drawn."""
    if Law.DENSITY not in failed:
        return
    tried: dict[str, Callable[[Draws, int], Array]] = {
        "with wo and wi swapped": lambda d, k: d.swapped
    }
    tried |= {name: lambda d, k, n=name: d.moved[n] for name in (TURNED, QUARTER, AZIMUTH)}  # type: ignore[misc]
    for words, pdf in tried.items():
        if not known.laws.of_pdf(pdf):
            yield _pdf(f"pdf is the density of the draws {words}", 2.6)


def azimuth(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf over density of the draws a function of the azimuth alone: four harmonics."""
    if Law.DENSITY not in failed:
        return
    said = ""
    for d in known.draws:
        r = d.ratio
        ok = np.isfinite(r)
        phi, r = np.arctan2(d.g.wi[ok, 1], d.g.wi[ok, 0]), r[ok]
        if len(r) < 24 or np.ptp(r) < 4.0 * DENSITY:
            continue
        waves = [f(j * phi) for j in (1, 2, 3, 4) for f in (np.cos, np.sin)]
        a = np.stack([np.ones(len(r)), *waves], axis=1)
        fit = a @ np.linalg.lstsq(a, r, rcond=None)[0]
        if np.quantile(np.abs(fit - r), MOST) > max(DENSITY, 0.02 * float(np.std(r))):
            return
        said = f"{r.min():.3g} to {r.max():.3g}"
    if said:
        yield _pdf(f"pdf/density of the draws changes with the azimuth alone ({said}): look at how "
                   "phi is drawn", 8.0)


# parameters ---------------------------------------------------------------------------------------

MAPS: dict[str, Callable[[float], float]] = {
    "{}^2": lambda v: v * v, "sqrt({})": lambda v: math.sqrt(max(v, 0.0)),
    "{} + 1": lambda v: v + 1.0,
    "{} - 1": lambda v: max(v - 1.0, 0.0), "{} + 2": lambda v: v + 2.0, "2 {}": lambda v: 2.0 * v,
    "{}/2": lambda v: 0.5 * v, "{}^4": lambda v: v**4,
}  # fmt: skip
PAIRS: dict[str, Callable[[float], float]] = {
    "the squares of {} and {}": lambda v: v * v,
    "the roots of {} and {}": lambda v: math.sqrt(max(v, 0.0)),
}


def parameters(known: Known, failed: Failures) -> Iterator[Repair]:
    """One or two parameters taken otherwise in pdf than in sample."""
    if Law.DENSITY not in failed:
        return
    names, sets = known.at.names, known.sets
    tries: list[tuple[str, list[Parameters]]] = []
    for k in names:
        for words, f in MAPS.items():
            said = f"with {words.format(k)} where {k} is meant"
            tries.append((said, [p._replace(**{k: f(_of(p, k))}) for p in sets]))
    for a, b in itertools.combinations(names, 2):
        for words, f in PAIRS.items():
            said = f"with {words.format(a, b)} where they are meant"
            both = [p._replace(**{a: f(_of(p, a)), b: f(_of(p, b))}) for p in sets]
            tries.append((said, both))
        exchanged = [p._replace(**{a: _of(p, b), b: _of(p, a)}) for p in sets]
        tries.append((f"with {a} and {b} exchanged (tangent and bitangent, azimuth)", exchanged))
    for a, b in itertools.permutations(names, 2):
        said = f"with {b} in place of {a}: sample ignores {a} (the azimuth, if these are widths)"
        tries.append((said, [p._replace(**{a: _of(p, b)}) for p in sets]))
    for said, changed in tries:
        if changed != sets and _fits(known, changed):
            yield _pdf(f"pdf is the density of the draws {said}: pdf is {_wider(known)} than the "
                       "draws", 3.5)
            return


def _of(p: Parameters, name: str) -> float:
    return float(getattr(p, name))


def _deviations(
    known: Known, sets: list[Parameters], index: list[int] | None = None
) -> list[float]:
    """How far pdf with other parameters is from the density of the draws."""
    index = list(range(len(known.draws))) if index is None else index
    m = known.at.model
    assert m.pdf is not None
    rows = [(sets[i], known.draws[i].g.wo, known.draws[i].g.wi) for i in index]
    found = []
    for i, v in zip(index, asked(m, m.pdf, rows), strict=True):
        r = known.draws[i].over(v)
        r = r[np.isfinite(r)]
        found.append(float(np.quantile(np.abs(r - 1.0), MOST)) if len(r) > 8 else math.inf)
    return found


def _fits(known: Known, sets: list[Parameters]) -> bool:
    """First where pdf fails, then everywhere."""
    first = [i for i, k in enumerate(known.index) if k in known.bad][:1]
    if first and not _deviations(known, sets, first)[0] < DENSITY:
        return False
    return max(_deviations(known, sets)) < DENSITY


def _wider(known: Known) -> str:
    """Whether pdf is too high where it is high: then it is narrower than the draws."""
    votes = []
    for d in known.draws:
        r = d.ratio
        ok = np.isfinite(r)
        if ok.sum() > 10 and np.ptp(r[ok]) > 4.0 * DENSITY:
            outer, inner = np.array_split(r[ok][np.argsort(d.pdf[ok])], 2)
            votes.append(float(np.median(inner)) > float(np.median(outer)))
    return "narrower" if votes and np.mean(votes) > 0.5 else "wider"


def fitted(known: Known, failed: Failures) -> Iterator[Repair]:
    """A value of one parameter that makes pdf right, fitted place by place: two at least need one,
    the others hold as they are."""
    if Law.DENSITY not in failed:
        return
    for name in known.at.names:
        found: list[tuple[float, float]] = []
        bad = [i for i, k in enumerate(known.index) if k in known.bad]
        if len(bad) < 2 or any(_of(known.sets[i], name) <= 0.0 for i in bad):
            continue
        for i in bad:
            x = _value_fitted(known, name, i)
            if x is None:
                break
            found.append((_of(known.sets[i], name), x))
        else:
            xs = [x for _, x in found]
            text = f"sample draws as with {name} = {xs[0]:.4g} where {name} = {found[0][0]:.4g}"
            if np.ptp(xs) < 1e-3 * max(xs):
                text = f"sample clamps {name} at {xs[0]:.4g}, pdf does not (or the reverse)"
            n = len(known.index)
            yield _pdf(f"{text}: pdf is {_wider(known)} than the draws; right at {n - len(bad)} of "
                       f"{n} cases as it is, at the others with that value", 4.5)
            return


def _value_fitted(known: Known, name: str, i: int) -> float | None:
    v, d, m = _of(known.sets[i], name), known.draws[i], known.at.model
    assert m.pdf is not None
    with np.errstate(all="ignore"):
        log = np.log(d.density)

    def off(xs: Array) -> Array:
        rows = [(known.sets[i]._replace(**{name: float(x)}), d.g.wo, d.g.wi) for x in xs]
        assert m.pdf is not None
        with np.errstate(all="ignore"):
            apart = [np.abs(np.log(np.maximum(p, 1e-300)) - log) for p in asked(m, m.pdf, rows)]
        return np.array([float(np.nanmean(np.fmin(1.0, a))) for a in apart])

    grid = v * np.exp(np.linspace(-2.5, 2.5, 41))
    for _ in range(14):
        e = off(grid)
        if not np.isfinite(e).any():
            return None
        k = int(np.nanargmin(e))
        low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
        grid = np.linspace(low, high, 9)
    x = 0.5 * float(low + high)
    sets = list(known.sets)
    sets[i] = known.sets[i]._replace(**{name: x})
    fits = _deviations(known, sets, [i])[0] < 2.0 * DENSITY and abs(x / v - 1.0) > 1e-4
    return x if fits else None


def clamped(known: Known, failed: Failures) -> Iterator[Repair]:
    """pdf clamps one or two parameters that sample takes as they are: with draws of the clamped
    ones it is right."""
    from montecarlo_brdf.diagnosis.clamp import clamp_told

    if Law.DENSITY in failed and (said := clamp_told(known)):
        yield _pdf(f"{said} than the draws", 4.0)
