"""A table in words: how well its cells are known, what is lost between them, how far others are
off."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from montecarlo_brdf.judge.finding import Bound, Finding, Report, Result, Verdict
from montecarlo_brdf.report.columns import Column, painted, table
from montecarlo_brdf.report.text import called, place, style

COLUMNS = (
    Column("quantity", words=True), Column("value", right=True),
    Column("allowed", fold=2, right=True), Column("where", fold=1, words=True),
    Column("", fold=3, words=True),
    Column("verdict", style=style),
)  # fmt: skip
UNSAID = "measured, not judged; "


def render(report: Report, width: int = 80, colour: bool = False) -> str:
    """What stdout gets."""
    lines = list(_head(report, width))
    for result in report.results:
        lines += ["", *textwrap.wrap(_title(report, result), width)]
        lines += table(COLUMNS, [_row(f) for f in result.findings], width, colour)
    notes = [f.note for r in report.results for f in r.findings if f.note and not _quiet(f)]
    for note in dict.fromkeys(notes):
        lines += textwrap.wrap(f"note  {note}", width, initial_indent="  ", subsequent_indent="  ")
    hints = [f.hint for r in report.results for f in r.findings if f.hint]
    for hint in dict.fromkeys(hints):
        lines += textwrap.wrap(f"hint  {hint}", width, initial_indent="  ", subsequent_indent="  ")
    return "\n".join([*lines, "", summary(report, colour)])


def _head(report: Report, width: int) -> Iterator[str]:
    first, settings = report.results[0], report.settings
    axes = settings["axes"]
    size = " x ".join(str(axis["size"]) for axis in axes)
    params = {**first.params, **settings["formulas"]}
    words = f"{called(first.model, params)}  table of {', '.join(settings['quantities'])}, {size}"
    yield from textwrap.wrap(words, width)
    for axis in axes:
        yield f"  {axis['told']}  ({axis['placement']})"
    yield from textwrap.wrap(
        f"all values at once are within their errors with {settings['confidence']:.6g} confidence",
        width, initial_indent="  ", subsequent_indent="  ",
    )  # fmt: skip


def _title(report: Report, result: Result) -> str:
    """What a part of the report is of."""
    settings = report.settings
    if result.check != "interpolation":
        return result.check
    worse = f"{100.0 * settings['unseen']:.2g} % of the range"
    outside = f"; {settings['left_out']} others lie outside the model's domain"
    return (
        f"interpolation at {settings['fresh']} fresh places: with {settings['confidence']:.6g} "
        f"confidence at most {worse} is worse{outside if settings['left_out'] else ''}"
    )


def _row(f: Finding) -> tuple[str, ...]:
    value = f"{f.value:.1e}" if abs(f.value) < 0.1 else f"{f.value:.6g}"
    allowed = f"<= {f.expected:.1e}" if f.bound == Bound.AT_MOST else _tolerance(f)
    said = (f.note or "").removeprefix(UNSAID) if _quiet(f) else ""
    verdict = "" if f.verdict == Verdict.SKIPPED else _word(f.verdict)
    return f.quantity, value, allowed, place(f), said, verdict


def _tolerance(f: Finding) -> str:
    """What a deviation may be; of numbers that are told there is none."""
    return f"+- {f.tolerance:.1e}" if f.expected == 0.0 and f.tolerance else ""


def _quiet(f: Finding) -> bool:
    """Whether its note fits its row."""
    return len(f.note or "") < 60


def _word(verdict: Verdict) -> str:
    return verdict.upper() if verdict in (Verdict.FAIL, Verdict.ERROR) else str(verdict)


def summary(report: Report, colour: bool = False) -> str:
    """The verdict, and on what it rests."""
    found = [f.verdict for r in report.results for f in r.findings]
    counts = [f"{n} {v}" for v in (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE)
              if (n := found.count(v))]  # fmt: skip
    measured = found.count(Verdict.SKIPPED)
    counts += [f"{measured} measured"] if measured else []
    verdict = painted(report.verdict.upper(), style(report.verdict), colour)
    return f"{verdict}  {', '.join(counts)}; seed {report.settings['seed']}"
