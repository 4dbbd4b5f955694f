"""CSV: one row per finding, for spreadsheets and data frames."""
from __future__ import annotations

import csv
import io
import math
from typing import Any

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.text import shown

NUMBERS = ("value", "stderr", "expected", "tolerance", "resolves", "samples")
WORDS = ("estimator", "note", "hint", "reproduce")
COLUMNS = ("model", "params", "check", "quantity", "where", "verdict", "bound", *NUMBERS, *WORDS)


def render(report: Report) -> str:
    """A header and one line per finding."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    rows.writerows(_row(result, f) for result in report.results for f in result.findings)
    return text.getvalue()


def _row(result: Result, finding: Finding) -> list[Any]:
    subject = (result.model, _pairs(result.params), result.check, finding.quantity)
    numbers = (_number(getattr(finding, name)) for name in NUMBERS)
    words = (getattr(finding, name) or "" for name in WORDS)
    return [*subject, _pairs(finding.where), finding.verdict, finding.bound, *numbers, *words]


def _pairs(values: dict[str, Any]) -> str:
    return " ".join(f"{name}={shown(value)}" for name, value in values.items())


def _number(value: float | None) -> str:
    """All digits; nothing where there is no number."""
    return "" if value is None or not math.isfinite(value) else repr(value)
