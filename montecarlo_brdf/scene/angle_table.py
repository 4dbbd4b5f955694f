"""Radiance of an isotropic lobe under a constant sky, tabulated over the one angle it depends on.

Nodes are even in sqrt(mu), mu = n.v, for what happens towards the limb; between them a cubic goes
through the four nearest. The error stated is that of a table of half as many nodes at the nodes it
leaves out, which is more than that of the table used, plus that of the nodes themselves.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import charts_of
from montecarlo_brdf.sampling.points import PointSet
from montecarlo_brdf.scene.pixels import PLACE, means
from montecarlo_brdf.scene.plan import Method, Work
from montecarlo_brdf.scene.radiance import constant_values

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    Reals = NDArray[float64]

INTERVALS = 128
TARGET = 1e-6  # relative, of a node in a chart that fits the lobe
FEWEST_SAMPLES, MOST_SAMPLES = 1 << 14, 1 << 20  # per node where no chart fits
ENOUGH = 2e-5  # relative to a light of 1


def tabulated(
    work: Work, mu: Reals, seed: int, key: int, threads: int
) -> tuple[Reals, float, str]:
    """Radiance (n, sets) at the cosines `mu`, a bound on its error, and how it was found."""
    import numpy as np

    if work.method is Method.ONE_VALUE:
        return np.tile(constant_values(work), (len(mu), 1)), 0.0, "one value"
    low = float(np.sqrt(np.min(mu)))
    cosines = np.linspace(low, 1.0, INTERVALS + 1) ** 2
    values, noise = _charted(work, cosines, seed) or _sampled(work, cosines, key, threads)
    found = cubic(values, (np.sqrt(mu) - low) / (1.0 - low))
    return found, noise + _left_out(values), f"table of {INTERVALS + 1} angles"


def _charted(work: Work, cosines: Reals, seed: int) -> tuple[Reals, float] | None:
    """Every node to TARGET in the chart that fits the lobe; None where none does."""
    import numpy as np

    charts = charts_of(work.model)
    plan = Plan(points=PointSet.LATTICE, seed=seed, target_error=TARGET)
    rows: list[list[float]] = []
    for mu in map(float, cosines) if charts else ():
        wo = (math.sqrt((1.0 - mu) * (1.0 + mu)), 0.0, mu)
        found = [adaptive.albedo(work.model, p, wo, plan, charts[0]) for p, _ in work.sets]
        if not all(reached for _, reached in found):
            return None
        rows.append([e.mean for (e,), _ in found])
    return (np.array(rows), TARGET * float(np.max(np.abs(rows)))) if rows else None


def _sampled(work: Work, cosines: Reals, key: int, threads: int) -> tuple[Reals, float]:
    """Samples are added until that no longer makes the table more exact."""
    import numpy as np

    places = np.zeros((len(cosines), PLACE))
    places[:, 0], places[:, 2] = np.sqrt(1.0 - cosines * cosines), cosines
    places[:, 3] = places[:, 7] = places[:, 11] = 1.0
    samples, error, before = FEWEST_SAMPLES // 8, np.inf, np.inf
    while error > ENOUGH and samples < MOST_SAMPLES and (before == np.inf or error < 0.7 * before):
        samples, before = 8 * samples, error
        values, noise = means(work, places, samples, key, threads)
        # a constant integrand has no noise; else the nodes' noise shows in what is left out
        error = _left_out(values) if float(np.max(noise)) else 0.0
    return values, 0.0


def _left_out(values: Reals) -> float:
    """How far a table of every other node is from the nodes it leaves out."""
    import numpy as np

    odd = np.arange(1, INTERVALS, 2) / INTERVALS
    return float(np.max(np.abs(cubic(values[::2], odd) - values[1::2])))


def cubic(values: Reals, t: Reals) -> Reals:
    """Values (nodes, sets) on an even grid of [0, 1], through the four nearest nodes of t (n)."""
    import numpy as np

    x = np.clip(t, 0.0, 1.0) * (len(values) - 1)
    first = np.clip(np.floor(x).astype(int) - 1, 0, len(values) - 4)
    x = (x - first)[:, None]
    weights = (
        (x - 1.0) * (x - 2.0) * (x - 3.0) / -6.0,
        x * (x - 2.0) * (x - 3.0) / 2.0,
        x * (x - 1.0) * (x - 3.0) / -2.0,
        x * (x - 1.0) * (x - 2.0) / 6.0,
    )
    found: Reals = sum(w * values[first + k] for k, w in enumerate(weights))
    return found
