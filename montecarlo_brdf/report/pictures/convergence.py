"""The picture of convergence: error against samples, one panel per sampler."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from montecarlo_brdf.judge.finding import Finding, Report
from montecarlo_brdf.report.pictures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

GUIDES = (-0.5, -1.0, -2.0)
EXACT = 1e-13  # an error below it is rounding
SMALLEST = 1e-16  # errors are relative: below it there is only rounding


def figure(report: Report) -> Figure:
    """Relative error against samples per randomisation, for the first parameter set."""
    from matplotlib.figure import Figure

    findings = [f for f in report.results[0].findings if f.estimators]
    samplers = list(dict.fromkeys(f.where["sampler"] for f in findings))
    columns = min(2, max(1, len(samplers)))
    rows = max(1, math.ceil(len(samplers) / columns))
    figure = Figure(figsize=(4.4 * columns + 0.6, 3.7 * rows + 0.8), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, sampler in zip(panels.flat, samplers, strict=False):
        _panel(axes, [f for f in findings if f.where["sampler"] == sampler], sampler)
    for axes in list(panels.flat)[len(samplers) :]:
        axes.set_visible(False)
    for axes in list(panels.flat)[: len(samplers)][-columns:]:  # nothing stands below them
        axes.set_xlabel("samples per randomisation N")
        axes.tick_params(labelbottom=True)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error of A")
    figure.suptitle(style.wrapped(_title(report), 55 * columns), fontsize=10)
    style.explain(figure, *panels.flat)
    return figure


def _title(report: Report) -> str:
    result, theta = report.results[0], report.settings["theta_o_deg"]
    case = f"{result.model}({style.assigned(result.params)})"
    return f"slopes of convergence: {case} at {theta:g}°, {style.verdict(report)}"


def _panel(axes: Axes, findings: list[Finding], sampler: str) -> None:
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    for finding in findings:
        _curve(axes, finding)
    _guides(axes, findings)
    floor = max(f.reference["error"] for f in findings if f.reference)
    axes.axhline(floor, color=style.GREY, linewidth=0.8, linestyle=style.DASHES,
                 label="reference's error")  # fmt: skip
    slopes = ", ".join(f"{f.where['points']} {_said(f)}" for f in findings)
    axes.set_title(style.wrapped(f"{sampler.replace('_', '-')}: {slopes}", 58), fontsize=8)
    style.grid(axes)
    low, high = axes.get_ylim()  # panels share it
    axes.set_ylim(min(low, 0.3 * floor), high)


def _curve(axes: Axes, finding: Finding) -> None:
    points, levels = finding.where["points"], finding.estimators
    colour, marker = style.POINTS[points]
    for level in levels:
        each = [max(e, SMALLEST) for e in level["randomisations"]]
        axes.plot([level["samples"]] * len(each), each, ".", color=colour, alpha=0.12, markersize=3)
    axes.plot([v["samples"] for v in levels], [max(v["value"], SMALLEST) for v in levels],
              color=colour, marker=marker, markersize=4, linewidth=1.2, label=points)  # fmt: skip


def _said(finding: Finding) -> str:
    """The slope of a point set, or why there is none."""
    if math.isfinite(finding.value):
        return f"{finding.value:.2f}"
    errors = [v["value"] for v in finding.estimators if v["value"] is not None]
    if not errors or any(math.isnan(e) for e in errors):
        return "NaN (not drawn)"
    return "exact" if max(errors) < EXACT else "(too few for a slope)"


def _guides(axes: Axes, findings: list[Finding]) -> None:
    """Thin lines of known slope from the first error of the panel, each with its name."""
    samples = sorted({v["samples"] for f in findings for v in f.estimators})
    first = max(f.estimators[0]["value"] for f in findings)
    for slope in GUIDES:
        errors = [3.0 * first * (n / samples[0]) ** slope for n in (samples[0], samples[-1])]
        axes.plot([samples[0], samples[-1]], errors, color="0.6", linewidth=0.7, zorder=0)
        axes.annotate(f"$N^{{{slope:g}}}$", (samples[-1], errors[1]), fontsize=8, color="0.3",
                      ha="right", va="bottom")  # fmt: skip
