"""Did the checks run every line of the model?

What no check runs, not even where a search for the code's branches led, is told beside the verdict:
a pass says nothing of it. Asked of models whose lines somebody wrote. It cannot see: whether the
values that a line made were asked about by every law.
"""

from __future__ import annotations

import linecache
from collections.abc import Iterator
from pathlib import PurePath

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.lines import Unrun, total, unrun
from montecarlo_brdf.cases.look import look
from montecarlo_brdf.compile.bind import plain
from montecarlo_brdf.judge.claim import Claim, Limit, Skip
from montecarlo_brdf.model import Model, Property

NAME = "coverage"
QUESTION = "did a check run every line of the model?"
PROPERTY = Property.REFERENCE


def applies(model: Model) -> bool:
    """Whether somebody wrote its lines: a built-in model's are tested by us."""
    return not model.built_in and not model.terms


def claims(case: Case) -> Iterator[Claim]:
    """The lines that were not run, function by function."""
    count = total(case.model)
    if not count:
        yield Skip("lines run", "no line of this model can be followed")
        return
    missed = unrun(look(case))
    run = count - sum(len(one.lines) for one in missed)
    if not missed:
        yield Limit("lines run", {}, float(run), count, "plain calls")
    for one in missed:
        place = _place(one, case.model)
        yield Limit("lines run", place, float(run), count, "plain calls", note=_told(one))


def _place(one: Unrun, model: Model) -> dict[str, str]:
    """Which lines; of a function that the model's file imports also of which file."""
    home = plain(model.f).__code__.co_filename
    elsewhere = {"file": PurePath(one.file).name} if one.file != home else {}
    return {**elsewhere, "lines": _ranges(one.lines)}


def _told(one: Unrun) -> str:
    """The lines in words, with what the first of them says."""
    first = one.lines[0]
    which = f"line {first}" if len(one.lines) == 1 else f"lines {_ranges(one.lines)}"
    said = linecache.getline(one.file, first).strip()
    verb = "was" if len(one.lines) == 1 else "were"
    return f"{which} of {one.function} {verb} never run, not even by a search for it ({said})"


def _ranges(lines: tuple[int, ...]) -> str:
    """Line numbers, those that follow each other as a range."""
    parts: list[list[int]] = []
    for line in lines:
        if parts and line == parts[-1][-1] + 1:
            parts[-1].append(line)
        else:
            parts.append([line])
    return ", ".join(f"{p[0]}-{p[-1]}" if len(p) > 1 else str(p[0]) for p in parts)
