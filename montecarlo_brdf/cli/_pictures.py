"""Pictures into files."""

from __future__ import annotations

from pathlib import Path

from montecarlo_brdf.files import write_bytes
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.report.pictures import drawn, kind_of

__all__ = ["kind_of", "plot"]


def plot(report: Report, path: Path) -> None:
    """Draw a report into a PNG, SVG or PDF file."""
    write_bytes(path, drawn(report, kind_of(path)))
