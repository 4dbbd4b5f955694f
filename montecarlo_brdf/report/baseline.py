"""What changed since an earlier report: new failures, fixed ones, other verdicts.

Findings are the same if model, parameters, check, quantity and place agree; what is left of a
quantity is matched in its order, as a worst case may be found elsewhere than before.
"""
from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import EXIT_CODES, SEVERITY, Report, Verdict, worst

#: kinds of change, in the order in which they are told; the first two decide the exit code
KINDS = ("new failure", "newly undecided", "fixed", "changed", "new", "gone")
BAD = {Verdict.FAIL: KINDS[0], Verdict.ERROR: KINDS[0], Verdict.INCONCLUSIVE: KINDS[1]}


class Change(NamedTuple):
    """One finding whose verdict is not what it was."""

    kind: str
    name: str  # model, check, quantity, place
    before: Verdict | None
    now: Verdict | None

    def __str__(self) -> str:
        return f"{self.kind}: {self.name} ({self.before or 'absent'} -> {self.now or 'absent'})"


def changes(now: Report, before: Report) -> list[Change]:
    """All changes from one report to another; the worst kinds first."""
    if now.command != before.command:
        raise UserError(
            f"the baseline is a report of {before.command}, this is one of {now.command}"
        )
    found = [c for pair in _matched(_listed(now), _listed(before)) if (c := _change(*pair))]
    return sorted(found, key=lambda c: KINDS.index(c.kind))


def exit_code(found: list[Change]) -> int:
    """As bad as the worst verdict that is new: 4, 1, 3, or 0 if nothing got worse."""
    return EXIT_CODES[Verdict(worst(c.now for c in found if c.now and c.kind in KINDS[:2]))]


def moved(now: Report, before: Report) -> list[str]:
    """What still needs attention and has another value."""
    pairs = _matched(_listed(now), _listed(before))
    return [
        f"still {a.verdict}: {_called(a)}: {b.number} -> {a.number}"
        for a, b in pairs
        if a and b and a.verdict == b.verdict in BAD and a.number != b.number
    ]


class Row(NamedTuple):
    """One finding."""

    subject: tuple[str, str, str, str]  # model, parameters, check, quantity
    place: str
    verdict: Verdict
    number: str = ""  # what was found


def _listed(report: Report) -> list[Row]:
    return [
        Row(
            (r.model, repr(sorted(_plain(r.params).items())), r.check, f.quantity),
            " ".join(f"{k}={v}" for k, v in _plain(f.where).items()),
            Verdict(f.verdict),
            f.number,
        )
        for r in report.results
        for f in r.findings
    ]


def _plain(values: dict[str, Any]) -> dict[str, Any]:
    """As JSON gives them back."""
    return {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}


def _matched(now: list[Row], before: list[Row]) -> Iterator[tuple[Row | None, Row | None]]:
    """Pairs of the same finding; None where one report lacks it."""
    exact: dict[tuple[object, str], list[Row]] = defaultdict(list)
    for row in before:
        exact[row[:2]].append(row)
    left: dict[object, list[Row]] = defaultdict(list)
    unmatched = []
    for row in now:
        if exact[row[:2]]:
            yield row, exact[row[:2]].pop(0)
        else:
            unmatched.append(row)
    for (subject, _), rows in exact.items():
        left[subject] += rows
    for row in unmatched:
        yield row, left[row.subject].pop(0) if left[row.subject] else None
    for rows in left.values():
        yield from ((None, row) for row in rows)


def _change(now: Row | None, before: Row | None) -> Change | None:
    either = now or before
    assert either is not None  # a pair has at least one
    old, new = before.verdict if before else None, now.verdict if now else None
    kind = _kind(old, new)
    return Change(kind, _called(either), old, new) if kind else None


def _called(row: Row) -> str:
    """'my.py furnace A theta_o_deg=45.0'."""
    model, _, check, quantity = row.subject
    return " ".join(filter(None, (model, check, quantity, row.place)))


def _kind(old: Verdict | None, new: Verdict | None) -> str | None:
    if old == new:
        return None
    if new in BAD and (old not in BAD or SEVERITY.index(new) < SEVERITY.index(old)):
        return BAD[new]
    if old in BAD and new in (Verdict.PASS, Verdict.KNOWN):
        return "fixed"
    if old is None:
        return "new" if new not in (Verdict.PASS, Verdict.SKIPPED) else None
    return "gone" if new is None else "changed"
