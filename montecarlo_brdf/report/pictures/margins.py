"""How near every finding came to its tolerance: the picture of what has no curve to draw."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.judge.finding import SEVERITY, Bound, Finding, Report, Verdict
from montecarlo_brdf.report.pictures import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DECADES = 4  # each way from the tolerance
MOST_ROWS = 60
#: a colour and a marker per verdict
MARKS = {Verdict.PASS: (style.GREEN, "o"), Verdict.KNOWN: (style.BLUE, "s")}
MARKS |= {Verdict.INCONCLUSIVE: (style.ORANGE, "D")}
MARKS |= {Verdict.FAIL: (style.VERMILION, "X"), Verdict.ERROR: (style.VERMILION, "X")}


class Dot(NamedTuple):
    """A finding: its deviation in tolerances, as a power of ten between the ends."""

    power: float
    verdict: Verdict


def ratio(finding: Finding) -> float:
    """The deviation in tolerances, negative on the safe side of a bound; NaN where either is
    unknown."""
    if finding.expected is None or not finding.tolerance:
        return math.nan
    over = finding.value - finding.expected
    sign = {Bound.EQUAL: abs(over), Bound.AT_MOST: over, Bound.AT_LEAST: -over}
    return sign[Bound(finding.bound)] / finding.tolerance


def power(finding: Finding) -> float:
    """The same by the logarithm, between the ends; at the upper one what is not finite."""
    share = ratio(finding)
    if math.isnan(share):
        return float(DECADES)
    return min(max(math.log10(max(share, 1e-300)), -DECADES), DECADES)


def rows(report: Report) -> dict[str, list[Finding]]:
    """Findings with a tolerance, by model and check, or quantity where there is one check."""
    several = len({r.check for r in report.results}) > 1
    models = len({r.model for r in report.results}) > 1
    found: dict[str, list[Finding]] = {}
    for result in report.results:
        for f in result.findings:
            if f.tolerance and f.expected is not None:
                name = result.check if several else f.quantity
                key = style.joined(result.model if models else "", name)
                found.setdefault(key, []).append(f)
    return found


def figure(report: Report) -> Figure:
    """A row for each check, a mark for each finding."""
    from matplotlib.figure import Figure

    found = rows(report)
    if len(found) > MOST_ROWS:  # the worst models
        ordered = sorted(found, key=lambda k: min(SEVERITY.index(f.verdict) for f in found[k]))
        found = {k: found[k] for k in ordered[:MOST_ROWS]}
    figure = Figure(figsize=(8.5, 1.8 + 0.28 * len(found)), layout="constrained")
    axes = figure.subplots()
    for verdict, (colour, marker) in MARKS.items():
        dots = [(power(f), k) for k, fs in enumerate(found.values()) for f in fs
                if f.verdict == verdict]  # fmt: skip
        if dots:
            axes.plot(*zip(*dots, strict=True), marker, color=colour, markersize=5, alpha=0.8,
                      label=verdict.value, linestyle="none")  # fmt: skip
    axes.axvline(0.0, color=style.GREY, linewidth=0.9, linestyle=style.DASHES)
    axes.set_xlim(-DECADES - 0.3, DECADES + 0.3)
    ticks = range(-DECADES, DECADES + 1, 2)
    axes.set_xticks([*ticks], [f"$10^{{{k}}}$" if k else "1" for k in ticks])
    axes.set_yticks(range(len(found)), [style.wrapped(k, 40, 1) for k in found], fontsize=8)
    axes.set_ylim(len(found) - 0.4, -0.6)
    axes.set_xlabel("deviation in tolerances; what is beyond stands at the ends")
    axes.set_title(_title(report), fontsize=10)
    style.grid(axes)
    style.explain(figure, axes)
    return figure


def _title(report: Report) -> str:
    models = list(dict.fromkeys(r.model for r in report.results if r.model))
    named = ", ".join(models) if len(models) < 4 else f"{len(models)} models"
    return style.wrapped(f"{report.command} {named}".strip() + f", {style.verdict(report)}", 90)
