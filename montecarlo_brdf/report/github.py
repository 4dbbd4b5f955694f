"""GitHub Actions: workflow commands that annotate the line of the user's f.

The same run writes the Markdown report into $GITHUB_STEP_SUMMARY where that is set.
"""
from __future__ import annotations

from montecarlo_brdf.judge.finding import Finding, Report, Result, Verdict
from montecarlo_brdf.report.text import case, explanation, statement, tally

#: what is annotated, and how
LEVELS = {Verdict.ERROR: "error", Verdict.FAIL: "error"}
LEVELS |= {Verdict.INCONCLUSIVE: "warning", Verdict.KNOWN: "notice"}


def render(report: Report) -> str:
    """One command per finding that needs attention, and a last line with the verdict."""
    lines = [_command(r, f) for r in report.results for f in r.findings if f.verdict in LEVELS]
    counts = tally(f for r in report.results for f in r.findings)
    return "\n".join([*lines, f"brdf-check {report.command}: {report.verdict}; {counts}"]) + "\n"


def _command(result: Result, finding: Finding) -> str:
    title = f"{case(result)} {result.check}: {finding.verdict}".strip()
    where = {**result.source, "title": title}
    properties = ",".join(f"{name}={_property(str(value))}" for name, value in where.items())
    message = "\n".join([statement(finding), *explanation(finding)])
    return f"::{LEVELS[finding.verdict]} {properties}::{_data(message)}"


def _data(text: str) -> str:
    """As the runner decodes a message."""
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    """As the runner decodes a property."""
    return _data(text).replace(":", "%3A").replace(",", "%2C")
