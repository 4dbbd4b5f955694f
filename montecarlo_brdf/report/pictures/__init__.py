"""Pictures of reports, which can be drawn again at any time; and pages of spheres."""

from __future__ import annotations

import importlib
import io
from pathlib import Path
from typing import TYPE_CHECKING

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Command, Report

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KINDS = ("png", "svg", "pdf")
#: command -> the module beside this one whose `figure(report)` draws its reports
FIGURES = {Command.CONVERGE: "convergence", Command.FURNACE: "albedo"}
FIGURES |= {Command.RADIANCE: "radiance", Command.STRESS: "stability", Command.TABLE: "table"}
FIGURES |= dict.fromkeys((Command.COMPARE, Command.IDENTITIES, Command.RUN), "margins")


class CannotDraw(UserError):
    """A report that there is no picture of."""


def kind_of(path: Path) -> str:
    """ "png", "svg" or "pdf", or a UserError."""
    kind = path.suffix.lstrip(".").lower()
    if kind not in KINDS:
        raise UserError(f"cannot draw {path}: the name must end in .png, .svg or .pdf")
    return kind


def drawn(report: Report, kind: str) -> bytes:
    """The picture of a report as a PNG, SVG or PDF file."""
    if report.command not in FIGURES:
        raise CannotDraw(f"there is no picture for a report of {report.command!r}")
    import matplotlib

    matplotlib.use("Agg")
    module = importlib.import_module(f"{__name__}.{FIGURES[report.command]}")
    try:
        figure = module.figure(report)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        raise CannotDraw(f"the report cannot be drawn: {type(error).__name__} {error}") from error
    return encoded(figure, kind)


def encoded(figure: Figure, kind: str) -> bytes:
    """A figure as a file: equal figures give equal files."""
    import matplotlib

    content = io.BytesIO()
    metadata = {"Date": None} if kind == "svg" else {}
    with matplotlib.rc_context({"svg.hashsalt": "montecarlo_brdf"}):  # instead of a random one
        figure.savefig(content, format=kind, dpi=150, metadata=metadata)
    return content.getvalue()
