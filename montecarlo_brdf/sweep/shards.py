"""Parts of a sweep that are asked on machines which know nothing of each other, and their reports
as one."""
from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Report, Result
from montecarlo_brdf.sweep.task import difference
from montecarlo_brdf.verify.question import merged

NOTE = "sweep"  # of what a report measured: which part of which sweep it is


class Shard(NamedTuple):
    """Of so many parts this one, from 1 on: every so many-th task."""

    this: int = 1
    of: int = 1

    def __str__(self) -> str:
        return f"{self.this}/{self.of}"

    def places(self, total: int) -> range:
        """Which tasks, from 0."""
        return range(self.this - 1, total, self.of)


def shard(text: str) -> Shard:
    """The shard that 'i/n' names. Raises ValueError for anything else."""
    match = re.fullmatch(r"(\d{1,6})/(\d{1,6})", text)
    found = Shard(int(match[1]), int(match[2])) if match else Shard(0, 0)
    if not 1 <= found.this <= found.of:
        raise ValueError(f"{text!r} is no part of a whole (write 1/3, 2/3 or 3/3)")
    return found


def note(part: Shard, keys: Sequence[str], counts: Mapping[int, int]) -> dict[str, Any]:
    """What a report says of its part. keys: of all tasks of the sweep; counts: place of a task of
    this part -> its results."""
    whole = hashlib.blake2b("\n".join(keys).encode(), digest_size=16).hexdigest()
    return {"shard": str(part), "tasks": len(keys), "whole": whole, "counts": [*counts.items()]}


def joined(reports: Mapping[str, Report]) -> Report:
    """One report of several, by the names of their files: of all parts of a sweep the same results
    as if one process had asked, of others one after another.

    Raises UserError if they do not belong together, or a part is missing.
    """
    first_name, first = next(iter(reports.items()))
    for name, report in reports.items():
        _check_same(first_name, first, name, report)
    parts = {name: report.measured.get(NOTE) for name, report in reports.items()}
    if not any(parts.values()):
        return _one(list(reports.values()), first)
    _check_parts(parts)
    found: dict[int, tuple[Report, list[Result]]] = {}
    for name, report in reports.items():
        rest = iter(report.results)
        for place, count in parts[name]["counts"]:  # type: ignore[index]
            found[place] = report, [next(rest) for _ in range(count)]
    ordered = [found[place] for place in sorted(found)]
    whole = _one(list(reports.values()), ordered[0][0] if ordered else first)
    whole.measured.pop("seconds_of_results", None)  # they are in the order of parts
    return Report(whole.command, whole.settings, [r for _, results in ordered for r in results],
                  whole.measured, whole.versions, whole.diagnosis)  # fmt: skip


def _one(reports: Sequence[Report], first: Report) -> Report:
    one = merged(reports)
    return Report(one.command, first.settings, one.results, one.measured, first.versions,
                  one.diagnosis)  # fmt: skip


def _check_same(first_name: str, first: Report, name: str, report: Report) -> None:
    """Raises UserError if two reports ask other questions, or by other programs."""
    if report.command != first.command:
        told = f"{name} is a report of {report.command} and {first_name} one of {first.command}"
        raise UserError(told)
    ours, theirs = first.versions or {}, report.versions or {}
    if other := difference(ours, theirs):
        sentence = other.replace(" there", f" in {name}").replace(" here", f" in {first_name}")
        raise UserError(f"these reports are not of the same versions: {sentence}")
    settings = first.settings, report.settings
    for key in {**settings[0], **settings[1]}:
        a, b = (s.get(key) for s in settings)
        if a != b and key != "checks":  # which checks are asked hangs on the model
            told = f"{key} is {b} in {name} and {a} in {first_name}"
            raise UserError(f"these reports are not of the same settings: {told}")


def _check_parts(parts: Mapping[str, Any]) -> None:
    """Raises UserError unless these are all parts of one sweep."""
    seen: dict[str, str] = {}
    for name, part in parts.items():
        if not part:
            raise UserError(f"{name} is a whole report, others are parts of one")
        said = part["shard"]
        if said in seen:
            raise UserError(f"{name} and {seen[said]} are both part {said}")
        seen[said] = name
    first_name, first = next(iter(parts.items()))
    for name, part in parts.items():
        if part["whole"] != first["whole"] or _count(part) != _count(first):
            about = "other models, parameters or settings"
            raise UserError(f"{name} is a part of another whole than {first_name}: {about}")
    missing = [f"{k + 1}/{_count(first)}" for k in range(_count(first))
               if f"{k + 1}/{_count(first)}" not in seen]  # fmt: skip
    if missing:
        raise UserError(f"no report of part {', '.join(missing)}: the whole is not known")


def _count(part: Mapping[str, Any]) -> int:
    return int(str(part["shard"]).partition("/")[2])
