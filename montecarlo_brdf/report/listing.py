"""A model's source on a page: which lines a failing check is about, and which none has run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from montecarlo_brdf.judge.finding import Result
from montecarlo_brdf.report import text

MOST_LINES = 2000  # of a source
LINES_RUN = "lines run"  # the quantity of the check of coverage


class Line(NamedTuple):
    """A line of a file."""

    number: int
    text: str
    accused: str  # the checks that failed and are about the function that begins here
    unrun: bool  # no check ran it


class Source(NamedTuple):
    """The lines of a model's file."""

    file: str
    lines: list[Line]
    left_out: int
    followed: bool  # whether it is known which lines were run

    @property
    def unrun(self) -> int:
        """How many lines no check ran."""
        return sum(line.unrun for line in self.lines)


def source(results: Sequence[Result], files: Mapping[str, object]) -> Source | None:
    """The file that some results are about, if the report has kept it."""
    where = next((r.source for r in results if r.source), None)
    content = files.get(where["file"]) if where else None
    if where is None or not isinstance(content, str):
        return None
    accused: dict[int, list[str]] = {}
    for result in results:
        if result.verdict in text.BAD:
            accused.setdefault(text.line_of(result), []).append(result.check)
    ranges = [f.where["lines"] for r in results for f in r.findings if _of_lines(f.where)]
    unrun = {n for one in ranges for n in numbers(one)}
    lines = content.splitlines()
    rows = [
        Line(k, line, ", ".join(accused.get(k, [])), k in unrun)
        for k, line in enumerate(lines[:MOST_LINES], 1)
    ]
    followed = any(f.quantity == LINES_RUN for r in results for f in r.findings)
    return Source(where["file"], rows, max(0, len(lines) - MOST_LINES), followed)


def _of_lines(where: Mapping[str, object]) -> bool:
    """Whether a finding is about lines of the model's own file."""
    return isinstance(where.get("lines"), str) and "file" not in where


def numbers(ranges: str) -> Iterator[int]:
    """3, 4, 5, 9 of '3-5, 9'; nothing of what is no such list."""
    for part in ranges.split(","):
        first, _, last = part.strip().partition("-")
        if first.isdigit() and (last or first).isdigit():
            yield from range(int(first), min(int(last or first), MOST_LINES) + 1)
