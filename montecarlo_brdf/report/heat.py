"""Heat maps of a stress report: where in angle and roughness the digits go."""

from __future__ import annotations

import math
from typing import Any

FLOOR = 1e-17  # no error has no place on a log scale


def draw(report: dict[str, Any], figure: Any) -> None:
    """One map per model and precision, (theta_o, roughness or exponent) against worst error."""
    maps = [m for result in report["results"] for m in _maps(result)]
    columns = max(1, min(2, len(maps)))
    rows = max(1, -(-len(maps) // columns))
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    drawn = [_one(ax, *one) for ax, one in zip(axes, maps, strict=False)]
    for ax in axes[len(maps) :]:
        ax.set_axis_off()
    figure.suptitle(f"Errors above 1 and NaN are drawn as 1, no error as {FLOOR:g}.", fontsize=9)
    if maps:
        figure.colorbar(drawn[0], ax=axes.tolist(), label="worst relative error")
    else:
        axes[0].set_title(
            "no parameter of this model sharpens its lobe: nothing to map", fontsize=9
        )


def _maps(result: dict[str, Any]) -> list[tuple[str, str, list[Any]]]:
    """(title, parameter, points) of each precision."""
    findings = result["findings"]
    precisions = dict.fromkeys(f["where"]["precision"] for f in findings)
    quantities = [f["quantity"] for f in findings if " safe " in f["quantity"]]
    name = quantities[0].partition(" safe ")[2] if quantities else ""
    pairs = zip(precisions, result.get("curves", []), strict=False)
    return [(f"{result['model']}, {kind}", name, points) for kind, points in pairs if points]


def _one(ax: Any, title: str, parameter: str, points: list[Any]) -> Any:
    """A cell per angle and value: both are a few chosen numbers over many decades."""
    cells = _worst(points)
    angles = sorted({x for x, _ in cells}, reverse=True)
    values = sorted({v for _, v in cells})
    grid = [[cells.get((x, v), math.nan) for x in angles] for v in values]
    drawn = ax.pcolormesh(grid, norm="log", vmin=FLOOR, vmax=1.0, cmap="viridis")
    ax.set_xticks([k + 0.5 for k in range(len(angles))], [f"{x:.2g}" for x in angles], rotation=90)
    ax.set_yticks([k + 0.5 for k in range(len(values))], [f"{v:.3g}" for v in values])
    ax.tick_params(labelsize=7)
    ax.set_title(title, fontsize=9)
    ax.set_xlabel("90 - theta_o (degrees)")
    ax.set_ylabel(parameter)
    return drawn


def _worst(points: list[Any]) -> dict[tuple[float, float], float]:
    """(degrees above the horizon, roughness) -> worst error; what is infinite counts as 1.

    A direction lower than any angle counts as 1e-7 degrees; angles are told apart by two digits.
    """
    cells: dict[tuple[float, float], float] = {}
    for theta, value, error in points:
        place = float(f"{max(90.0 - theta, 1e-7):.2g}"), value
        shown = 1.0 if error is None else min(max(error, FLOOR), 1.0)
        cells[place] = max(shown, cells.get(place, FLOOR))
    return cells
