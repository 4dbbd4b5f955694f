"""The worst place of a quantity: over angles, azimuths where they matter, and free parameters.

A coarse scan of all of them together; then every one is scanned finely along its own line from the
best places found, so that a bump of 1 % of a range is met once the others are where it shows; then
steps that climb. All values use the same random numbers: differences between them are not noise.
It cannot see: a bump narrow in two of them at once.
"""
from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.checks import interiors
from montecarlo_brdf.checks.case import Case, pointwise
from montecarlo_brdf.checks.lobe_coordinates import grid
from montecarlo_brdf.checks.truth import coordinates
from montecarlo_brdf.integration import integrands
from montecarlo_brdf.integration.estimators import (
    Plan,
    Subject,
    evaluate,
    integrand_name,
    samplers_of,
)
from montecarlo_brdf.sampling.points import sobol
from montecarlo_brdf.vectors import Vec, from_degrees

ANGLES = (0.0, 30.0, 50.0, 65.0, 76.0, 84.0, 88.0, 89.9)
LAST = 89.9
INTERIOR = 20  # parameter sets of the scan
LINE = 128  # places along each line
SWEEPS = 2
SCAN = Plan(samples=1 << 10, replicates=4)
CLIMB = Plan(samples=1 << 13, replicates=8)
POLISH = Plan(samples=1 << 16, replicates=8)
STEPS = {CLIMB: (0.15, 0.003), POLISH: (0.006, 0.0003)}  # first and last
NODES = grid(48, 32)

At = tuple[float, ...]
Value = Callable[[At, Plan], float]


class Spot(NamedTuple):
    """A place as numbers in [0, 1] (angle, azimuth if it matters, parameters), and its value."""

    at: At
    value: float


class Space(NamedTuple):
    """Where a case may be looked at."""

    case: Case

    @property
    def turning(self) -> int:
        """1 if the azimuth matters, else 0."""
        return int(not self.case.model.isotropic)

    def direction(self, at: At) -> tuple[float, float]:
        """Polar angle and azimuth in degrees."""
        return LAST * at[0], 360.0 * at[1] if self.turning else self.case.phi_o_deg

    def parameters(self, at: At) -> Any:
        """The parameter set."""
        free = at[1 + self.turning :]
        return interiors.at(self.case, dict(zip(self.case.free, free, strict=True)))

    def where(self, at: At, letter: str) -> dict[str, float]:
        """The place as findings give it."""
        theta, phi = self.direction(at)
        turned = {f"phi_{letter}_deg": round(phi, 3)} if phi else {}
        changed = interiors.changed(self.case, self.parameters(at))
        return {f"theta_{letter}_deg": round(theta, 3), **turned, **changed}


def albedo(space: Space, quantity: str) -> Value:
    """A or R by the sampler that sees the lobe, or by a coarse quadrature where there is none."""
    model = space.case.model
    if samplers_of(model, quantity)[-1] != "own":
        return lambda at, _: _quadrature(space, quantity, at)
    name = integrand_name(model, quantity, "own")
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    functions = {k: v for k, v in bound.items() if v is not None}

    def value(at: At, plan: Plan) -> float:
        subject = Subject((model.name,), functions, [model.prepared(space.parameters(at))])
        fixed = from_degrees(*space.direction(at))
        integrand = [getattr(integrands, name)]
        e = evaluate(subject, fixed, integrand, plan, ("search", quantity), common=True)[0][0]
        return e.mean if math.isfinite(e.mean) else math.inf

    return value


def _quadrature(space: Space, quantity: str, at: At) -> float:
    case, fixed = space.case, from_degrees(*space.direction(at))
    p, w = space.parameters(at), np.array(fixed)
    f = pointwise(case.model, p).f
    x, b, weight = NODES
    v, jacobian = coordinates(case.model, p, w).directions(x, b)
    values = f(v, w) if quantity == "reverse" else f(w, v)
    total = float(np.sum(weight * jacobian * v[:, 2] * values))
    return total if math.isfinite(total) else math.inf


def worst(space: Space, value: Value) -> Spot:
    """Where `value` is largest, as far as scan, lines and steps can tell."""
    scanned = sorted(_scan(space, value), key=lambda s: s.value, reverse=True)
    starts = [scanned[0], _lines(value, scanned[0])]
    best = max((_climb(value, s, CLIMB) for s in starts), key=lambda s: s.value)
    return _climb(value, best, POLISH)


def _scan(space: Space, value: Value) -> Iterator[Spot]:
    """The case's own parameters and some of the interior, at every angle."""
    case = space.case
    own = tuple(interiors.position(case, case.one).values())
    for k in range(1 + (INTERIOR if case.free or space.turning else 0)):
        u = sobol(case.seed + 0xE9, k)
        turn = (u[4],) if space.turning else ()
        inside = own if k == 0 else tuple(u[i % 4] for i in range(len(own)))
        for theta in ANGLES:
            at = (theta / LAST, *turn, *inside)
            yield Spot(at, value(at, SCAN))


def _lines(value: Value, spot: Spot) -> Spot:
    """Every coordinate in turn scanned from end to end, the others staying at the best so far."""
    for axis in [*range(len(spot.at))] * SWEEPS:
        places = [_moved(spot.at, axis, k / (LINE - 1)) for k in range(LINE)]
        best = max((Spot(at, value(at, SCAN)) for at in places), key=lambda s: s.value)
        spot = max(spot, best, key=lambda s: s.value)
    return spot


def _climb(value: Value, spot: Spot, plan: Plan) -> Spot:
    """Steps to the best neighbour, halved where there is none better."""
    spot = Spot(spot.at, value(spot.at, plan))
    step, last = STEPS[plan]
    while step > last:
        around = [Spot(at, value(at, plan)) for at in _neighbours(spot.at, step)]
        best = max(around, key=lambda s: s.value)
        spot, step = (best, step) if best.value > spot.value else (spot, 0.5 * step)
    return spot


def _neighbours(at: At, step: float) -> Iterator[At]:
    """Steps along every coordinate; a third as far along the angle, where lobes change fast."""
    for sign in (-1.0, 1.0):
        for axis in range(len(at)):
            size = step / 3.0 if axis == 0 else step
            yield _moved(at, axis, min(max(at[axis] + sign * size, 0.0), 1.0))


def _moved(at: At, axis: int, to: float) -> At:
    return (*at[:axis], to, *at[axis + 1 :])


def direction(space: Space, at: At) -> Vec:
    """The place's direction."""
    return from_degrees(*space.direction(at))
