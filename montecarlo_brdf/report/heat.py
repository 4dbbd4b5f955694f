"""Heat maps of a stress report: where in angle and roughness the digits go."""

from __future__ import annotations

from typing import Any

FLOOR = 1e-17  # no error has no place on a log scale


def draw(report: dict[str, Any], figure: Any) -> None:
    """One map per model and precision, (theta_o, roughness or exponent) against worst error."""
    maps = [m for result in report["results"] for m in _maps(result)]
    columns = max(1, min(3, len(maps)))
    rows = max(1, -(-len(maps) // columns))
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for ax, (title, points) in zip(axes, maps, strict=False):
        _one(figure, ax, title, points)
    for ax in axes[len(maps) :]:
        ax.set_axis_off()
    figure.suptitle(f"Errors above 1 and NaN are drawn as 1, no error as {FLOOR:g}.", fontsize=9)
    if not maps:
        axes[0].set_title(
            "no parameter of this model sharpens its lobe: nothing to map", fontsize=9
        )


def _maps(result: dict[str, Any]) -> list[tuple[str, list[Any]]]:
    precisions = dict.fromkeys(f["where"]["precision"] for f in result["findings"])
    pairs = zip(precisions, result.get("curves", []), strict=False)
    return [(f"{result['model']}, {name}", points) for name, points in pairs if points]


def _one(figure: Any, ax: Any, title: str, points: list[Any]) -> None:
    cells = _worst(points)
    values = [v for _, v in cells]
    positive = [v for v in values if v > 0.0] or [1.0]
    drawn = ax.scatter([x for x, _ in cells], values, c=list(cells.values()), norm="log",
                       vmin=FLOOR, vmax=1.0, cmap="viridis", marker="s", s=18)  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("symlog", linthresh=min(positive))  # linear down to a roughness of 0
    ax.set_ylim(min(values) - 0.2 * min(positive), 2.0 * max(positive))
    ax.invert_xaxis()
    ax.set_title(title, fontsize=9)
    ax.set_xlabel("90 - theta_o (degrees)")
    ax.set_ylabel("roughness or exponent")
    figure.colorbar(drawn, ax=ax, label="worst relative error")


def _worst(points: list[Any]) -> dict[tuple[float, float], float]:
    """(degrees above the horizon, roughness) -> worst error; what is infinite counts as 1.

    A direction lower than any angle counts as 90 degrees; shown from the horizon, on a log axis.
    """
    cells: dict[tuple[float, float], float] = {}
    for theta, value, error in points:
        place = max(90.0 - theta, 1e-7), value
        shown = 1.0 if error is None else min(max(error, FLOOR), 1.0)
        cells[place] = max(shown, cells.get(place, FLOOR))
    return cells
