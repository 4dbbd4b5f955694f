"""GitHub Actions: workflow commands that annotate the lines of the user's functions.

GitHub shows ten of a kind in a step: there is one for each model and check, on the function that it
is about, and the worst come first.

The same run writes the Markdown report into $GITHUB_STEP_SUMMARY where that is set.
"""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.judge.finding import SEVERITY, Finding, Report, Result, Verdict
from montecarlo_brdf.report import refuted
from montecarlo_brdf.report.text import (
    case,
    diagnosed,
    explanation,
    line_of,
    most_telling,
    statement,
    tally,
)

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis

#: what is annotated, and how
LEVELS = {Verdict.ERROR: "error", Verdict.FAIL: "error"}
LEVELS |= {Verdict.INCONCLUSIVE: "warning", Verdict.KNOWN: "notice"}


def render(report: Report) -> str:
    """One command per check that needs attention, and a last line with the verdict."""
    told = [r for r in report.results if _of_note(r.findings)]
    told = sorted(told, key=lambda r: SEVERITY.index(r.verdict))
    lines = [_command(r, diagnosed(report, r)) for r in told]
    counts = tally(f for r in report.results for f in r.findings)
    return "\n".join([*lines, f"brdf-check {report.command}: {report.verdict}; {counts}"]) + "\n"


def _command(result: Result, found: Diagnosis | None) -> str:
    finding = most_telling(replace(result, findings=_of_note(result.findings)))
    title = f"{case(result)} {result.check}: {finding.verdict}".strip()
    where = {**_accused(result), "title": title}
    properties = ",".join(f"{name}={_property(str(value))}" for name, value in where.items())
    alike = sum(f.verdict == finding.verdict for f in result.findings) - 1
    more = [f"and {alike} more findings like it"] if alike else []
    cause = [blame] if (blame := refuted.blame(found, finding)) else []
    message = "\n".join([*cause, statement(finding), *more, *explanation(finding)])
    return f"::{LEVELS[finding.verdict]} {properties}::{_data(message)}"


def _of_note(findings: Sequence[Finding]) -> list[Finding]:
    """Those that need attention and do not follow from others."""
    return [f for f in findings if f.verdict in LEVELS and not f.follows]


def _accused(result: Result) -> dict[str, Any]:
    """File and line of the function that a check is about."""
    return {"file": result.source["file"], "line": line_of(result)} if result.source else {}


def _data(text: str) -> str:
    """As the runner decodes a message."""
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    """As the runner decodes a property."""
    return _data(text).replace(":", "%3A").replace(",", "%2C")
