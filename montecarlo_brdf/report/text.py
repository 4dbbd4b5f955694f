"""A report in words, as people read it on a terminal: a table, then what needs attention; and the
sentences that all formats share: a finding's place, its bound, its value."""

from __future__ import annotations

import itertools
import math
import re
import textwrap
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.judge.finding import (
    SEVERITY,
    Bound,
    Command,
    Finding,
    Report,
    Result,
    Verdict,
    worst,
)
from montecarlo_brdf.report.columns import NO_BREAK, Column, Row, Style, painted, table

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis

SYMBOLS = {f"{a}_{d}_deg": f"{a}_{d}" for a in ("theta", "phi") for d in "oi"}
SIGNS = {Bound.AT_MOST: "<= ", Bound.AT_LEAST: ">= ", Bound.EQUAL: ""}
#: what needs somebody's attention
BAD = (Verdict.ERROR, Verdict.FAIL, Verdict.INCONCLUSIVE)
#: as a summary counts them
ORDER = (Verdict.PASS, Verdict.FAIL, Verdict.ERROR,
         Verdict.INCONCLUSIVE, Verdict.KNOWN, Verdict.SKIPPED)  # fmt: skip


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


#: checks that are about another function than f
ABOUT = {"pdf": "pdf", "sampling": "sample"}


def line_of(result: Result) -> int:
    """The line of the function that a check of a user's file is about."""
    lines = result.source.get("functions", {})
    return int(lines.get(ABOUT.get(result.check, "f"), result.source["line"]))


def origin(result: Result) -> list[str]:
    """'f: my_brdf.py:12', where it is known."""
    return [f"f: {result.source['file']}:{result.source['line']}"] if result.source else []


def failures(report: Report, verdicts: set[Verdict], reproducible: bool) -> list[str]:
    """The findings with some verdicts in full: what was found, the cause, the command."""
    lines = []
    for result in report.results:
        for f in (f for f in result.findings if f.verdict in verdicts):
            lines.append(f"{f.verdict} {result.check}: {statement(f)}")
            rest = explanation(f if reproducible else replace(f, reproduce=None))
            lines += [f"    {line}" for line in [*rest, *origin(result)]]
    return lines


STYLES = {
    Verdict.PASS: Style.GREEN, Verdict.FAIL: Style.LOUD, Verdict.ERROR: Style.LOUD,
    Verdict.INCONCLUSIVE: Style.YELLOW, Verdict.KNOWN: Style.CYAN, Verdict.SKIPPED: Style.DIM,
}  # fmt: skip
PLAIN_WIDTH = 118  # where there is no terminal


def style(verdict: str) -> Style:
    """The colour of a verdict, however it is written."""
    return STYLES[Verdict(verdict.lower())] if verdict else Style.NONE


VERDICT = Column("verdict", style=style)
ESTIMATE = Column("estimate")
#: of one finding, after the columns of its place
FINDING = (
    *(Column("quantity", fold=1), ESTIMATE, Column("expected", fold=3)),
    *(Column("tolerance", fold=4), Column("resolves", fold=5), Column("by", fold=6), VERDICT),
)
#: of one check
CHECK = (
    *(Column("check"), Column("claims", fold=2), Column("worst", fold=1, words=True), ESTIMATE),
    *(Column("bound", fold=3), Column("where", fold=4, words=True), VERDICT),
)
#: of one precision: name -> fold
NUMBERS = {
    "precision": 0, "points": 8, "worst error": 0, "ulps": 2, "allowed": 1,
    "with rounded inputs": 7, "NaN": 3, "Inf": 4, f"<{NO_BREAK}0": 5, "flushed": 6,
    "safe from": 10, "|sample| - 1": 9,
}  # fmt: skip
PRECISION = (*(Column(name, fold, right=True) for name, fold in NUMBERS.items()), VERDICT)


class Kind(StrEnum):
    """What a sentence below a table is."""

    HINT = "hint"
    NOTE = "note"
    REPRODUCE = "repro"
    OTHER = ""


class Sentence(NamedTuple):
    """What is to say about a table."""

    kind: Kind
    text: str

    def __str__(self) -> str:
        return f"  {self.kind:5} {self.text}" if self.kind else f"  {self.text}"


class Section(NamedTuple):
    """A table with its title, the sentences below it, and the results that it is made of."""

    title: str
    columns: Sequence[Column]
    rows: list[Row]
    sentences: Iterable[Sentence]
    results: Sequence[Result]
    diagnosis: Diagnosis | None = None  # of a model that was refuted


def render(
    report: Report, verbose: bool = False, width: int = PLAIN_WIDTH, colour: bool = False
) -> str:
    """A report as text. Tables keep to the width; a sentence is one line, however long."""
    from montecarlo_brdf.report import refuted

    lines = []
    for found in report.diagnosis if verbose else ():
        lines += _loudly(refuted.head(found, width), colour)
    for section in sections(report, verbose):
        if section.diagnosis:
            lines += _loudly(refuted.head(section.diagnosis, width), colour)
            lines += table(refuted.COLUMNS, refuted.rows(section.results), width, colour)
            hints = [] if section.diagnosis.cause else _hints(section.results)
            lines += map(str, hints)
            lines += indented("; ".join(refuted.rest(section.results)), width)
            continue
        lines.append(painted(section.title, Style.BOLD, colour))
        lines += table(section.columns, section.rows, width, colour)
        lines += dict.fromkeys(map(str, section.sentences))
    return "\n".join([*lines, summary(report, colour, width)]) + "\n"


def indented(sentence: str, width: int) -> list[str]:
    """A sentence below a title, in as many lines as it takes."""
    return textwrap.wrap(sentence, width, initial_indent="  ", subsequent_indent="  ",
                         break_long_words=False, break_on_hyphens=False)  # fmt: skip


def _loudly(lines: Sequence[str], colour: bool) -> list[str]:
    return [painted(lines[0], Style.LOUD, colour), *lines[1:]]


def _hints(group: Sequence[Result]) -> Iterator[Sentence]:
    """The hint of the worst finding of each check that failed, each once."""
    failed = [r for r in group if r.verdict == Verdict.FAIL]
    worst_of = [(r, most_telling(r)) for r in failed]
    told = [_Remark(Kind.HINT, f.hint, r.check, place(f)) for r, f in worst_of if f.hint]
    return map(_told, _alike(told).values())


def sections(report: Report, verbose: bool = False) -> Iterator[Section]:
    """A table for each model or check."""
    if report.command is Command.STRESS:
        for result, precisions in zip(report.results, report.measured["precisions"], strict=True):
            rows = [_precision(result, measured) for measured in precisions]
            yield Section(title(result), PRECISION, rows, _broken(result), [result])
    elif report.command is Command.RUN and not verbose:
        for group in grouped(report.results):
            rows = [_check(result) for result in group if result.findings]
            found = diagnosed(report, group[0])
            yield Section(case(group[0]), CHECK, rows, _of_checks(group), group, found)
    else:
        for result in report.results:
            places = list(dict.fromkeys(k for f in result.findings for k in f.where))
            columns = [Column(SYMBOLS.get(k, k), fold=2, right=True) for k in places]
            rows = [_finding(f, places) for f in result.findings]
            told = _attention(result, verbose)
            yield Section(title(result), [*columns, *FINDING], rows, told, [result])


def diagnosed(report: Report, result: Result) -> Diagnosis | None:
    """The diagnosis of the model and parameters that a result is of."""
    same = (d for d in report.diagnosis if d.model == result.model)
    return next((d for d in same if repr(d.params) == repr(result.params)), None)


def title(result: Result) -> str:
    """'lambert(albedo=0.8)  furnace'."""
    return f"{case(result)}  {result.check}" if result.model else result.check


def grouped(results: list[Result]) -> list[list[Result]]:
    """Consecutive results of the same model and parameters."""
    key = lambda r: (r.model, repr(r.params))  # noqa: E731
    return [list(group) for _, group in itertools.groupby(results, key)]


def most_telling(result: Result) -> Finding:
    """The worst finding of a check, or the one that came nearest to its tolerance."""
    return min(result.findings, key=lambda f: (SEVERITY.index(Verdict(f.verdict)), -excess(f)))


def excess(f: Finding) -> float:
    """How near a finding came to its tolerance."""
    if f.expected is None or not f.tolerance or not math.isfinite(f.value):
        return 0.0
    over = f.value - f.expected
    return abs(over) / f.tolerance if f.bound == Bound.EQUAL else over


def loud(verdict: str) -> str:
    """A verdict, in capitals if it is bad."""
    return verdict.upper() if verdict in (Verdict.FAIL, Verdict.ERROR) else verdict


def _check(result: Result) -> Row:
    """How many claims a check has, and its worst finding; where nothing happened is no place."""
    f = most_telling(result)
    known = f.expected is not None and math.isfinite(f.value)
    nothing = f.verdict == Verdict.PASS and f.as_wished
    return (
        result.check, str(sum(g.verdict != Verdict.SKIPPED for g in result.findings)),
        f.quantity if known else "", f.number if known else "", bound(f) if known else "",
        "" if nothing else place(f, NO_BREAK), loud(f.verdict),
    )  # fmt: skip


def _finding(f: Finding, places: list[str]) -> Row:
    sign = "<= " if f.bound == Bound.AT_MOST else ""
    return (
        *(coordinate(k, f.where.get(k)) for k in places), f.quantity,
        f.number,
        "" if f.expected is None else f"{sign}{f.expected:.8g}",
        "" if f.tolerance is None else f"{f.tolerance:.1e}",
        "" if f.resolves is None else resolved(f.resolves), f.estimator or "",
        f.verdict if f.verdict == Verdict.PASS else f.verdict.upper(),
    )  # fmt: skip


def resolved(deviation: float) -> str:
    """The deviation that would have been refuted, if there is one."""
    return "nothing" if math.isinf(deviation) else f"{deviation:.1e}"


def _attention(result: Result, verbose: bool) -> Iterator[Sentence]:
    """Estimators, hints, reasons, reproduction commands."""
    for f in result.findings:
        for row in f.estimators if verbose else ():
            number = replace(f, value=row["value"], stderr=row["stderr"]).number
            at = f"{place(f) or 'it'} {f.quantity}: {row['estimator']}"
            yield Sentence(Kind.OTHER, f"{at} {number} {row['verdict']}")
        for kind, sentence in ((Kind.NOTE, f.note), (Kind.HINT, f.hint)):
            if sentence:
                yield Sentence(kind, sentence)
        if f.reproduce:
            yield Sentence(Kind.REPRODUCE, f.reproduce)
    for name, reason, where in _not_used(result):
        yield Sentence(Kind.OTHER, f"{name} sampling not used at {where}: {reason}")


class _Remark(NamedTuple):
    """A sentence, and which findings of which check it is about."""

    kind: Kind  # a hint or a note
    sentence: str
    check: str
    place: str


def _of_checks(group: Sequence[Result]) -> Iterator[Sentence]:
    """What is to say about the checks of one model: a sentence that several findings share once,
    with whom it is about; for each check that failed one command that repeats it."""
    remarks = [one for result in group for one in _remarks(result)]
    for kind in (Kind.HINT, Kind.NOTE):
        told = [r for r in remarks if r.kind == kind]
        yield from map(_told, _alike(told).values())
    failed = {r.check: f.reproduce for r in group for f in reversed(r.findings) if f.reproduce}
    yield from (Sentence(Kind.REPRODUCE, command) for command in failed.values())


def _remarks(result: Result) -> Iterator[_Remark]:
    for f in result.findings:
        for kind, sentence in ((Kind.HINT, f.hint), (Kind.NOTE, f.note)):
            if sentence:
                yield _Remark(kind, sentence, result.check, place(f))
    for name, reason, where in _not_used(result):
        yield _Remark(Kind.NOTE, f"{name} sampling not used: {reason}", result.check, where)


#: numbers within a sentence: sentences that differ by them alone say the same
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def _alike(remarks: Sequence[_Remark]) -> dict[str, list[_Remark]]:
    """The remarks by what they say."""
    found: dict[str, list[_Remark]] = defaultdict(list)
    for one in remarks:
        found[NUMBER.sub("0", one.sentence)].append(one)
    return found


def _told(remarks: Sequence[_Remark]) -> Sentence:
    """'furnace, radiance: the factor 1/pi is missing (3 places)'."""
    checks = dict.fromkeys(r.check for r in remarks)
    places = [p for p in dict.fromkeys(r.place for r in remarks) if p]
    where = f" ({len(places)} places)" if len(places) > 1 else ""
    at = f" at {places[0]}" if len(places) == 1 and remarks[0].kind is Kind.HINT else ""
    text = f"{', '.join(checks)}{at}: {remarks[0].sentence}{where}"
    return Sentence(remarks[0].kind, text)


def _not_used(result: Result) -> list[tuple[str, str, str]]:
    """(estimator, first reason, all places) of estimators that were not believed."""
    found: dict[str, tuple[str, dict[str, None]]] = {}
    for f in result.findings:
        for row in f.estimators:
            if "not_used" in row and f.bound == Bound.EQUAL:
                _, places = found.setdefault(row["estimator"], (row["not_used"], {}))
                places[place(f) or "it"] = None
    return [(name, reason, ", ".join(places)) for name, (reason, places) in found.items()]


def _precision(result: Result, measured: Mapping[str, Any]) -> Row:
    """What one precision does to a model: `measured` is a row of `verify.stress`."""
    eps = measured["eps"]
    name, safe, length = (measured[k] for k in ("parameter", "safe", "length"))
    sharpest = "none" if safe is None or math.isnan(safe) else f"{safe:.3g}"
    verdicts = {f.verdict for f in result.findings if f.where["precision"] == measured["name"]}
    verdict = worst(verdicts - {Verdict.PASS} or verdicts)  # one that is known is told
    return (
        measured["name"], str(measured["points"]), f"{measured['worst']:.1e}",
        f"{measured['worst'] / eps:.2g}", f"{measured['allowed']:.0e}",
        f"{measured['with_inputs']:.1e}",
        *(str(measured[kind]) for kind in ("nan", "inf", "negative", "flushed")),
        f"{name} {sharpest}" if name else "", "" if length is None else f"{length / eps:.1f} eps",
        verdict if verdict == Verdict.PASS else verdict.upper(),
    )  # fmt: skip


def _broken(result: Result) -> Iterator[Sentence]:
    for f in result.findings:
        if f.verdict in (Verdict.FAIL, Verdict.KNOWN):
            value = f" {f.value:.2g}" if math.isfinite(f.value) or not f.note else ""
            text = f"{f.where['precision']}: {f.quantity}{value}: {f.note}"
            yield Sentence(Kind.OTHER, text)
            if f.reproduce:
                yield Sentence(Kind.REPRODUCE, f.reproduce)


def summary(report: Report, colour: bool = False, width: int | None = None) -> str:
    """The verdict, how it came about, and how often it would be wrong; by how many samples only
    where there is room for it, if a model was refuted."""
    findings = [f for r in report.results for f in r.findings]
    verdict = painted(report.verdict.upper(), style(worst(f.verdict for f in findings)), colour)
    if report.command is Command.STRESS:
        return verdict
    drawn = [f.samples for f in findings if f.samples and f.level is not None]
    samples = min(max(drawn, default=0), report.settings.get("samples", math.inf))
    points = f"{kind} points, " if (kind := report.settings.get("points")) else ""
    drawing = f"up to {samples} samples a claim, {points}" if samples else ""
    rate = f"chance of a false alarm <= {report.level:.1g}"
    if report.diagnosis and width is not None:
        return textwrap.fill(f"{verdict}  {tally(findings)}; {rate}", width, subsequent_indent="  ")
    return f"{verdict}  {tally(findings)}; {drawing}seed {report.settings.get('seed')}; {rate}"
