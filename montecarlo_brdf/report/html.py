"""HTML: one file without a network, for somebody who has no terminal: verdict first, then a table
for each model or check, pictures, the accused source, and the commands that repeat it."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.judge.finding import SEVERITY, Command, Report, Result, Verdict, worst
from montecarlo_brdf.report import densities, listing, pictures, refuted, sketches, text
from montecarlo_brdf.report.columns import NO_BREAK, Column
from montecarlo_brdf.report.pictures import inline

if TYPE_CHECKING:
    from jinja2 import Template

    from montecarlo_brdf.judge.diagnosis import Diagnosis

TEMPLATES = Path(__file__).parent / "templates"
#: commands with pictures of their own for each part
CURVES = (Command.CONVERGE, Command.FURNACE, Command.RADIANCE, Command.STRESS)
MOST_NAMED = 4  # models in the title
MOST_ROWS = 200  # of a table: the worst of more
MOST_DRAWN_FINDINGS = 400  # of a picture
MOST_DRAWN = 40  # pictures of a page


def render(report: Report) -> str:
    """The page of one report."""
    return page([report])


def page(reports: Sequence[Report]) -> str:
    """One page of several reports."""
    drawn = iter(range(MOST_DRAWN))
    chapters = [_chapter(report, k, drawn) for k, report in enumerate(reports)]
    verdict = _whole(worst(r.verdict for r in reports))
    models = dict.fromkeys(r.model for report in reports for r in report.results if r.model)
    commands = dict.fromkeys(report.command for report in reports)
    named = ", ".join(models) if len(models) <= MOST_NAMED else f"{len(models)} models"
    title = ": ".join(filter(None, (", ".join(commands), named if models else "")))
    return filled(title, verdict, chapters)


def filled(title: str, verdict: str, chapters: Sequence[Chapter]) -> str:
    """The page of some chapters; without a verdict of what judges nothing."""
    many = len(chapters) > 1
    return _template().render(title=title, verdict=verdict, chapters=chapters, many=many)


@functools.cache
def _template() -> Template:
    import jinja2

    loader = jinja2.FileSystemLoader(TEMPLATES)
    made = jinja2.Environment(
        loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )  # fmt: skip
    return made.get_template("page.html")


def _whole(verdict: Verdict) -> Verdict:
    return Verdict.PASS if verdict in (Verdict.KNOWN, Verdict.SKIPPED) else verdict


class Chapter(NamedTuple):
    """One report."""

    command: str
    verdict: str
    tally: str
    summary: str
    parts: list[Part]
    facts: list[tuple[str, str]]
    repeat: str  # the command line that made the report, if it is known


class Part(NamedTuple):
    """A table of a report with what belongs to it."""

    anchor: str
    title: str
    verdict: str
    table: Table
    hints: Sequence[str] = ()
    notes: Sequence[str] = ()
    commands: Sequence[str] = ()
    details: Sequence[tuple[str, Table]] = ()
    margins: sketches.Margins | None = None
    dials: Sequence[sketches.Dial] = ()
    draws: densities.Draws | None = None
    picture: str = ""
    caption: str = ""
    source: listing.Source | None = None
    lead: Lead | None = None


class Lead(NamedTuple):
    """The cause of a refuted model, or the place to look at."""

    label: str
    sentence: str
    tested: str
    command: str


class Table(NamedTuple):
    """Names of columns, rows of cells with the verdict of each, and how many rows are left out."""

    caption: str
    columns: list[Column]
    rows: list[tuple[str, list[str]]]
    left_out: int


def _chapter(report: Report, k: int, drawn: Iterator[int]) -> Chapter:
    findings = [f for r in report.results for f in r.findings]
    parts = [
        _part(report, section, f"part-{k}-{i}", drawn)
        for i, section in enumerate(text.sections(report))
    ]
    return Chapter(
        report.command, report.verdict, text.tally(findings) or "nothing was asked",
        text.summary(report), parts, _facts(report), str(report.measured.get("repeat", "")),
    )  # fmt: skip


def _part(report: Report, section: text.Section, anchor: str, drawn: Iterator[int]) -> Part:
    results = section.results
    said = list(dict.fromkeys(section.sentences))
    told = {kind: [s.text for s in said if s.kind is kind] for kind in text.Kind}
    verdict = worst(r.verdict for r in results)
    svg, caption = _picture(report, results, drawn)
    return Part(
        anchor, section.title, verdict, _table(section.title, section),
        [] if section.diagnosis and section.diagnosis.cause else told[text.Kind.HINT],
        told[text.Kind.NOTE] + told[text.Kind.OTHER], told[text.Kind.REPRODUCE],
        _details(report, results), sketches.margins_of(results), sketches.dials(results),
        densities.draws(results), svg, caption,
        listing.source(results, report.measured.get("sources", {})), _lead(section.diagnosis),
    )  # fmt: skip


def _lead(found: Diagnosis | None) -> Lead | None:
    if found is None:
        return None
    tested = found.cause.tested if found.cause else ""
    return Lead(refuted.label(found), refuted.sentence(found), tested, found.place.reproduce)


def _table(caption: str, section: text.Section) -> Table:
    """The worst rows in their order; a column without content is left out, and the verdict, which
    stands last, comes second."""
    columns, rows = section.columns, section.rows
    last = len(columns) - 1
    used = [k for k in (0, last, *range(1, last)) if any(row[k] for row in rows)]
    severity = {str(v): k for k, v in enumerate(SEVERITY)}
    known = [row[-1].lower() for row in rows]
    order = sorted(range(len(rows)), key=lambda k: severity.get(known[k], len(severity)))
    kept = sorted(order[:MOST_ROWS])
    plain = [(known[k], [rows[k][c].replace(NO_BREAK, " ") for c in used]) for k in kept]
    named = [columns[k]._replace(name=columns[k].name.replace(NO_BREAK, " ")) for k in used]
    return Table(caption, named, plain, len(rows) - len(kept))


def _details(report: Report, results: Sequence[Result]) -> list[tuple[str, Table]]:
    """All findings of each check, where the table above has one row a check."""
    if report.command is not Command.RUN:
        return []
    found = []
    for result in results:
        single = Report(Command.CHECK, report.settings, [result])
        for section in text.sections(single):
            found.append((result.check, _table(f"{result.check} in full", section)))
    return found


def _picture(
    report: Report, results: Sequence[Result], drawn: Iterator[int]
) -> tuple[str, str]:
    """An inline SVG and what it shows; nothing where nothing can be drawn."""
    for command, some, caption in _drawable(report, results):
        if next(drawn, None) is None:
            return "", ""
        one = Report(command, report.settings, list(map(_thinned, some)), _measured(report, some))
        try:
            return inline.svg(pictures.drawn(one, "svg")), caption
        except pictures.CannotDraw:
            continue
    return "", ""


def _measured(report: Report, some: Sequence[Result]) -> dict[str, Any]:
    """What was measured of some results: stress keeps a list beside them."""
    rows = report.measured.get("precisions")
    if not isinstance(rows, list) or len(rows) != len(report.results):
        return report.measured
    pairs = zip(report.results, rows, strict=True)
    return {"precisions": [row for result, row in pairs if any(result is s for s in some)]}


def _thinned(result: Result) -> Result:
    """With findings that a picture has room for: the bad ones first, then every so many."""
    if len(result.findings) <= MOST_DRAWN_FINDINGS:
        return result
    step = 2 * len(result.findings) // MOST_DRAWN_FINDINGS
    bad = [k for k, f in enumerate(result.findings) if f.verdict in text.BAD]
    kept = {*bad[: MOST_DRAWN_FINDINGS // 2], *range(0, len(result.findings), step)}
    return replace(result, findings=[result.findings[k] for k in sorted(kept)])


def _drawable(
    report: Report, results: Sequence[Result]
) -> Iterator[tuple[Command, list[Result], str]]:
    if report.command is Command.RUN:
        some = [r for r in results if r.check == "furnace"]
        if any(math.isfinite(f.value) for r in some for f in r.findings if f.quantity == "A"):
            yield Command.FURNACE, some, "Albedo against the viewer's angle, and its error"
    elif report.command in CURVES:
        yield report.command, list(results), f"The picture of {report.command}"


def _facts(report: Report) -> list[tuple[str, str]]:
    """Settings and versions, one a line."""
    settings = {k: v for k, v in report.settings.items() if k != "plan"}
    versions = report.to_dict()["versions"] if report.versions is None else report.versions
    seconds = report.measured.get("seconds")
    took = {"seconds": f"{seconds:.3g}"} if isinstance(seconds, (int, float)) else {}
    return facts({**settings, **versions, **took})


def facts(rows: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Names and values as people read them."""
    return [(str(k).replace("_", " "), _said(v)) for k, v in rows.items()]


def _said(value: Any) -> str:
    if isinstance(value, Mapping):
        return ", ".join(f"{k}: {_said(v)}" for k, v in value.items()) or "-"
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_said, value)) or "-"
    return "-" if value is None else text.shown(value)
