"""A report as people read it on a terminal: a table, then what needs attention."""
from __future__ import annotations

import itertools
import math
import sys
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from montecarlo_brdf.judge.finding import SEVERITY, Finding, Report, Result, worst
from montecarlo_brdf.report.sentences import SYMBOLS, bound, case, coordinate, place, tally
from montecarlo_brdf.statistics import with_error

COLOURS = {
    "pass": "green",
    "fail": "bold red",
    "error": "bold red",
    "inconclusive": "yellow",
    "known": "cyan",
    "skipped": "dim",
}
PLAIN_WIDTH = 118


def show(report: Report, verbose: bool = False) -> None:
    """Print a report on stdout."""
    width = None if sys.stdout.isatty() else PLAIN_WIDTH
    console = Console(width=width, highlight=False, soft_wrap=False)
    if report.command == "run" and not verbose:
        for group in grouped(report.results):
            console.print(Text(title(group[0]).rpartition("  ")[0], style="bold"))
            console.print(check_table(group))
            for result in group:
                _print_attention(console, result, verbose, f"{result.check}: ")
    else:
        for result in report.results:
            console.print(Text(title(result), style="bold"))
            console.print(table(result))
            _print_attention(console, result, verbose)
    console.print(summary(report), soft_wrap=True)


def grouped(results: list[Result]) -> list[list[Result]]:
    """Consecutive results of the same model and parameters."""
    key = lambda r: (r.model, repr(r.params))  # noqa: E731
    return [list(group) for _, group in itertools.groupby(results, key)]


def check_table(results: list[Result]) -> Table:
    """One row per check: how many claims, and the worst finding."""
    grid = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for name in ("check", "claims", "worst", "estimate", "bound", "where", "verdict"):
        grid.add_column(name, overflow="fold", no_wrap=name in ("check", "verdict"))
    for result in filter(lambda r: r.findings, results):
        f = most_telling(result)
        known = f.expected is not None and math.isfinite(f.value)
        grid.add_row(
            result.check,
            str(sum(g.verdict != "skipped" for g in result.findings)),
            f.quantity if known else "",
            with_error(f.value, f.stderr) if known else "",
            bound(f) if known else "",
            place(f),
            Text(loud(f.verdict), COLOURS[f.verdict]),
        )
    return grid


def most_telling(result: Result) -> Finding:
    """The worst finding of a check, or the one that came nearest to its tolerance."""
    return min(result.findings, key=lambda f: (SEVERITY.index(f.verdict), -_excess(f)))


def loud(verdict: str) -> str:
    """A verdict, in capitals if it is bad."""
    return verdict.upper() if verdict in ("fail", "error") else verdict


def _excess(f: Finding) -> float:
    """How near a finding came to its tolerance."""
    if f.expected is None or not f.tolerance or not math.isfinite(f.value):
        return 0.0
    return abs(f.value - f.expected) / f.tolerance if f.bound == "equal" else f.value - f.expected


def title(result: Result) -> str:
    """'lambert(albedo=0.8)  furnace'."""
    return f"{case(result)}  {result.check}" if result.model else result.check


def table(result: Result) -> Table:
    """One row per finding."""
    places = list(dict.fromkeys(k for f in result.findings for k in f.where))
    grid = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for name in places:
        grid.add_column(SYMBOLS.get(name, name), justify="right", no_wrap=True)
    for name in ("quantity", "estimate", "expected", "tolerance", "resolves", "by", "verdict"):
        grid.add_column(name, justify="left", no_wrap=name in ("estimate", "verdict"))
    for finding in result.findings:
        grid.add_row(*[coordinate(k, finding.where.get(k)) for k in places], *_cells(finding))
    return grid


def _cells(f: Finding) -> list[Any]:
    return [
        f.quantity,
        with_error(f.value, f.stderr),
        "" if f.expected is None else ("<= " if f.bound == "at most" else "") + f"{f.expected:.8g}",
        "" if f.tolerance is None else f"{f.tolerance:.1e}",
        "" if f.resolves is None else f"{f.resolves:.1e}",
        f.estimator or "",
        Text(f.verdict.upper() if f.verdict != "pass" else "pass", style=COLOURS[f.verdict]),
    ]


def _print_attention(console: Console, result: Result, verbose: bool, about: str = "") -> None:
    """Hints, reasons, reproduction commands; every distinct sentence once. `about` says whose they
    are where several checks share a table."""
    lines: dict[str, None] = {}
    for f in result.findings:
        if verbose:
            for row in f.estimators:
                value = with_error(float(row["value"]), float(row["stderr"]))
                at = f"{place(f) or 'it'} {f.quantity}: {row['estimator']}"
                lines[f"  {at} {value} {row['verdict']}"] = None
        for kind, sentence in (("note", f.note), ("hint", f.hint), ("repro", f.reproduce)):
            if sentence:
                lines[f"  {kind:5} {'' if kind == 'repro' else about}{sentence}"] = None
    for name, reason, where in _not_used(result):
        lines[f"  {about}{name} sampling not used at {where}: {reason}"] = None
    for line in lines:
        console.print(Text(line), soft_wrap=True)


def _not_used(result: Result) -> list[tuple[str, str, str]]:
    """(estimator, first reason, all places) of estimators that were not believed."""
    found: dict[str, tuple[str, dict[str, None]]] = {}
    for f in result.findings:
        for row in f.estimators:
            if "not_used" in row and f.bound == "equal":
                _, places = found.setdefault(row["estimator"], (row["not_used"], {}))
                places[place(f) or "it"] = None
    return [(name, reason, ", ".join(places)) for name, (reason, places) in found.items()]


def summary(report: Report) -> Text:
    """The verdict, how it came about, and how often it would be wrong."""
    findings = [f for r in report.results for f in r.findings]
    counts = tally(findings)
    samples = max((f.samples or 0 for f in findings), default=0)
    verdict = worst(f.verdict for f in findings) if findings else "skipped"
    points = f"{kind} points, " if (kind := report.settings.get("points")) else ""
    text = Text(f"{report.verdict.upper()}", style=COLOURS.get(verdict, ""))
    text.append(
        f"  {counts}; up to {samples} samples a claim, {points}"
        f"seed {report.settings.get('seed')}; chance of a false alarm <= {report.level:.1g}",
        style="not bold default",
    )
    return text
