"""What all pictures share: colours, markers, and how a number is put on a log axis."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.judge.finding import Finding

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours: told apart by everyone
BLUE, VERMILION, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, BLACK = "#E69F00", "#56B4E9", "#000000"
GREY = "0.4"

COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
#: a colour and a marker per parameter set
SERIES = tuple(zip(COLOURS, "os^DvPX", strict=True))
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


def say_what_is_not_finite(axes: Axes, values: Sequence[float]) -> None:
    """What is NaN or infinite has no place in a picture: say so in it."""
    bad = sum(not math.isfinite(v) for v in values)
    if bad:
        words = "all values are" if bad == len(values) else f"{bad} of {len(values)} values are"
        axes.text(0.02, 0.96, f"{words} NaN or infinite: not drawn", transform=axes.transAxes,
                  va="top", color=VERMILION, fontsize=9)  # fmt: skip


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
