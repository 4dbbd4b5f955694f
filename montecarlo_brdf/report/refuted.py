"""A refuted model in a few lines: what its author has to change or where to look, the command that
shows the worst of it, then one line a check; what follows from the cause is named, no more."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from montecarlo_brdf.judge.finding import Bound, Finding, Result, Verdict
from montecarlo_brdf.report import text
from montecarlo_brdf.report.columns import NO_BREAK, Column, Row

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis, Place

#: of one check that failed
COLUMNS = (
    *(Column("check"), Column("worst"), Column("found"), Column("allowed"), Column("where")),
    Column("more"),  # places
)
WIDEST = 22  # characters of a place: with the longest numbers all fits in 80
LONGEST = 20  # of a quantity


def sentence(found: Diagnosis) -> str:
    """The cause, or the worst place."""
    return found.cause.sentence if found.cause else placed(found.place)


def label(found: Diagnosis) -> str:
    """Which of the two it is."""
    return "cause" if found.cause else "place"


def placed(place: Place) -> str:
    """'energy: worst A <= 1 is 1.3 at theta_o 0° n 2000; no cause found; f is at line 12'."""
    at = f" at {text.place(place.finding)}" if place.finding.where else ""
    value = f" is {place.finding.number}" if place.finding.number else ""
    line = f"; {place.function}: line {place.line}" if place.line else ""
    return f"{place.check}: {place.finding.quantity}{value}{at}{line}; no cause found"


def head(found: Diagnosis, width: int) -> list[str]:
    """The verdict, the cause or the place, and the command, which stays whole to be copied."""
    title = f"{text.called(found.model, found.params)}  {Verdict.FAIL.upper()}"
    told = [title, *text.indented(f"{label(found)} {sentence(found)}", width)]
    return [*told, f"  again {found.place.reproduce}"] if found.place.reproduce else told


def blame(found: Diagnosis | None, finding: Finding) -> str:
    """What a finding has to do with the diagnosis, for formats that show findings one by one."""
    if found is None or found.cause is None or finding.verdict != Verdict.FAIL:
        return ""
    if finding.follows:
        return f"follows from what is wrong with {finding.follows}: {found.cause.sentence}"
    return f"cause: {found.cause.sentence}"


def rows(group: Sequence[Result]) -> list[Row]:
    """Checks with a failure that follows from nothing else."""
    return [_row(r.check, some) for r in group if (some := _own(r))]


def _own(result: Result) -> list[Finding]:
    return [f for f in result.findings if f.verdict == Verdict.FAIL and not f.follows]


def _row(check: str, some: Sequence[Finding]) -> Row:
    f = max(some, key=text.excess)
    more = len(some) - 1
    named = _cut(f.quantity, LONGEST)
    return check, named, f.number, _allowed(f), where(f), f"+ {more}" if more else ""


def _allowed(f: Finding) -> str:
    return "" if f.expected is None else f"{text.SIGNS[Bound(f.bound)]}{f.expected:.5g}"


def where(f: Finding) -> str:
    """The polar angles and, where there is room, parameters."""
    angles = [f"{f.where[k]:.3g}°" for k in ("theta_o_deg", "theta_i_deg") if k in f.where]
    found = ["/".join(angles)] if angles else []
    for k, v in f.where.items():
        if not k.endswith("_deg"):
            found.append(f"{k}{NO_BREAK}{v:.3g}" if isinstance(v, float) else f"{k}{NO_BREAK}{v}")
    return _cut(NO_BREAK.join(found), WIDEST)


def _cut(words: str, most: int) -> str:
    return words if len(words) <= most else f"{words[: most - 1].rstrip()}…"


def rest(group: Sequence[Result]) -> Iterator[str]:
    """The other checks: what follows, what is open, what held."""
    follow, others = [], dict[Verdict, list[str]]()
    for r in group:
        if _own(r):
            continue
        if r.verdict == Verdict.FAIL:
            follow.append(r.check)
        else:
            others.setdefault(r.verdict, []).append(r.check)
    many = sum(1 for r in group for f in r.findings if f.follows)
    if many:
        named = f", also of {', '.join(follow)}" if follow else ""
        yield f"{many} finding{'s follow' if many > 1 else ' follows'} (-v){named}"
    known = {Verdict.ERROR: "error", Verdict.INCONCLUSIVE: "open", Verdict.PASS: "held",
             Verdict.KNOWN: "known"}  # fmt: skip
    told = [f"{word}: {', '.join(others[v])}" for v, word in known.items() if v in others]
    if told:
        yield "; ".join(told)
