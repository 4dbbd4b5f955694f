"""The picture of a scene: L_o against angle with its error bars and what it must be."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from montecarlo_brdf.judge.finding import Finding, Report
from montecarlo_brdf.report.pictures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_SERIES = len(style.CHANNELS)


def figure(report: Report) -> Figure:
    """L_o above, its error on a log scale below."""
    figure, top, bottom = style.panels(8.0)
    result = report.results[0]
    total = series(result.findings)
    shown = list(total.items())[:MOST_SERIES]
    colours = style.CHANNELS if len(total) > 1 else (style.BLUE,)
    for (label, rows), colour, marker in zip(shown, colours, style.MARKERS, strict=False):
        _draw(top, bottom, rows, label, colour, marker)
    more = f" ({MOST_SERIES} of {len(total)} series)" if len(total) > MOST_SERIES else ""
    top.set_title(style.wrapped(f"{result.model}{more}, {style.verdict(report)}", 90), fontsize=10)
    top.set_ylabel("L_o in the unit of the light's radiance")
    top.set_ylim(0.0, _headroom([f.value for _, rows in shown for f in rows]))
    bottom.set_yscale("log")
    bottom.set_ylabel("|L_o - truth|")
    style.grid(top, bottom)
    values = [f.value for f in result.findings if f.quantity == "L_o"]
    style.say_what_is_not_finite(top, values)
    style.explain(figure, top, bottom)
    return figure


def _headroom(values: list[float]) -> float:
    """The end of an axis from 0: left to itself it puts equal values on its very edge."""
    return 1.08 * max([0.0, *values]) or 1.0


def series(findings: list[Finding]) -> dict[str, list[Finding]]:
    """Findings of L_o by channel or wavelength and azimuth."""
    found: dict[str, list[Finding]] = {}
    for f in findings:
        if f.quantity == "L_o" and math.isfinite(f.value):
            where = {k: v for k, v in f.where.items() if k != "theta_o_deg"}
            name = ", ".join(f"{k.removesuffix('_deg')} {v:g}" for k, v in where.items())
            found.setdefault(name or "estimate", []).append(f)
    return {k: sorted(v, key=lambda f: float(f.where["theta_o_deg"])) for k, v in found.items()}


def _draw(
    top: Axes, bottom: Axes, rows: list[Finding], label: str, colour: str, marker: str
) -> None:
    theta = style.angles(rows)
    values, bars = [f.value for f in rows], [style.bar(f) for f in rows]
    top.errorbar(theta, values, bars, fmt=marker, markersize=4, capsize=2, color=colour,
                 label=f"{label} (+- 3 stderr)")  # fmt: skip
    # known at these views alone: no line between them says more
    truth = [math.nan if f.expected is None else f.expected for f in rows]
    top.plot(theta, truth, "_", color=colour, markersize=14, label="dash above: truth")
    bottom.plot(theta, [style.error(f) for f in rows], marker, markersize=4, color=colour,
                label=f"marker below: error (0 at {style.SMALLEST:g})")  # fmt: skip
    errors = [max(style.bar(f) / 3.0, style.SMALLEST) for f in rows]
    bottom.plot(theta, errors, color=colour, linewidth=1.0, label="line below: stderr")
    tolerances = [math.nan if f.tolerance is None else f.tolerance for f in rows]
    bottom.plot(theta, tolerances, color=colour, linewidth=0.8, linestyle=style.DASHES,
                label="dashed: tolerance")  # fmt: skip
