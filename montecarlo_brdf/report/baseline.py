"""What changed since an earlier report: new failures, fixed ones, other verdicts.

Findings are the same if model, parameters, check, quantity and place agree; what is left of a
quantity is matched in its order, as a worst case may be found elsewhere than before.
"""
from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import EXIT_CODES, SEVERITY, Verdict

#: kinds of change, in the order in which they are told; the first two decide the exit code
KINDS = ("new failure", "newly undecided", "fixed", "changed", "new", "gone")
BAD = {"fail": "new failure", "error": "new failure", "inconclusive": "newly undecided"}


class Change(NamedTuple):
    """One finding whose verdict is not what it was."""

    kind: str
    name: str  # model, check, quantity, place
    before: str | None
    now: str | None

    def __str__(self) -> str:
        return f"{self.kind}: {self.name} ({self.before or 'absent'} -> {self.now or 'absent'})"


def changes(now: dict[str, Any], before: dict[str, Any]) -> list[Change]:
    """All changes from one report to another, both as plain data; the worst kinds first."""
    if now["command"] != before.get("command"):
        raise UserError(
            f"the baseline is a report of {before.get('command')}, this is one of {now['command']}"
        )
    found = [c for pair in _matched(_listed(now), _listed(before)) if (c := _change(*pair))]
    return sorted(found, key=lambda c: KINDS.index(c.kind))


def exit_code(found: list[Change]) -> int:
    """As bad as the worst verdict that is new: 4, 1, 3, or 0 if nothing got worse."""
    worse = [c.now or "" for c in found if c.kind in KINDS[:2]]
    return EXIT_CODES[Verdict(min(worse, key=SEVERITY.index))] if worse else 0


Row = tuple[tuple[Any, ...], str, str]  # what it is about, its place, its verdict


def _listed(report: dict[str, Any]) -> list[Row]:
    return [
        (
            (r["model"], repr(sorted(_plain(r["params"]).items())), r["check"], f["quantity"]),
            " ".join(f"{k}={v}" for k, v in _plain(f["where"]).items()),
            f["verdict"],
        )
        for r in report["results"]
        for f in r["findings"]
    ]


def _plain(values: dict[str, Any]) -> dict[str, Any]:
    """As JSON gives them back."""
    return {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}


def _matched(now: list[Row], before: list[Row]) -> Iterator[tuple[Row | None, Row | None]]:
    """Pairs of the same finding; None where one report lacks it."""
    exact: dict[Any, list[Row]] = defaultdict(list)
    for row in before:
        exact[row[:2]].append(row)
    left: dict[Any, list[Row]] = defaultdict(list)
    unmatched = []
    for row in now:
        if exact[row[:2]]:
            yield row, exact[row[:2]].pop(0)
        else:
            unmatched.append(row)
    for key, rows in exact.items():
        left[key[0]] += rows
    for row in unmatched:
        yield row, left[row[0]].pop(0) if left[row[0]] else None
    for rows in left.values():
        yield from ((None, row) for row in rows)


def _change(now: Row | None, before: Row | None) -> Change | None:
    subject, place, _ = now or before or ((), "", "")
    model, _, check, quantity = subject
    name = " ".join(filter(None, (model, check, quantity, place)))
    old, new = before[2] if before else None, now[2] if now else None
    kind = _kind(old, new)
    return Change(kind, name, old, new) if kind else None


def _kind(old: str | None, new: str | None) -> str | None:
    if old == new:
        return None
    if new in BAD and (old not in BAD or SEVERITY.index(new) < SEVERITY.index(old)):
        return BAD[new]
    if old in BAD and new in ("pass", "known"):
        return "fixed"
    if old is None:
        return "new" if new not in ("pass", "skipped") else None
    return "gone" if new is None else "changed"
