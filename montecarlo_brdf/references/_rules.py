"""One-dimensional node sets on (0, 1), the comparison of node sets that bounds an error, and the
mean of a directional albedo over the hemisphere.

numpy is imported here; closed forms never import this file.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from montecarlo_brdf.references._truth import EPSILON, Truth

Array = npt.NDArray[np.float64]


class Nodes(NamedTuple):
    """Nodes x, their distance 1 - x from the far end to full relative accuracy, and weights."""

    x: Array
    rest: Array
    weight: Array


class Sum(NamedTuple):
    """An integral by one node set, and the sum of the magnitudes of its terms."""

    value: float
    magnitude: float


@cache
def gauss(n: int) -> Nodes:
    """Gauss-Legendre: exact for polynomials of degree 2n-1.

    Newton's iteration in long double from Tricomi's estimate: numpy's own weights next to the ends
    are wrong by 1e-12 relative for n = 60, which shows in sums at 1e-14.
    """
    x = np.cos(np.pi * (np.arange(n, 0, -1, dtype=np.longdouble) - 0.25) / (n + 0.5))
    for _ in range(6):
        before, here = np.ones_like(x), x
        for j in range(2, n + 1):
            before, here = here, ((2 * j - 1) * x * here - (j - 1) * before) / j
        slope = n * (before - x * here) / ((1 - x) * (1 + x))
        x = x - here / slope
    weight = 1 / ((1 - x) * (1 + x) * slope * slope)
    both = (0.5 * (1 + x), 0.5 * (1 - x), weight)
    return Nodes(*(part.astype(np.float64) for part in both))


def node_count(wanted: float) -> int:
    """The next of 8, 10, 12, 14, 16, 20, ...: few sizes, so that cached node sets are found."""
    step: int = 2 ** max(math.floor(math.log2(wanted)) - 2, 1)
    return step * math.ceil(wanted / step)


@cache
def clustered(n: int) -> Nodes:
    """Gauss-Legendre after x = u^2 (3 - 2u), which makes square roots at both ends analytic."""
    u, v, weight = gauss(n)
    return Nodes(u * u * (3.0 - 2.0 * u), v * v * (3.0 - 2.0 * v), 6.0 * u * v * weight)


@cache
def leaning(n: int) -> Nodes:
    """Gauss-Legendre after x = u^2 (2 - u), for a singularity at 0 and none at 1."""
    u, v, weight = gauss(n)
    return Nodes(u * u * (1.0 + v), v * (1.0 + u * v), u * (1.0 + 3.0 * v) * weight)


@cache
def tanh_sinh(n: int) -> Nodes:
    """Double-exponential rule: any integrable singularity at the ends; n nodes."""
    span = 3.3  # the nodes beyond it are closer than 1e-18 to an end
    step = 2.0 * span / (n - 1)
    s = np.linspace(-span, span, n)
    far = 1.0 / (1.0 + np.exp(np.pi * np.sinh(s)))
    near = 1.0 / (1.0 + np.exp(-np.pi * np.sinh(s)))
    return Nodes(near, far, step * np.pi * np.cosh(s) * near * far)


def panels(nodes: Nodes, edges: Sequence[float] | Array) -> tuple[Array, Array]:
    """The rule repeated on every interval between the edges: nodes and weights."""
    starts, widths = np.array(edges[:-1])[:, None], np.diff(edges)[:, None]
    return (starts + widths * nodes.x).ravel(), (widths * nodes.weight).ravel()


def total(terms: Array) -> Sum:
    return Sum(float(terms.sum()), float(np.abs(terms).sum()))


ENOUGH = 1e-12  # relative difference of two node sets at which refining stops
GROWTH = 1.3  # ratio of their sizes per dimension, more than a step of `node_count`
ROUNDING = 64.0 * EPSILON  # relative: some fifty operations per term, some of them common to all


def converge(
    rule: Callable[[float], Sum], rounds: int = 8, enough: float = ENOUGH, agreements: int = 1
) -> tuple[float, float]:
    """Refine rule(size) until sizes agree; return the finest value and a bound on its error.

    The difference bounds the error of the finer set where each refinement at least halves it, as
    the geometric rules here do. Where the differences shrink more slowly, with a ratio r of one to
    the one before, the rest of that series r/(1-r) is what is still to come. Where the integrand
    has kinks, errors change sign as they please and two sets may agree by chance: two agreements
    are asked there (one, if it is to rounding), and the larger difference is the bound, with room
    for chance.
    """
    floor = ROUNDING * (8.0 if agreements > 1 else 1.0)
    size, coarse, before, trust, agreed = 1.0, rule(1.0), 0.0, 1.0, 0.0
    for _ in range(rounds):
        size *= GROWTH
        fine = rule(size)
        difference = abs(fine.value - coarse.value)
        if difference <= enough * fine.magnitude:
            agreements -= 1 if difference > ROUNDING * fine.magnitude else 2
            agreed = max(agreed, difference)
            if agreements <= 0:
                break
        else:
            ratio = min(difference / before, 0.95) if before else 0.5
            trust = max(1.0, ratio / (1.0 - ratio))
        coarse, before = fine, difference
    return fine.value, trust * max(agreed, difference) + floor * fine.magnitude


def hemispherical_mean(
    albedo: Callable[[float], tuple[float, float]], width: float, breaks: tuple[float, ...] = ()
) -> tuple[float, float]:
    """2 int A(mu) mu dmu and its error bound.

    A changes on the scale `width` next to the horizon, hence mu = 3 width sinh v; the first panel's
    nodes lean towards mu = 0, where A may have a logarithm. A has kinks in mu at the breaks;
    a break at 1 says that it is not smooth at the normal.
    """
    inside = [b for b in breaks if 0.0 < b < 1.0]
    scale = 3.0 * width
    edges = np.arcsinh(np.array([0.0, *inside, 1.0]) / scale)

    def rule(size: float) -> Sum:
        nodes = (clustered if breaks else leaning)(node_count(size * (20.0 + edges[-1])))
        v, weight = panels(nodes, edges)
        mu = np.minimum(scale * np.sinh(v), 1.0)
        parts = np.array([albedo(float(m)) for m in mu])
        weighted = parts * (2.0 * scale * weight * mu * np.cosh(v))[:, None]
        bounds.append(float(np.abs(weighted[:, 1]).sum()))
        return total(weighted[:, 0])

    bounds: list[float] = []
    value, error = converge(rule, agreements=2)  # A may be smooth on no scale that is known
    return value, error + bounds[-1]


def independent(result: tuple[float, float], source: str) -> Truth:
    """Truth of a quadrature over a formula of its own."""
    return Truth(*result, "independent", source)
