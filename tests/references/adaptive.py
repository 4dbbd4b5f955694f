"""The albedo of any f given as a function, by adaptive quadrature that says what it cannot resolve.

The hemisphere is cut into cells of a chart in which the horizon is stretched: elevation
y = (pi/2) u^2 and azimuth, with edges where models have kinks (the view's elevation, the planes at
0 and 90 degrees to it). Each cell is integrated by three Gauss rules, whose largest difference is
its error; the worst cells are halved until the sum of the errors is small or the budget is spent.
All this happens twice, from two unlike grids: a corner that a kink cuts off between the nodes of a
cell is in neither rule's view (seen: off by 2e-9, bound 5e-11), but not in both grids, and their
disagreement counts as error.

A peak that no node sees has no error. So before anything is believed, the cells at every place
where reflections peak (mirror direction, back to the view, and the caller's own) are halved down
to 1e-4 radians, whatever their error; and as a half-vector lobe of width alpha narrows towards the
horizon to alpha (mu_i + mu_o) in azimuth, so do the cells on either side of the mirror's azimuth.
A lobe anywhere else is seen if it is wider than about 0.02 radians.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import numpy.typing as npt

from montecarlo_brdf.references._rules import ROUNDING, Array, gauss
from montecarlo_brdf.references._truth import EPSILON, Truth

Integrand = Callable[[Array], Array]
Mask = npt.NDArray[np.bool_]
Place = tuple[float, float]  # chart coordinates u, phi
RULES = (11, 9, 7)  # nodes per side of a cell; the first gives the value
GRIDS = ((12, 32), (13, 36))  # cells of the first grids in elevation and azimuth
BATCH = 64  # cells halved at a time
CLOSE = 1e-4  # radians to which the grid closes in on a possible peak
KIND = "quadrature of the same f"

# A set of cells is an array (cells, 4) of u_low, u_high, phi_low, phi_high.


def _sides(cells: Array) -> tuple[Array, Array]:
    """Extents in radians; along u in the stretched measure, which is the finer at the horizon."""
    width = np.cos(0.5 * np.pi * cells[:, 0] ** 2) * (cells[:, 3] - cells[:, 2])
    return 0.5 * np.pi * (cells[:, 1] - cells[:, 0]), width


def _halve(cells: Array, low: Array | None = None) -> Array:
    """Cut every cell across its longer side, or the side that starts at column `low`."""
    if low is None:
        height, width = _sides(cells)
        low = np.where(height >= width, 0, 2)
    row = np.arange(len(cells))
    middle = 0.5 * (cells[row, low] + cells[row, low + 1])
    first, second = cells.copy(), cells.copy()
    first[row, low + 1] = second[row, low] = middle
    return np.concatenate([first, second])


def _nodes(cells: Array, n: int) -> tuple[Array, Array]:
    """Directions (3, N) and solid-angle weights (cells, n * n) of the n by n rule on every cell."""
    rule = gauss(n)
    height, width = cells[:, 1:2] - cells[:, 0:1], cells[:, 3:4] - cells[:, 2:3]
    u, phi = cells[:, 0:1] + height * rule.x, cells[:, 2:3] + width * rule.x
    y = 0.5 * np.pi * u * u
    along_u = height * rule.weight * np.pi * u * np.cos(y)
    weight = along_u[:, :, None] * (width * rule.weight)[:, None, :]
    y, phi = np.broadcast_arrays(y[:, :, None], phi[:, None, :])
    directions = np.stack([np.cos(y) * np.cos(phi), np.cos(y) * np.sin(phi), np.sin(y)])
    return directions.reshape(3, -1), weight.reshape(len(cells), -1)


def _sums(f: Integrand, cells: Array, n: int, cosine: bool) -> tuple[Array, Array]:
    """Integral of f and of |f| over every cell by the n by n rule."""
    directions, weight = _nodes(cells, n)
    values = np.asarray(f(directions), float) * (directions[2] if cosine else 1.0)
    terms = values.reshape(weight.shape) * weight
    return terms.sum(axis=1), np.abs(terms).sum(axis=1)


def _measure(f: Integrand, cells: Array, cosine: bool) -> Array:
    """Columns value, error and magnitude of every cell."""
    (value, magnitude), *others = (_sums(f, cells, n, cosine) for n in RULES)
    error = np.max([np.abs(value - other) for other, _ in others], axis=0)
    return np.stack([value, error, magnitude], axis=1)


def _place(w: Sequence[float]) -> Place:
    elevation = math.atan2(max(w[2], 0.0), math.hypot(w[0], w[1]))
    return math.sqrt(elevation * 2.0 / math.pi), math.atan2(w[1], w[0])


def _touches(cells: Array, place: Place) -> Mask:
    u, phi = place
    in_u = (cells[:, 0] <= u + 1e-12) & (cells[:, 1] >= u - 1e-12)
    turns = phi + 2.0 * np.pi * np.arange(-2, 3)
    inside = (cells[:, 2:3] <= turns + 1e-12) & (cells[:, 3:4] >= turns - 1e-12)
    return in_u & (inside.any(axis=1) | (u > 1.0 - 1e-9))  # at the normal every azimuth


def _close_in(cells: Array, wanted: Callable[[Array], Mask], low: int | None = None) -> Array:
    """Halve the wanted cells until none is left."""
    done = []
    while len(cells):
        near = wanted(cells)
        done.append(cells[~near])
        cells = _halve(cells[near], None if low is None else np.full(int(near.sum()), low))
    return np.concatenate(done)


def _coarse_at(place: Place, cells: Array) -> Mask:
    return _touches(cells, place) & (np.maximum(*_sides(cells)) > CLOSE)


def _first_cells(grid: tuple[int, int], view: Place, places: Sequence[Place]) -> Array:
    """A plain grid, closed in on the places and on the azimuth of the first one, the mirror."""
    u = np.unique([*np.linspace(0.0, 1.0, grid[0] + 1), view[0]])
    phi = view[1] + np.linspace(-np.pi, np.pi, grid[1] + 1)
    low_u, low_phi = np.meshgrid(u[:-1], phi[:-1], indexing="ij")
    high_u, high_phi = np.meshgrid(u[1:], phi[1:], indexing="ij")
    cells = np.stack([c.ravel() for c in (low_u, high_u, low_phi, high_phi)], axis=1)
    for place in places:
        cells = _close_in(cells, partial(_coarse_at, place))

    def ridge(c: Array) -> Mask:
        mu_i, mu_o = (np.sin(0.5 * np.pi * u * u) for u in (c[:, 1], view[0]))
        beside = _touches(np.column_stack([0.0 * mu_i, 1.0 + mu_i, c[:, 2:]]), (0.5, places[0][1]))
        return beside & (c[:, 3] - c[:, 2] > 10.0 * CLOSE * (mu_i + mu_o))

    return _close_in(cells, ridge, low=2)


def _noise(f: Integrand, cells: Array, cosine: bool) -> float:
    """How much the integral moves if every direction is long by two roundings: f's own rounding."""
    moved = _sums(lambda w: f(w * (1.0 + 2.0 * EPSILON)), cells, RULES[0], cosine)[0]
    return float(abs((moved - _sums(f, cells, RULES[0], cosine)[0]).sum()))


def _adapt(
    f: Integrand, cells: Array, cosine: bool, tolerance: float, budget: float
) -> tuple[Array, int]:
    """Value, error and magnitude of the integral, and the evaluations it took."""
    parts = _measure(f, cells, cosine)
    per_cell = sum(n * n for n in RULES)
    evaluations = per_cell * len(cells)
    while evaluations < budget and np.isfinite(parts).all():
        _, error, magnitude = parts.sum(axis=0)
        if error <= tolerance * magnitude:
            break
        worst = np.argsort(parts[:, 1])[-BATCH:]
        worst = worst[parts[worst, 1] > 0.0]
        halves = _halve(cells[worst])
        cells = np.concatenate([np.delete(cells, worst, axis=0), halves])
        parts = np.concatenate([np.delete(parts, worst, axis=0), _measure(f, halves, cosine)])
        evaluations += per_cell * len(halves)
    total = parts.sum(axis=0)
    total[1] += _noise(f, cells, cosine)
    return total, evaluations


def quadrature(
    f: Integrand,
    wo: Sequence[float],
    *,
    cosine: bool = True,
    tolerance: float = 1e-10,
    budget: int = 3_000_000,
    peaks: Sequence[Sequence[float]] = (),
) -> Truth:
    """Integral of f(wi) cos(theta_i) dwi over the hemisphere, f mapping (3, N) to (N,).

    `cosine=False` leaves the cosine out (a pdf); `peaks` are further directions to look at closely;
    `tolerance` is relative to the integral of |f|. Where it is not met within `budget` evaluations
    the error is as large as it is, and the source begins with "not resolved".
    """
    places = [_place(w) for w in ((-wo[0], -wo[1], wo[2]), wo, *peaks)]
    with np.errstate(invalid="ignore", over="ignore"):  # f may be infinite: that is reported
        (one, first), (two, second) = (
            _adapt(f, _first_cells(grid, places[1], places), cosine, 0.5 * tolerance, 0.5 * budget)
            for grid in GRIDS
        )
        value = 0.5 * float(one[0] + two[0])
        bound = float(max(one[1], two[1]) + abs(one[0] - two[0]) + ROUNDING * one[2])
    if not math.isfinite(value + bound):
        return Truth(value, math.inf, KIND, "not resolved: f is not finite everywhere")
    source = f"adaptive quadrature, {first + second} evaluations"
    if bound > tolerance * one[2]:
        source = f"not resolved to {tolerance:g}: {source}"
    return Truth(value, bound, KIND, source)
