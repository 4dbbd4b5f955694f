"""A finding in words: its place, its bound, its value. What all formats share."""
from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from montecarlo_brdf.judge.finding import Bound, Finding, Report, Result, Verdict

SYMBOLS = {
    "theta_o_deg": "theta_o",
    "theta_i_deg": "theta_i",
    "phi_o_deg": "phi_o",
    "phi_i_deg": "phi_i",
    "channel": "ch",
}
SIGNS = {Bound.AT_MOST: "<= ", Bound.AT_LEAST: ">= ", Bound.EQUAL: ""}
#: what needs somebody's attention
BAD = (Verdict.ERROR, Verdict.FAIL, Verdict.INCONCLUSIVE)
#: as a summary counts them
ORDER = (
    *(Verdict.PASS, Verdict.FAIL, Verdict.ERROR),
    *(Verdict.INCONCLUSIVE, Verdict.KNOWN, Verdict.SKIPPED),
)


def case(result: Result) -> str:
    """'lambert(albedo=0.8)'; empty if the result is of no model."""
    return called(result.model, result.params) if result.model else ""


def called(model: str, params: Mapping[str, Any]) -> str:
    """A model with its parameters."""
    values = ", ".join(f"{k}={shown(v)}" for k, v in params.items())
    return f"{model}({values})" if values else model


def shown(value: Any) -> str:
    """A parameter as it would be typed: 0.5, or 1/0.7/0.3 for a colour."""
    if isinstance(value, (tuple, list)):
        return "/".join(shown(v) for v in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def coordinate(name: str, value: Any) -> str:
    """The value of one coordinate of a place."""
    if value is None:
        return ""
    if name.endswith("_deg"):
        return f"{value:g}°"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def place(finding: Finding, glue: str = " ") -> str:
    """'theta_o 45° ch 1'; empty if the finding is about everything. `glue` holds a name to its
    value."""
    return " ".join(
        f"{SYMBOLS.get(k, k)}{glue}{coordinate(k, v)}" for k, v in finding.where.items()
    )


def bound(finding: Finding) -> str:
    """'<= 1 +- 1.0e-05'."""
    if finding.expected is None:
        return ""
    tolerance = f" +- {finding.tolerance:.1e}" if finding.tolerance else ""
    return f"{SIGNS[Bound(finding.bound)]}{finding.expected:.8g}{tolerance}"


def statement(finding: Finding) -> str:
    """'A <= 1 at theta_o 45°: found 1.0500(3), allowed <= 1 +- 1.0e-05'."""
    at = f" at {place(finding)}" if finding.where else ""
    if finding.samples is None:  # never evaluated
        return f"{finding.quantity}{at}"
    allowed = f", allowed {bound(finding)}" if finding.expected is not None else ""
    return f"{finding.quantity}{at}: found {finding.number}{allowed}"


def explanation(finding: Finding) -> list[str]:
    """Note, hint and reproduction command, each on a line of its own."""
    rows = (("note", finding.note), ("hint", finding.hint), ("reproduce", finding.reproduce))
    return [f"{name}: {text}" for name, text in rows if text]


def tally(findings: Iterable[Finding]) -> str:
    """'33 pass, 1 skipped'."""
    counts = Counter(f.verdict for f in findings)
    return ", ".join(f"{counts[v]} {v}" for v in ORDER if counts[v])


def origin(result: Result) -> list[str]:
    """'f: my_brdf.py:12', where it is known."""
    return [f"f: {result.source['file']}:{result.source['line']}"] if result.source else []


def failures(report: Report, verdicts: Iterable[str] = BAD, reproducible: bool = True) -> list[str]:
    """The findings with some verdicts in full: what was found, the cause, the command."""
    lines = []
    wanted = set(verdicts)
    for result in report.results:
        for f in (f for f in result.findings if f.verdict in wanted):
            lines.append(f"{f.verdict} {result.check}: {statement(f)}")
            rest = explanation(f if reproducible else replace(f, reproduce=None))
            lines += [f"    {line}" for line in [*rest, *origin(result)]]
    return lines
