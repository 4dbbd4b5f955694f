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
KEY = "L_o +- 3 stderr,\nline: truth"


def figure(report: Report) -> Figure:
    """L_o above, its error on a log scale below."""
    figure, top, bottom = style.panels(8.0)
    result = report.results[0]
    total = series(result.findings)
    shown = list(total.items())[:MOST_SERIES]
    colours = style.CHANNELS if len(total) > 1 else (style.BLUE,)
    for (label, rows), colour in zip(shown, colours, strict=False):
        _draw(top, bottom, rows, label, colour)
    more = f" ({MOST_SERIES} of {len(total)} series)" if len(total) > MOST_SERIES else ""
    top.set_title(f"{result.model}{more}, verdict {report.verdict}", fontsize=10)
    top.set_ylabel("L_o in the unit of the light's radiance")
    top.set_ylim(0.0, _headroom([f.value for _, rows in shown for f in rows]))
    bottom.set_yscale("log")
    bottom.set_ylabel("|L_o - truth|")
    bottom.set_title(f"points: error (0 is drawn at {style.SMALLEST:g}), lines: stderr", fontsize=9)
    style.grid(top, bottom)
    values = [f.value for f in result.findings if f.quantity == "L_o"]
    style.say_what_is_not_finite(top, values)
    if not shown:
        return figure
    # beside the panel: inside it a legend hides points, and below it needs none
    top.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0), title=KEY, title_fontsize=8)
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


def _draw(top: Axes, bottom: Axes, rows: list[Finding], label: str, colour: str) -> None:
    theta = style.angles(rows)
    values, bars = [f.value for f in rows], [style.bar(f) for f in rows]
    top.errorbar(theta, values, bars, fmt="o", markersize=4, capsize=2, color=colour, label=label)
    truth = [math.nan if f.expected is None else f.expected for f in rows]
    top.plot(theta, truth, color=colour, linewidth=1.0)
    bottom.plot(theta, [style.error(f) for f in rows], "o", markersize=4, color=colour)
    errors = [max(style.bar(f) / 3.0, style.SMALLEST) for f in rows]
    bottom.plot(theta, errors, color=colour, linewidth=1.0)
