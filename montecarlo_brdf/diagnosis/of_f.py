"""Repairs of f. A law that it breaks tells no factor by itself: a declared model or albedo, a pdf
that holds, or a known model must."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.diagnosis.ask import asked
from montecarlo_brdf.diagnosis.geometry import NONE, Geometry, cost, turned
from montecarlo_brdf.diagnosis.identity import Identity, identities, sums
from montecarlo_brdf.diagnosis.laws import EXACT, Divisor, Failures, Law, Laws
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.stored import Target
from montecarlo_brdf.diagnosis.words import (
    Factor,
    constant,
    factor,
    mistake,
    relation,
    shape_said,
)
from montecarlo_brdf.judge.diagnosis import Part

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

MOST = 0.98
CLOSE = 1e-6
NAMED = 1e-5
MANY = 0.75  # of the places


def _tried(
    laws: Laws, penalty: float, sentence: str, divisor: Divisor
) -> Iterator[Repair]:
    """A repair of f if with it all laws of f hold."""
    if not laws.of_f(divisor):
        yield repair(Part.F, penalty, f"f: {sentence}", Part.WEIGHT)


def _told(penalty: float, sentence: str) -> Repair:
    return repair(Part.F, penalty, f"f: {sentence}", Part.WEIGHT)


def _by(laws: Laws, found: Factor) -> Divisor:
    spots = laws.at.spots
    return lambda g, k: found.at(g, spots[k].p)


# a declared model ---------------------------------------------------------------------------------


def declared_model(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """f over the model that it must equal has a name, or directions or a parameter are taken
    otherwise."""
    if Law.SAME not in failed:
        return
    at, name = laws.at, laws.at.targets[0].model.name
    rows = [(_lit(t.have, t.want, at.nodes[t.spot].g), at.nodes[t.spot].g) for t in at.targets]
    found = factor(rows, [t.p for t in at.targets], at.names, CLOSE, MOST)
    if found and found.each:
        low, high = min(found.each), max(found.each)
        yield _told(8.0, f"a factor that depends on the parameters alone: normalisation "
                         f"(f/{name} = {low:.4g} to {high:.4g}, the same for all directions)")
    elif found and not (found.plain and abs(found.constant - 1.0) < CLOSE):
        said = _factor_said(found)
        yield from _tried(laws, 2.0 + cost(found.exponents),
                          f"{said} (f is {found} times {name} everywhere)", _by(laws, found))
    yield from _changed(laws)


def _factor_said(found: Factor) -> str:
    named = mistake(found.constant, NAMED)
    if cost(found.exponents):
        rest = found._replace(exponents=NONE)
        more = "" if str(rest) == "1" else f", and a factor {rest}"
        return shape_said(found.exponents) + more
    return named if named and found.plain else f"constant factor {found}: normalisation"


def _lit(have: Array, want: Array, g: Geometry) -> Array:
    with np.errstate(all="ignore"):
        ok = np.isfinite(have) & (want > 1e-9 * np.nanmax(want)) & (g.cos_i > 0.02)
        return np.where(ok, have / want, np.nan)


#: conventions in which parameters are confused
MAPS: dict[str, Callable[[float], float]] = {
    "{}^2": lambda v: v * v, "sqrt({})": lambda v: math.sqrt(max(v, 0.0)),
    "{} in degrees": math.radians, "{} in radians": math.degrees, "2 {}": lambda v: 2.0 * v,
    "{}/2": lambda v: 0.5 * v, "{} + 1": lambda v: v + 1.0,
}  # fmt: skip


def _changed(laws: Laws) -> Iterator[Repair]:
    at = laws.at
    other = at.targets[0].model
    if _is(laws, lambda t, g: _values(t, turned(g.wo, math.pi / 2), turned(g.wi, math.pi / 2))):
        yield _told(4.0, f"it is {other.name} turned by 90 degrees: tangent and bitangent are "
                         "swapped")
    for k in other.Params._fields:
        for words, f in MAPS.items():
            changed = functools.partial(_with, k, f)
            if any(changed(t).q != t.q for t in at.targets) and \
                    _is(laws, lambda t, g, c=changed: _values(c(t), g.wo, g.wi)):  # type: ignore[misc]
                yield _told(5.0, f"it is {other.name} with {words.format(k)} where {k} is meant")
    tops = [float(np.nanmax(t.have)) for t in at.targets]
    top = max(tops)
    if np.ptp(tops) < CLOSE * top or all(x <= top for x in tops):
        def clipped(t: Target, g: Geometry) -> Array:
            return np.minimum(t.want, top)
        if any((t.want > top * (1.0 + CLOSE)).any() for t in at.targets) and _is(laws, clipped):
            yield _told(5.0, f"it is {other.name} clipped at {top:.6g}")


def _with(name: str, f: Callable[[float], float], t: Target) -> Target:
    return t._replace(q=t.q._replace(**{name: f(float(getattr(t.q, name)))}))


def _values(t: Target, wo: Array, wi: Array) -> Array:
    return asked(t.model, t.model.f, [(t.q, wo, wi)])[0]


def _is(laws: Laws, other: Callable[[Target, Geometry], Array]) -> bool:
    """Whether f is that everywhere."""
    for t in laws.at.targets:
        g = laws.at.nodes[t.spot].g
        v = other(t, g)
        ok = np.isfinite(v) & np.isfinite(t.have) & (t.have > 1e-9 * np.nanmax(t.have))
        with np.errstate(all="ignore"):
            off = np.abs(v[ok] / t.have[ok] - 1.0)
        if len(off) < 10 or not np.quantile(off, MOST) < CLOSE:
            return False
    return True


# a declared albedo --------------------------------------------------------------------------------


def declared_albedo(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """A over what is declared: a constant or a word at all places."""
    if Law.ALBEDO not in failed or laws.at.targets:
        return
    at = laws.at
    values = [laws.albedo(k) for k in range(len(at.spots))]
    if any(not due or a <= 0.0 for (a, _), due in zip(values, at.declared, strict=True)):
        return
    ratios = [a / due for (a, _), due in zip(values, at.declared, strict=True) if due]
    error = max(e / a for a, e in values)
    close = 4.0 * error + 1e-4
    found = relation(ratios, at.sets, at.names, close) if error < 0.004 else None
    if found is None:
        return
    c, word = found
    n = len(at.spots)
    if not word.text and (named := mistake(c, close)):
        yield from _tried(laws, 2.0, f"{named}: A/declared = {c:.4g} at all {n} cases",
                          _by(laws, Factor(c)))
    elif word.scale and abs(c - 1.0) < close:
        yield from _tried(laws, 4.0, f"{word.text} too much: A/declared = {word.text} at all {n} "
                          f"cases; {word.text}^2 stands where {word.text} is meant",
                          _by(laws, Factor(c, word)))
    elif word.text and abs(c - 1.0) < close:
        yield from _tried(laws, 4.0, f"A/declared = {word.text} at all {n} cases",
                          _by(laws, Factor(c, word)))


# reciprocity --------------------------------------------------------------------------------------


def reciprocity(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """A cosine of one direction, or a factor or summand of one direction alone."""
    if Law.RECIPROCITY not in failed:
        return
    pairs = laws.at.pairs
    with np.errstate(all="ignore"):
        ratios = [np.where(np.abs(v.ba) > 1e-12 * np.nanmax(np.abs(v.ab)), v.ab / v.ba, np.nan)
                  for v in pairs]
    for sign, said in ((1, "cos_i is included (or missing from the denominator)"),
                       (-1, "f is divided by cos_i once too often (or cos_i is missing)")):
        qs = [r / (v.g.cos_i / v.g.cos_o) ** sign for r, v in zip(ratios, pairs, strict=True)]
        cs = [constant(q, EXACT, MOST) for q in qs]
        if all(c is not None and abs(c - 1.0) < EXACT for c in cs):
            one = list(_tried(laws, 2.0, f"a cosine of one direction alone: {said}",
                              lambda g, k, x=sign: g.cos_i**x))  # type: ignore[misc]
            other, top, bottom = ("o", "i", "o") if sign == 1 else ("i", "o", "i")
            yield from one or _tried(
                laws, 3.0, f"a cosine of one direction alone: f(wo, wi)/f(wi, wo) = "
                f"cos_{top}/cos_{bottom} exactly", lambda g, k, x=sign: g.cos_o ** (-x))  # type: ignore[misc]
            return
    kinds = [_cycle(laws, k) for k in range(len(pairs))]
    factor_alone, summand = (all(k[i] for k in kinds) for i in (0, 1))
    if not (factor_alone or summand):
        return
    kind = "factor" if factor_alone else "summand"
    wrong = [one for one in _known(laws) if _by_name(one)]
    if wrong:
        return  # `identified` says more
    others = set(failed) & {Law.ENERGY, Law.REVERSE, Law.ALBEDO, Law.SAME, Law.ISOTROPY}
    if not others or (factor_alone and others <= {Law.ENERGY, Law.REVERSE}
                      and _holds_without_it(laws)):
        yield _told(6.0, f"reciprocal but for a {kind} that depends on one direction alone")


def _cycle(laws: Laws, k: int) -> tuple[bool, bool]:
    """Whether f(a, b)/f(b, a) multiplies to 1 round three directions; the differences add to 0."""
    v = laws.at.pairs[k]
    n = len(v.bc)
    with np.errstate(all="ignore"):
        product = v.ab[:n] * v.bc * v.ca / (v.ba[:n] * v.cb * v.ac)
        parts = [v.ab[:n] - v.ba[:n], v.bc - v.cb, v.ca - v.ac]
        total = np.sum(parts, axis=0) / np.maximum(np.sum(np.abs(parts), axis=0), 1e-300)
    product, total = product[np.isfinite(product)], total[np.isfinite(total)]
    return (
        len(product) > 8 and bool(np.quantile(np.abs(product - 1.0), 0.9) < EXACT),
        len(total) > 8 and bool(np.quantile(np.abs(total), 0.9) < EXACT),
    )


def _holds_without_it(laws: Laws) -> bool:
    """A <= 1 after dividing by the factor of wi: f/f' for a fixed wo is it, up to a constant."""
    for k, n in enumerate(laws.at.nodes):
        with np.errstate(all="ignore"):
            g = n.f / n.back
        ok = np.isfinite(g) & (g > 0.0)
        if ok.sum() < 20:
            return False
        value, error = laws.albedo(k, np.where(ok, g, 1.0))
        if value - 4.5 * error > 1.002:
            return False
    return True


# what it is ---------------------------------------------------------------------------------------


def _known(laws: Laws) -> list[Identity]:
    """Known models that f is, found once."""
    if not hasattr(laws, "_identities"):
        laws._identities = identities(laws.at)  # type: ignore[attr-defined]
    found: list[Identity] = laws._identities  # type: ignore[attr-defined]
    return found


def _by_name(one: Identity) -> bool:
    """Whether a known model is wrong by itself, with nothing but a scale left over."""
    f = one.factor
    only = abs(f.constant - 1.0) < CLOSE and not cost(f.exponents)
    return bool(one.wrong) and only and (not f.word.text or f.word.scale)


def by_pdf(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """f cos/pdf the same for all draws, where pdf holds: a parameter times a named constant."""
    at = laws.at
    if Law.ENERGY not in failed or not at.model.pdf or laws.pdf_broken or not laws.usable:
        return
    draws = [at.draws[k] for k in laws.usable]
    rows = [(laws.due(d), d.g) for d in draws]
    sets = [at.spots[k].p for k in laws.usable]
    found = factor(rows, sets, at.names, CLOSE, MOST, [NONE])
    scaled = found is not None and not found.each and found.word.scale
    if found and scaled and (named := mistake(found.constant, NAMED)):
        said = f"{named}: f cos/pdf = {found} for all draws"
        yield from _tried(laws, 2.0, said, _by(laws, Factor(found.constant)))


def identified(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """f is a known model times a factor, or a known wrong one."""
    told = {Law.ENERGY, Law.REVERSE, Law.RECIPROCITY, Law.SAME}
    if not told & set(failed):
        return
    only_wrong = Law.ENERGY not in failed
    for one in _known(laws):
        if _by_name(one):
            yield _told(1.8, f"{one.wrong}: {one} everywhere")
        elif not (only_wrong and (one.wrong or not cost(one.factor.exponents))):
            yield from _as_factor(laws, one)


def _as_factor(laws: Laws, one: Identity) -> Iterator[Repair]:
    f = one.factor
    named, unit = mistake(f.constant, NAMED), abs(f.constant - 1.0) < CLOSE
    by = Factor(f.constant, exponents=f.exponents)
    if cost(f.exponents) and (unit or named):
        more = f", {named}" if named else ""
        yield from _tried(laws, 3.0 + cost(f.exponents), f"{shape_said(f.exponents)}{more}: {one}",
                          _by(laws, by))
    elif cost(f.exponents):
        return
    elif f.word.normalises and (unit or named):
        yield from _tried(laws, 4.0, f"normalisation: {one}", _by(laws, f))
    elif named:
        yield from _tried(laws, 2.0, f"{named}: {one}", _by(laws, by))
    elif not f.word.text and not unit:
        yield from _tried(laws, 6.0, f"a constant factor {f.constant:.6g}: normalisation: {one}",
                          _by(laws, by))


def two_terms(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """f is Lambert and one lobe: weights that add up beyond 1, or a factor in one of them."""
    if Law.ENERGY not in failed or _known(laws):
        return
    for one in sums(laws.at):
        a, b = one.diffuse, one.lobe
        units = [abs(f.constant - 1.0) < NAMED for f in (a, b)]
        names = [mistake(f.constant, NAMED) for f in (a, b)]
        if all(units):
            yield _told(4.0, f"weights that add up beyond 1: {one}")
        elif names[0] and units[1] and a.word.text:
            yield _told(4.0, f"{names[0]} in the diffuse part: {one}")
        elif names[1] and units[0] and b.word.text:
            yield _told(4.0, f"{names[1]} in the lobe: {one}")
        return


def undeclared(laws: Laws, failed: Failures) -> Iterator[Repair]:
    """Only isotropy fails, nearly everywhere: the model is not isotropic. At a few places it is
    no more than a place."""
    spots = {b.spot for b in failed.get(Law.ISOTROPY, [])}
    if set(failed) == {Law.ISOTROPY} and len(spots) > MANY * len(laws.at.spots):
        yield _told(7.0, "it changes with the azimuth: all other laws hold once it is declared "
                         "anisotropic (isotropic = False)")
