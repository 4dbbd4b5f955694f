"""What the ladder of precisions found, as a table."""

from __future__ import annotations

import math
import sys
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.report.text import COLOURS, PLAIN_WIDTH
from montecarlo_brdf.stability.stress import Loss


def show(report: Report, tables: list[tuple[Any, list[Loss]]]) -> None:
    """Print one table per model, side by side numbers for every precision, then what failed."""
    console = Console(width=None if sys.stdout.isatty() else PLAIN_WIDTH, highlight=False)
    for one, (model, outcomes) in zip(report.results, tables, strict=False):
        picks = ", ".join(f"{k}={v}" for k, v in model.picks.items())
        console.print(Text(f"{model.name}{f'({picks})' if picks else ''}  stability", style="bold"))
        console.print(_table(outcomes, one))
        lines = [line for f in one.findings for line in _lines(f)]
        for line in dict.fromkeys(lines):
            console.print(Text(line), soft_wrap=True)
    console.print(Text(report.verdict.upper(), style=COLOURS.get(report.verdict, "")))


def _lines(f: Finding) -> list[str]:
    if f.verdict not in ("fail", "known"):
        return []
    head = f"  {f.where['precision']}: {f.quantity} {f.value:.2g}"
    return [f"{head}: {f.note}", *([f"  repro {f.reproduce}"] if f.reproduce else [])]


COLUMNS = (
    ("precision", "points", "worst error", "ulps", "allowed", "with rounded inputs")
    + ("NaN", "Inf", "< 0", "flushed", "safe from", "|sample| - 1", "verdict")
)  # fmt: skip


def _table(outcomes: list[Loss], one: Result) -> Table:
    grid = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for name in COLUMNS:
        justify: Any = "left" if name == "verdict" else "right"
        grid.add_column(name, justify=justify, no_wrap=name == "safe from")
    for o in outcomes:
        grid.add_row(*_row(o), _verdict(one, o.precision))
    return grid


def _row(o: Loss) -> list[str]:
    total = o.worst_total.total if o.worst_total else 0.0
    safe = (
        ""
        if o.safe is None
        else f"{o.safe[0]} " + ("none" if math.isnan(o.safe[1]) else f"{o.safe[1]:.3g}")
    )
    kinds = [str(o.counts[k]) for k in ("nan", "inf", "negative", "flushed")]
    length = "" if o.draws is None else f"{o.draws.length / o.eps:.1f} eps"
    own = o.worst.own if o.worst else 0.0
    errors = [f"{own:.1e}", f"{own / o.eps:.2g}", f"{o.tolerance:.0e}", f"{total:.1e}"]
    return [o.precision, str(o.points), *errors, *kinds, safe, length]


def _verdict(one: Result, precision: str) -> Text:
    verdicts = [f.verdict for f in one.findings if f.where["precision"] == precision]
    verdict = next((v for v in ("fail", "known") if v in verdicts), "pass")
    return Text(verdict.upper() if verdict != "pass" else "pass", style=COLOURS[verdict])
