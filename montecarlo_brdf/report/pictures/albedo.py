"""The picture of a white furnace: albedo against angle and its error; many models in panels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.pictures import style
from montecarlo_brdf.report.text import called

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_PANELS = 48
ROW = 6  # panels in a row at most


class Series(NamedTuple):
    """The albedo of a parameter set and channel; its reference, (theta_o in degrees, A)."""

    label: str
    findings: list[Finding]
    curve: Sequence[tuple[float, ...]]


def figure(report: Report) -> Figure:
    """Albedo against angle; below it the error on a log scale, where there is room for it."""
    total = series(report)
    return _single(report, total) if len(total) <= len(style.SERIES) else _panels(report)


def _single(report: Report, total: Sequence[Series]) -> Figure:
    """All series in one panel, their errors in another."""
    figure, top, bottom = style.panels(8.5)
    for one, (colour, marker) in zip(total, style.SERIES, strict=False):
        _albedo(top, one, colour, marker)
        _error(bottom, one, colour, marker)
    _bound(top)
    top.set_ylabel("directional albedo A")
    top.set_title(_title(report), fontsize=10)
    if 0.0 < bottom.dataLim.y1 < math.inf:  # else nothing but NaN is drawn
        bottom.set_yscale("log")
    bottom.set_ylabel("|A - reference|")
    bottom.set_xlim(-2.0, 92.0)
    style.grid(top, bottom)
    style.say_what_is_not_finite(top, _values(report.results))
    style.explain(figure, top, bottom)
    return figure


def _panels(report: Report) -> Figure:
    """A panel for each model and parameter set, with a colour for each channel."""
    from matplotlib.figure import Figure

    shown = [r for r in report.results if any(f.quantity == "A" for f in r.findings)]
    left_out, shown = len(shown) - MOST_PANELS, shown[:MOST_PANELS]
    columns = min(ROW, math.ceil(math.sqrt(len(shown))))
    rows = math.ceil(len(shown) / columns)
    figure = Figure(figsize=(2.6 * columns + 0.6, 2.3 * rows + 1.2), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, squeeze=False)
    for axes, result in zip(panels.flat, shown, strict=False):
        _panel(axes, result)
    for axes in list(panels.flat)[len(shown) :]:
        axes.set_axis_off()
    more = f"; {left_out} more are not drawn" if left_out > 0 else ""
    figure.suptitle(style.wrapped(f"{_title(report)}{more}", 24 * columns), fontsize=10)
    figure.supxlabel(style.THETA_O, fontsize=9)
    figure.supylabel("directional albedo A: points +- 3 stderr, line: reference", fontsize=9)
    return figure


def _panel(axes: Axes, result: Result) -> None:
    for one, (colour, marker) in zip(_of_result(result), style.SERIES, strict=False):
        _albedo(axes, one, colour, marker)
    _bound(axes)
    axes.set_xlim(-2.0, 92.0)
    axes.tick_params(labelsize=7)
    axes.set_title(style.wrapped(called(result.model, result.params), 30, 3), fontsize=7)
    style.grid(axes)
    style.say_what_is_not_finite(axes, _values([result]), 7)


def _bound(axes: Axes) -> None:
    """The line above which more leaves than arrives."""
    axes.axhline(1.0, color=style.GREY, linewidth=0.8, linestyle=style.DOTS)
    axes.set_ylim(0.0, 1.08 * max(1.0, axes.dataLim.y1 if math.isfinite(axes.dataLim.y1) else 1.0))


def _values(results: Sequence[Result]) -> list[float]:
    return [f.value for r in results for f in r.findings if f.quantity == "A"]


def _title(report: Report) -> str:
    models = list(dict.fromkeys(r.model for r in report.results))
    named = ", ".join(models) if len(models) < 4 else f"{len(models)} models"
    return style.wrapped(f"white furnace: {named}, {style.verdict(report)}", 90)


def series(report: Report) -> list[Series]:
    """One series per parameter set and channel."""
    several = len({r.model for r in report.results}) > 1
    return [
        one._replace(label=style.joined(result.model if several else "", one.label))
        for result in report.results
        for one in _of_result(result)
    ]


def _of_result(result: Result) -> list[Series]:
    findings = [f for f in result.findings if f.quantity == "A"]
    found = []
    for channel in sorted({f.where.get("channel", 0) for f in findings}):
        rows = [f for f in findings if f.where.get("channel", 0) == channel]
        coloured = any("channel" in f.where for f in rows)
        label = _label(result, channel if coloured else None)
        rows = [f for f in rows if math.isfinite(f.value)]
        curve = result.curves[channel] if channel < len(result.curves) else _expected(rows)
        found.append(Series(label, rows, curve))
    return found


def _expected(findings: list[Finding]) -> list[tuple[float, float]]:
    return [(f.where["theta_o_deg"], f.expected) for f in findings if f.expected is not None]


def _label(result: Result, channel: int | None) -> str:
    def of_channel(value: Any) -> Any:
        return value[channel] if channel is not None and isinstance(value, (list, tuple)) else value

    values = style.assigned({k: of_channel(v) for k, v in result.params.items()})
    return style.joined("" if channel is None else f"channel {channel}", values)


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
