"""What all pictures share: colours, markers, and how a number is put on a log axis."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.judge.finding import Finding, Report, Verdict, worst

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours: told apart by everyone
BLUE, VERMILION, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, BLACK = "#E69F00", "#56B4E9", "#000000"
GREY = "0.4"

COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
MARKERS = "os^DvPX"
#: a colour and a marker per parameter set
SERIES = tuple(zip(COLOURS, MARKERS, strict=True))
#: one per point set
POINTS = {"independent": (BLACK, "o"), "stratified": (ORANGE, "s")}
POINTS |= {"sobol": (BLUE, "^"), "lattice": (VERMILION, "D")}
#: a colour per channel: red, green, blue, and others
CHANNELS = (VERMILION, GREEN, BLUE, PURPLE, ORANGE, SKY, BLACK)
DASHES = (0, (4, 3))
DOTS = (0, (1, 2))
SMALLEST = 1e-17  # an exact value has no place on a log axis
THETA_O = "angle of the viewer theta_o (degrees)"


def panels(width: float) -> tuple[Figure, Axes, Axes]:
    """Values above, their errors below, against the same angles."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, 6.0), layout="constrained")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    bottom.set_xlabel(THETA_O)
    return figure, top, bottom


def wrapped(text: str, width: int, most: int = 4) -> str:
    """Text on several lines; what needs more of them ends in dots."""
    return "\n".join(
        textwrap.wrap(text, width, max_lines=most, placeholder=" ...", break_on_hyphens=False)
    )


def joined(*parts: str) -> str:
    """Parts that say something, with commas."""
    return ", ".join(part for part in parts if part)


def verdict(report: Report) -> str:
    """'verdict fail'; of what the models' papers do not promise 'known'."""
    worst_found = worst(f.verdict for r in report.results for f in r.findings)
    if worst_found == Verdict.KNOWN:
        return "known: what was published promises no more"
    return f"verdict {report.verdict}"


def explain(figure: Figure, *panels: Axes) -> None:
    """One legend below the panels, where it hides nothing; every line style named once."""
    named: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            named.setdefault(wrapped(label, 48), handle)
    if named:
        longest = max(len(line) for label in named for line in label.split("\n"))
        columns = 3 if longest < 30 else 2
        figure.legend(
            [*named.values()], [*named], loc="outside lower center", ncols=columns, fontsize=8
        )


def say_what_is_not_finite(axes: Axes, values: Sequence[float], size: int = 9) -> None:
    """What is NaN or infinite has no place in a picture: say so in it."""
    bad = sum(not math.isfinite(v) for v in values)
    if bad:
        words = "all values are" if bad == len(values) else f"{bad} of {len(values)} values are"
        axes.text(0.02, 0.96, f"{words} NaN or infinite:\nnot drawn", transform=axes.transAxes,
                  va="top", color=VERMILION, fontsize=size)  # fmt: skip


def grid(*panels: Axes) -> None:
    """A faint grid."""
    for axes in panels:
        axes.grid(alpha=0.25)


def bar(finding: Finding) -> float:
    """Half the length of an error bar: 3 standard errors, where they are known."""
    return 0.0 if math.isnan(finding.stderr) else 3.0 * finding.stderr


def error(finding: Finding) -> float:
    """How far a value is from what is expected, for a log axis."""
    if finding.expected is None:
        return math.nan
    return max(abs(finding.value - finding.expected), SMALLEST)


def angles(findings: list[Finding]) -> list[float]:
    """theta_o in degrees."""
    return [f.where["theta_o_deg"] for f in findings]


def assigned(params: Mapping[str, Any]) -> str:
    """'alpha=0.3, k=direct'."""
    shown = {k: f"{v:.4g}" if isinstance(v, float) else v for k, v in params.items()}
    return ", ".join(f"{k}={v}" for k, v in shown.items())
