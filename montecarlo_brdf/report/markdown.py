"""Markdown: a table per model with the worst finding of each check, then what needs attention."""
from __future__ import annotations

import html
from typing import TYPE_CHECKING

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report import refuted
from montecarlo_brdf.report.text import (
    BAD,
    bound,
    case,
    diagnosed,
    explanation,
    grouped,
    loud,
    most_telling,
    place,
    statement,
    tally,
)

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis

HEADER = ("check", "worst", "estimate", "bound", "where", "verdict")


def render(report: Report) -> str:
    """The verdict, one table per model, and the failures in full."""
    findings = [f for r in report.results for f in r.findings]
    parts = [f"## brdf-check {report.command}: {report.verdict.upper()}", tally(findings) or "-"]
    for group in grouped(report.results):
        heading = f"### {_cell(case(group[0]) or group[0].check)}"
        found = diagnosed(report, group[0])
        parts += [heading, *([_diagnosis(found)] if found else []), "\n".join(_table(group))]
        parts += [_attention(r, f) for r in group for f in r.findings
                  if f.verdict in BAD and not f.follows]
        if many := sum(bool(f.follows) for r in group for f in r.findings):
            parts.append(f"{many} more findings follow from the cause.")
    rate = f"chance of a false alarm <= {report.level:.1g}"
    parts.append(f"seed {report.settings.get('seed')}; {rate}")
    return "\n\n".join(parts) + "\n"


def _diagnosis(found: Diagnosis) -> str:
    """The cause or the place, how it was tested, and the command."""
    lines = [f"**{refuted.label(found)}:** {_cell(refuted.sentence(found))}"]
    lines += [f"({_cell(found.cause.tested)})"] if found.cause else []
    lines += [f"`{found.place.reproduce}`"] if found.place.reproduce else []
    return "  \n".join(lines)


def _table(group: list[Result]) -> list[str]:
    rows = [_row(r, most_telling(r)) for r in group if r.findings]
    return [f"| {' | '.join(row)} |" for row in (HEADER, ("---",) * len(HEADER), *rows)]


def _row(result: Result, f: Finding) -> tuple[str, ...]:
    value = f.number if f.samples is not None else ""
    cells = (result.check, f.quantity, value, bound(f), place(f), loud(f.verdict))
    return tuple(map(_cell, cells))


def _attention(result: Result, finding: Finding) -> str:
    head = f"- **{loud(finding.verdict)}** {result.check}: {_cell(statement(finding))}"
    rest = [f"  - {_explained(line)}" for line in explanation(finding)]
    return "\n".join([head, *rest])


def _explained(line: str) -> str:
    """A command as code, anything else as text."""
    name, _, text = line.partition(": ")
    return f"{name}: `{text}`" if name == "reproduce" else _cell(line)


def _cell(text: str) -> str:
    """Text that neither ends a cell nor is taken for markup."""
    return html.escape(text, quote=False).replace("|", "\\|").replace("*", "\\*").replace("\n", " ")
