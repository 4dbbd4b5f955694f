"""The picture of a benchmark: error against seconds, one panel per workload."""
from __future__ import annotations

import math
from typing import Any

#: Okabe and Ito's colours; ours is the strongest line
STYLES = {
    "brdf-check": ("#D55E00", "D", 2.2),
    "numpy": ("#000000", "o", 1.0),
    "naive numba": ("#999999", "v", 1.0),
    "scipy Sobol": ("#0072B2", "^", 1.0),
    "dblquad": ("#009E73", "s", 1.0),
    "dblquad LowLevelCallable": ("#009E73", "P", 1.0),
    "cubature": ("#CC79A7", "X", 1.0),
    "cubepy": ("#56B4E9", "<", 1.0),
    "vegas": ("#E69F00", ">", 1.0),
    "mitsuba llvm": ("#F0E442", "h", 1.0),
}
SMALLEST = 1e-16


def bench_figure(data: dict[str, Any]) -> Any:
    """Relative error against processor seconds."""
    from matplotlib.figure import Figure

    results = data["results"]
    columns = min(3, max(1, len(results)))
    rows = max(1, math.ceil(len(results) / columns))
    figure = Figure(figsize=(max(7.0, 3.4 * columns + 0.5), 3.0 * rows + 1.1), layout="constrained")
    panels = figure.subplots(rows, columns, sharey=True, sharex=True, squeeze=False)
    for axes, result in zip(panels.flat, results, strict=False):
        _panel(axes, result)
    shown = len(results)
    for axes in list(panels.flat)[shown:]:
        axes.set_visible(False)
    for axes in list(panels.flat)[max(0, shown - columns) : shown]:  # the lowest of each column
        axes.set_xlabel("processor time (s)")
        axes.tick_params(labelbottom=True)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    known: dict[str, Any] = {}
    for axes in panels.flat:
        known |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    figure.legend(
        list(known.values()), list(known), loc="outside lower center", ncols=4, fontsize=8
    )
    return figure


def _panel(axes: Any, result: dict[str, Any]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    for method, (colour, marker, width) in STYLES.items():
        rows = [t for t in result["timings"] if t["method"] == method]
        if rows:
            seconds, errors = zip(*((t["seconds"], t["error"]) for t in rows), strict=True)
            axes.plot(seconds, [max(e, SMALLEST) for e in errors], color=colour, marker=marker,
                      markersize=4, linewidth=width, label=method)  # fmt: skip
    axes.set_title(result["title"], fontsize=9)
    axes.grid(alpha=0.25)
