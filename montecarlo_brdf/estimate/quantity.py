"""What is averaged: quantity times direction. One number per point u in [0, 1)^5.

An integrand is a template (u, given, p) -> x, E[x] being the quantity. Its VALUE is what a
direction contributes, its DIRECTION how that is chosen; `F` and `PDF` are a model's functions. The
framework never evaluates a model below the horizon: a direction with z <= 0 was rejected and counts
as 0.
"""
from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.compile.bind import Bound, bound, hole, takes_more
from montecarlo_brdf.compile.layout import Numbers
from montecarlo_brdf.sampling.charts import Row, smooth_step
from montecarlo_brdf.sampling.directions import (
    DIRECTIONS,
    PI,
    TWO_PI,
    UNDENSED,
    WEIGHTED,
    Direction,
    Given,
    Sampler,
    probed,
)
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine

F: Callable[..., float] = hole()
PDF: Callable[..., float] = hole()
SKY: Callable[..., float] = hole()
VALUE: Callable[..., float] = hole()
DIRECTION: Callable[..., Row] = hole()
PAIR: Callable[..., float] = hole()
BLIND: Callable[..., float] = hole()
INSIDE: Callable[..., float] = hole()
FIRST: Callable[..., Row] = hole()
SECOND: Callable[..., Row] = hole()
THIRD: Callable[..., Row] = hole()
WEIGH: Callable[..., Row] = hole()

LAST = 0.9999999999999999  # the largest number below 1


class Quantity(StrEnum):
    """What can be estimated."""

    ALBEDO = "albedo"  # A(wo) = int f cos dwi
    REVERSE = "reverse"  # R(wi) = int f cos dwo
    BIHEMISPHERICAL = "bihemispherical"  # radiosity over irradiance under uniform light
    RADIANCE = "radiance"  # int f L cos dwi under the light SKY
    HEMISPHERE = "hemisphere"  # int f(w) dw
    MASS = "mass"  # int pdf dwi
    REJECTED = "rejected"  # the share of draws that the model's sampler rejects


# ways to a direction ------------------------------------------------------------------------------


def chosen(u: Row, given: Given, p: Numbers) -> float:
    """x of a direction that is chosen for this point."""
    return VALUE(given, DIRECTION(u, given, p), p)


def made(u: Row, given: Given, p: Numbers) -> float:
    """x of a direction that was made before: u is what `steps` lead to."""
    return VALUE(given, WEIGH(u, given), p)


def in_one_step(u: Row, given: Given, p: Numbers) -> Row:
    """A direction that knows nothing of the model."""
    return WEIGH(FIRST(u, given), given)


def in_three_steps(u: Row, given: Given, p: Numbers) -> Row:
    """The same for charts of lobes."""
    return WEIGH(THIRD(SECOND(FIRST(u, given), given), given), given)


def from_everywhere(u: Row, given: Given, p: Numbers) -> float:
    """x with the given direction cosine-weighted by u[2] and u[3]."""
    wo = random_hemisphere_cosine(u[2], u[3])
    return INSIDE(u, (wo[0], wo[1], wo[2], given[3]), p)


def periodised(u: Row, given: Given, p: Numbers) -> float:
    """x made periodic in the polar coordinate u[0]: what lattices need."""
    w, _, slope = smooth_step(u[0])
    return INSIDE((min(w, LAST), u[1], u[2], u[3], u[4]), given, p) * slope


def periodised_there(u: Row, given: Given, p: Numbers) -> float:
    """The same in u[2], the polar coordinate of `from_everywhere`."""
    v, _, steep = smooth_step(u[2])
    return INSIDE((u[0], u[1], min(v, LAST), u[3], u[4]), given, p) * steep


# what a direction contributes ---------------------------------------------------------------------


def at(given: Given, w: Row, p: Numbers) -> float:
    """f cos/pdf."""
    return PAIR(given, w, p) * w[3]


def at_draw(given: Given, w: Row, p: Numbers) -> float:
    """The same where directions may be rejected."""
    if w[2] <= 0.0:
        return 0.0
    return PAIR(given, w, p) * w[3]


def at_weight(given: Given, w: Row, p: Numbers) -> float:
    """The same where the sampler returns it."""
    if w[2] <= 0.0:
        return 0.0
    return w[3]


def at_panels(given: Given, w: Row, p: Numbers) -> float:
    """The same for one direction in each panel between the kinks."""
    high = PAIR(given, w, p) + PAIR(given, (-w[0], -w[1], w[2]), p)
    low = PAIR(given, w[4:], p) + PAIR(given, (-w[4], -w[5], w[6]), p)
    return high * w[3] + low * w[7]


def lit_at_weight(given: Given, w: Row, p: Numbers) -> float:
    """L f cos/pdf where the sampler returns the rest."""
    if w[2] <= 0.0:
        return 0.0
    return w[3] * SKY(w[:3], given[3])


def squared(given: Given, w: Row, p: Numbers) -> float:
    """E[x^2] of a sampler that is blind to lobes, whose cos/pdf is BLIND(cos), from draws by the
    model's own, which sees its lobe."""
    if w[2] <= 0.0:
        return 0.0
    f = PAIR(given, w, p)
    return f * f * w[3] * BLIND(w[2])


def rejected(given: Given, w: Row, p: Numbers) -> float:
    """1 where the model's sampler rejects."""
    return 1.0 if w[2] <= 0.0 else 0.0


def density(given: Given, w: Row, p: Numbers) -> float:
    """pdf per solid angle."""
    return PDF(given[:3], w[:3], p) * w[4]


def alone(given: Given, w: Row, p: Numbers) -> float:
    """A function of one direction, per solid angle."""
    return F(w[:3], p) * w[4]


def forward(given: Given, w: Row, p: Numbers) -> float:
    """f with the view given."""
    return F(given[:3], w[:3], p)


def backward(given: Given, w: Row, p: Numbers) -> float:
    """f with the light given."""
    return F(w[:3], given[:3], p)


def lit(given: Given, w: Row, p: Numbers) -> float:
    """f L with the view given; given[3] tells apart lights that share a kernel."""
    return F(given[:3], w[:3], p) * SKY(w[:3], given[3])


def blind_uniform(mu: float) -> float:
    """cos/pdf of uniform directions."""
    return mu * TWO_PI


def blind_cosine(mu: float) -> float:
    """cos/pdf of cosine-weighted ones."""
    return PI


# their product ------------------------------------------------------------------------------------


class Integrand(NamedTuple):
    """A template, and what a kernel of means may know of it."""

    template: Bound
    #: from a point to the direction that alone `made` reads; none where that gains nothing
    steps: tuple[Callable[[Row, Given], Row], ...]
    made: Bound | None
    coordinates: int  # of a point that it uses: 2, 3 (the first two and the last) or 5
    periodic: bool  # in every polar coordinate

    def for_lattice(self) -> Integrand:
        """The same made periodic."""
        if self.periodic:
            return self
        inside = bound(periodised, INSIDE=self.template)
        if self.coordinates == 5:
            inside = bound(periodised_there, INSIDE=inside)
        return Integrand(inside, (), None, self.coordinates, True)


#: PAIR of quantities that integrate f over one direction
PAIRS = {Quantity.REVERSE: backward, Quantity.RADIANCE: lit}
#: VALUE of those that do not
VALUES = {
    Quantity.HEMISPHERE: alone,
    Quantity.MASS: density,
    Quantity.REJECTED: rejected,
}
SCALES = {Sampler.UNIFORM: blind_uniform, Sampler.COSINE: blind_cosine}


def integrand(
    quantity: Quantity,
    sampler: Sampler,
    functions: Mapping[str, object],
    returns_weight: bool = False,
) -> Integrand:
    """A quantity by a sampler; `functions` fill F, SAMPLE, PDF and SKY. returns_weight: the
    model's sampler returns f cos/pdf, which is used in place of both."""
    way, own = DIRECTIONS[sampler], sampler is Sampler.OWN
    value = VALUES.get(quantity, at)
    if quantity is Quantity.REJECTED:
        way = UNDENSED
    elif own and returns_weight:
        way, value = WEIGHTED, lit_at_weight if quantity is Quantity.RADIANCE else at_weight
    elif own:
        value = at_draw
    elif sampler is Sampler.PANELS:
        value = at_panels
    names = {**functions, "VALUE": value, "PAIR": PAIRS.get(quantity, forward)}
    found = _integrand(way, names)
    return _everywhere(found) if quantity is Quantity.BIHEMISPHERICAL else found


def second_moment(sampler: Sampler, functions: Mapping[str, object]) -> Integrand:
    """E[x^2] of A by uniform or cosine sampling, from draws by the model's own sampler."""
    names = {**functions, "VALUE": squared, "PAIR": forward, "BLIND": SCALES[sampler]}
    return _integrand(DIRECTIONS[Sampler.OWN], names)


def probe_of(sampler: Sampler, functions: Mapping[str, object]) -> Integrand | None:
    """The value that A by a chart would take at one of PROBES directions, chosen by u[0]: a lobe
    that the chart does not fit, or that its points may miss, shows as one far above the mean."""
    steepest = DIRECTIONS[sampler].steepest
    if steepest is None:
        return None
    names = {"VALUE": at_draw, "PAIR": forward, "STEEPEST": steepest}
    return _integrand(Direction(drawn=probed), {**functions, **names})


def _integrand(way: Direction, names: dict[str, object]) -> Integrand:
    template = bound(chosen, **names, **_direction(way))
    if way.drawn is None and way.blockwise:
        after = bound(made, **names, WEIGH=way.weigh)
        return Integrand(template, way.steps, after, 2, way.periodic)
    sample: Any = names.get("SAMPLE")
    choosing = way.drawn is not None and takes_more(sample, 1, 2)
    return Integrand(template, (), None, 3 if choosing else 2, way.periodic)


def _direction(way: Direction) -> dict[str, object]:
    """The names that make a DIRECTION."""
    if way.drawn:
        return {"DIRECTION": way.drawn}
    inner = {1: in_one_step, 3: in_three_steps}[len(way.steps)]
    steps = dict(zip(("FIRST", "SECOND", "THIRD"), way.steps, strict=False))
    return {"DIRECTION": inner, "WEIGH": way.weigh, **steps}


def _everywhere(one: Integrand) -> Integrand:
    """The same averaged over the given direction, cosine-weighted; in periodic charts also
    periodic in that one, whatever points are used."""
    both = bound(from_everywhere, INSIDE=one.template)
    both = bound(periodised_there, INSIDE=both) if one.periodic else both
    return Integrand(both, (), None, 5, one.periodic)
