"""Pictures of a table: its values, and how far a polynomial or another table is off, the worst
place marked. One axis is a line; of three, the first value of the last is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.pictures.style import BLACK, BLUE, grid, wrapped
from montecarlo_brdf.report.text import called

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SIZE = 4.2  # inches of a panel


class Panel(NamedTuple):
    """Values of one quantity at cells, and what stands out among them."""

    title: str
    axes: Sequence[dict[str, Any]]
    values: Array  # (cells along each axis)
    worst: Finding | None = None  # of deviations


def figure(report: Report) -> Figure:
    """A row for the values, and one for everything that was held against them."""
    from matplotlib.figure import Figure

    rows = [row for result in report.results if result.curves and (row := _row(report, result))]
    columns = max(map(len, rows))
    size = (SIZE * columns + 0.6, 0.82 * SIZE * len(rows) + 0.7)
    drawn = Figure(figsize=size, layout="constrained")
    for panels, places in zip(rows, drawn.subplots(len(rows), columns, squeeze=False), strict=True):
        for panel, place in zip(panels, places, strict=False):
            _draw(drawn, place, panel)
        for place in places[len(panels) :]:
            place.set_visible(False)
    first = report.results[0]
    params = {**first.params, **report.settings["formulas"]}
    drawn.suptitle(wrapped(called(first.model, params), 30 * columns), fontsize=11)
    return drawn


def _row(report: Report, result: Result) -> list[Panel]:
    axes, names = report.settings["axes"], report.settings["quantities"]
    shape = [axis["size"] for axis in axes]
    panels = []
    for k, (name, rows) in enumerate(zip(names, result.curves, strict=True)):
        values = np.array([row[-1] for row in rows], dtype=float).reshape(shape)
        away = result.check != "cells"
        title = f"{result.check}: {name}, off by up to {abs(result.findings[k].value):.2g}"
        panels.append(Panel(title if away else name, axes, values,
                            result.findings[k] if away else None))  # fmt: skip
    return panels


def _draw(drawn: Figure, place: Axes, panel: Panel) -> None:
    place.set_title(wrapped(panel.title, 42), fontsize=9)
    place.set_xlabel(panel.axes[0]["name"])
    if len(panel.axes) == 1:
        _line(place, panel)
    else:
        _map(drawn, place, panel)


def _line(place: Axes, panel: Panel) -> None:
    place.plot(_values(panel.axes[0]), panel.values, "-o", color=BLUE, markersize=3)
    if panel.worst:
        place.plot([panel.worst.where[panel.axes[0]["name"]]], [panel.worst.value], "x",
                   color=BLACK, markersize=9)  # fmt: skip
        place.axhline(0.0, color="0.6", linewidth=0.8)
    grid(place)


def _map(drawn: Figure, place: Axes, panel: Panel) -> None:
    """Values in the colours of viridis; deviations in two colours around white."""
    values = panel.values if panel.values.ndim == 2 else panel.values[..., 0]
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    colours = "viridis"
    if panel.worst:
        size = max(-low, high) or 1.0
        low, high, colours = -size, size, "RdBu_r"
    x, y = panel.axes[:2]
    image = place.pcolormesh(_edges(x), _edges(y), values.T, cmap=colours, vmin=low, vmax=high,
                             rasterized=True)  # fmt: skip
    drawn.colorbar(image, ax=place, shrink=0.9)
    place.set_ylabel(y["name"])
    if panel.worst:
        at = panel.worst.where
        place.plot([at[x["name"]]], [at[y["name"]]], "o", markersize=10, markerfacecolor="none",
                   markeredgecolor=BLACK, markeredgewidth=1.4, clip_on=False)  # fmt: skip
    if len(panel.axes) > 2:
        z = panel.axes[2]
        place.set_xlabel(f"{x['name']}  ({z['name']} = {_values(z)[0]:.4g})")


def _values(axis: dict[str, Any]) -> Array:
    edges = axis["placement"] == "edges"
    steps = np.arange(axis["size"])
    part = steps / (axis["size"] - 1) if edges else (steps + 0.5) / axis["size"]
    return np.asarray(axis["low"] + part * (axis["high"] - axis["low"]))


def _edges(axis: dict[str, Any]) -> Array:
    """Half way between the values."""
    x = _values(axis)
    return np.concatenate([[1.5 * x[0] - 0.5 * x[1]], 0.5 * (x[1:] + x[:-1]),
                           [1.5 * x[-1] - 0.5 * x[-2]]])  # fmt: skip
