"""Where a reflection has kinks: half-vector slopes t as functions of k, and azimuths k.

With t = tan x and k = tan a, h.v = mu_o cos(x - a)/cos(a), the light is at the horizon at
x = 45 degrees + a/2 and in the view's mirror direction at x = 0. `Kinks` tells the slopes in
increasing order for every k; `breaks` are the k at which a kink appears, ends or meets another.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.references._rules import Array

TINY = 1e-300
SEARCH = 256  # azimuths between which at most one meeting is looked for
APART = 1.0 + 1e-9  # curves that run together do not cross at every rounding
Slopes = Callable[[Array], tuple[Array, ...]]


class Kinks(NamedTuple):
    """Slopes at which f has a kink for a k, how many curves they are, and the breaks in k.

    A break beyond the view's own plane, k = inf, only says that f is not smooth there.
    """

    slopes: Slopes = lambda k: ()
    curves: int = 0
    breaks: tuple[float, ...] = ()


SMOOTH = Kinks()


def together(a: Kinks, b: Kinks, tan_o: float) -> Kinks:
    """All kinks of a product, with breaks where some of a meet some of b."""
    if not (a.curves and b.curves):
        return (a if a.curves else b)._replace(breaks=a.breaks + b.breaks)

    def slopes(k: Array) -> tuple[Array, ...]:
        return tuple(np.sort(np.stack([*a.slopes(k), *b.slopes(k)]), axis=0))

    return Kinks(slopes, a.curves + b.curves, a.breaks + b.breaks + _meetings(a, b, tan_o))


def _meetings(a: Kinks, b: Kinks, tan_o: float) -> tuple[float, ...]:
    """The k up to tan_o at which curves of a and b cross, by bisection of changes of sign."""

    def above(y: Array) -> Array:
        k = np.sinh(y)
        return np.array([one > APART * other for one in a.slopes(k) for other in b.slopes(k)])

    grid = np.linspace(-1.0, 1.0, SEARCH) * np.arcsinh(tan_o)
    signs = above(grid)
    pair, at = np.nonzero(signs[:, 1:] != signs[:, :-1])
    low, high, before = grid[at], grid[at + 1], signs[pair, at]
    for _ in range(50):
        middle = 0.5 * (low + high)
        same = above(middle)[pair, np.arange(len(pair))] == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return tuple(float(k) for k in np.sinh(low))


def v_cavity(mu_o: float) -> Kinks:
    """Where min(1, 2 (n.h) min(mu_i, mu_o)/(h.v)) changes branch.

    Light masked from x = 30 degrees + a/3; view masked from x = 90 degrees - a; equal cosines at
    x = a. They meet at a = 45 degrees, that is at k = 1.
    """

    def slopes(k: Array) -> tuple[Array, Array]:
        light = np.tan(np.pi / 6.0 + np.arctan(k) / 3.0)
        return np.where(k > 1.0, 1.0 / np.maximum(k, 1.0), light), np.where(k > 1.0, k, light)

    return Kinks(slopes, 2, (1.0,) if mu_o * mu_o < 0.5 else ())


def cosine(mu_o: float, mu: float) -> Kinks:
    """Where mu_i = mu: roots of (mu + mu_o) t^2 - 2 k mu_o t + mu - mu_o = 0."""

    def slopes(k: Array) -> tuple[Array, Array]:
        root = np.sqrt(np.maximum((k * mu_o) ** 2 + (mu_o - mu) * (mu_o + mu), 0.0))
        far = np.maximum(k * mu_o + np.copysign(root, k), 0.0) / (mu + mu_o)
        near = (mu - mu_o) / (k * mu_o + np.copysign(np.maximum(root, TINY), k))
        return np.minimum(near, far), np.maximum(near, far)

    turn = math.sqrt(max((mu - mu_o) * (mu + mu_o), 0.0)) / mu_o
    return Kinks(slopes, 2, (turn,) if turn else ())


def light_at_normal(mu_o: float, sine_o: float) -> Kinks:
    """t = tan(theta_o/2) in the view's plane."""
    half = sine_o / (1.0 + mu_o)
    return Kinks(lambda k: (np.full_like(k, half),), 1, (math.inf,))


def total_reflection(mu_o: float, c: float) -> Kinks:
    """Where h.v = c, that is at x = a -+ arccos(c cos(a)/mu_o).

    The two meet where the arc cosine vanishes, next to k = 0 for a view at the critical angle; the
    farther one reaches the horizon at sin a = 1 - mu_o^2/(2 c^2).
    """

    def slopes(k: Array) -> tuple[Array, Array]:
        a = np.arctan(k)
        away = np.arccos(np.minimum(c / (mu_o * np.sqrt(1.0 + k * k)), 1.0))
        near, far = np.maximum(a - away, 0.0), a + away
        return np.tan(near), np.where(far < 0.5 * np.pi, np.tan(far), np.inf)

    meet = math.sqrt(max((c - mu_o) * (c + mu_o), 0.0)) / mu_o
    low = 0.5 * (mu_o / c) ** 2
    horizon = {(1.0 - low) / math.sqrt(low * (2.0 - low))} if low < 2.0 else set()
    return Kinks(slopes, 2, tuple({-meet, meet} | horizon))
