"""The picture of a white furnace: albedo and its error against angle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.pictures import style

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Series(NamedTuple):
    """The albedo of a parameter set and channel; its reference, (theta_o in degrees, A)."""

    label: str
    findings: list[Finding]
    curve: Sequence[tuple[float, ...]]


def figure(report: Report) -> Figure:
    """Albedo against angle with its error band and reference; below it the error on a log scale."""
    figure, top, bottom = style.panels(7.0)
    total = series(report)
    for one, (colour, marker) in zip(total, style.SERIES, strict=False):
        _albedo(top, one, colour, marker)
        _error(bottom, one, colour, marker)
    top.axhline(1.0, color=style.GREY, linewidth=0.8, linestyle=style.DOTS)
    top.set_ylabel("directional albedo A")
    top.set_ylim(0.0, 1.08 * max(1.0, top.dataLim.y1))
    top.set_title(_title(report, len(total)), fontsize=10)
    if 0.0 < bottom.dataLim.y1 < math.inf:  # else nothing but NaN is drawn
        bottom.set_yscale("log")
    bottom.set_ylabel("|A - reference|")
    bottom.set_xlim(-2.0, 92.0)
    style.grid(top, bottom)
    values = [f.value for r in report.results for f in r.findings if f.quantity == "A"]
    style.say_what_is_not_finite(top, values)
    _explain(figure, top, bottom)
    return figure


def _title(report: Report, total: int) -> str:
    models = ", ".join(dict.fromkeys(r.model for r in report.results))
    shown = len(style.SERIES)
    more = f" ({shown} of {total} parameter sets)" if total > shown else ""
    return f"white furnace: {models}{more}, verdict {report.verdict}"


def _explain(figure: Figure, *panels: Axes) -> None:
    """One legend below the panels, where it hides nothing; every line style named once."""
    named: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    if not named:
        return
    figure.legend([*named.values()], [*named], loc="outside lower center", ncols=3, fontsize=8)


def series(report: Report) -> list[Series]:
    """One series per parameter set and channel."""
    found = []
    for result in report.results:
        findings = [f for f in result.findings if f.quantity == "A"]
        for channel in sorted({f.where.get("channel", 0) for f in findings}):
            rows = [f for f in findings if f.where.get("channel", 0) == channel]
            label = _label(result, channel if any("channel" in f.where for f in rows) else None)
            rows = [f for f in rows if math.isfinite(f.value)]
            curve = result.curves[channel] if channel < len(result.curves) else _expected(rows)
            found.append(Series(label, rows, curve))
    return found


def _expected(findings: list[Finding]) -> list[tuple[float, float]]:
    return [(f.where["theta_o_deg"], f.expected) for f in findings if f.expected is not None]


def _label(result: Result, channel: int | None) -> str:
    def of_channel(value: Any) -> Any:
        return value[channel] if channel is not None and isinstance(value, (list, tuple)) else value

    return style.assigned({k: of_channel(v) for k, v in result.params.items()})


def _albedo(axes: Axes, one: Series, colour: str, marker: str) -> None:
    theta = style.angles(one.findings)
    values, bars = [f.value for f in one.findings], [style.bar(f) for f in one.findings]
    low, high = ([v + s * b for v, b in zip(values, bars, strict=True)] for s in (-1.0, 1.0))
    axes.fill_between(theta, low, high, color=colour, alpha=0.2, linewidth=0)
    axes.errorbar(theta, values, bars, fmt=marker, color=colour, markersize=4, capsize=2,
                  label=f"{one.label or 'estimate'} (+- 3 stderr)")  # fmt: skip
    if one.curve:
        axes.plot(*zip(*one.curve, strict=False), color=colour, linewidth=1.0,
                  label="line above: reference")  # fmt: skip


def _error(axes: Axes, one: Series, colour: str, marker: str) -> None:
    rows = [f for f in one.findings if f.expected is not None]
    theta = style.angles(rows)
    errors = [style.error(f) for f in rows]
    axes.plot(theta, errors, marker, color=colour, markersize=4, label="marker below: error")
    axes.plot(theta, [max(f.stderr, style.SMALLEST) for f in rows], color=colour, linewidth=1.0,
              label="line below: stderr")  # fmt: skip
    tolerances = [math.nan if f.tolerance is None else f.tolerance for f in rows]
    axes.plot(theta, tolerances, color=colour, linewidth=0.8,
              linestyle=style.DASHES, label="dashed: tolerance")  # fmt: skip
