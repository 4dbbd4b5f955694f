"""Heat maps of a model's errors: where in angle and roughness the digits go."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.judge.finding import Report

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.figure import Figure

LEAST = 0.5  # roundings: what is less is drawn as this
#: theta_o in degrees, value of the parameter, relative error (of JSON, None if it is not finite)
Points = Iterable[tuple[float, ...]]


class Map(NamedTuple):
    """The errors of a model in one precision, against the parameter that sharpens its lobe."""

    title: str
    parameter: str
    points: Points
    eps: float  # one rounding of the precision


def figure(report: Report) -> Figure:
    """One map per model and precision, (theta_o, roughness or exponent) against worst error."""
    from matplotlib.figure import Figure

    shown = maps(report)
    columns = max(1, min(2, len(shown)))
    rows = max(1, -(-len(shown) // columns))
    figure = Figure(figsize=(6.2 * columns, 3.3 * rows + 0.5), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, one in zip(panels, shown, strict=False):
        figure.colorbar(_panel(axes, one), ax=axes, label="worst error in roundings")
    for axes in panels[len(shown) :]:
        axes.set_axis_off()
    words = "Worst error of f in roundings of each precision; what is NaN or above 1 counts as 1."
    figure.suptitle(words, fontsize=9)
    if not shown:
        why = "no parameter of this model sharpens its lobe: nothing to map"
        panels[0].set_title(why, fontsize=9)
    return figure


def maps(report: Report) -> list[Map]:
    """Of every model and precision that has one."""
    return [
        Map(f"{result.model}, {measured['name']}", measured["parameter"], points, measured["eps"])
        for result, precisions in zip(report.results, report.measured["precisions"], strict=True)
        for measured, points in zip(precisions, result.curves, strict=False)
        if points
    ]


def _panel(axes: Axes, one: Map) -> QuadMesh:
    """A cell per angle and value: both are a few chosen numbers over many decades."""
    cells = {k: max(e / one.eps, LEAST) for k, e in _worst(one.points).items()}
    angles = sorted({x for x, _ in cells}, reverse=True)
    values = sorted({v for _, v in cells})
    grid = [[cells.get((x, v), math.nan) for x in angles] for v in values]
    most = max(100.0, *cells.values())
    drawn = axes.pcolormesh(grid, norm="log", vmin=LEAST, vmax=most, cmap="viridis")
    if max(cells.values()) <= 1.0:
        axes.text(0.5, 0.5, "no error above one rounding", transform=axes.transAxes, ha="center",
                  va="center", color="white", fontsize=9)  # fmt: skip
    axes.set_xticks([k + 0.5 for k in range(len(angles))], [f"{x:.2g}" for x in angles],
                    rotation=90)  # fmt: skip
    axes.set_yticks([k + 0.5 for k in range(len(values))], [f"{v:.3g}" for v in values])
    axes.tick_params(labelsize=7)
    axes.set_title(one.title, fontsize=9)
    axes.set_xlabel("90 - theta_o (degrees)")
    axes.set_ylabel(one.parameter)
    return drawn


def _worst(points: Points) -> dict[tuple[float, float], float]:
    """(degrees above the horizon, roughness) -> worst error; what is infinite counts as 1.

    A direction lower than any angle counts as 1e-7 degrees; angles are told apart by two digits.
    """
    cells: dict[tuple[float, float], float] = {}
    for theta, value, error in points:
        place = float(f"{max(90.0 - theta, 1e-7):.2g}"), value
        shown = 1.0 if error is None or math.isnan(error) else min(error, 1.0)
        cells[place] = max(shown, cells.get(place, 0.0))
    return cells
