"""JSON: the whole report, with a versioned schema."""

from __future__ import annotations

from montecarlo_brdf.judge.finding import Report


def render(report: Report) -> str:
    """The report as JSON text."""
    return report.to_json()
