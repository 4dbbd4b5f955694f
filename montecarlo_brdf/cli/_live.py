"""The lines at the bottom of a terminal that change: results as they are decided, and a bar. What
anybody else writes meanwhile goes above them, and when the report comes they are gone."""
from __future__ import annotations

import contextlib
import io
import shutil
import threading
from collections.abc import Iterator, Sequence
from typing import TextIO

from montecarlo_brdf.judge.finding import Finding, Result, Verdict
from montecarlo_brdf.report import text
from montecarlo_brdf.report.columns import Style, painted

ERASE = "\r\x1b[K"
UP, BELOW = "\x1b[{}A", "\x1b[J"  # some lines up, erase all that is below
RESERVED = 2  # lines of a terminal that are not for results


class Bottom(io.TextIOBase):
    """A stream to a terminal with lines below what is written."""

    def __init__(self, stream: TextIO | None) -> None:
        self._stream, self._lock = stream, threading.RLock()
        self._lines: list[str] = []
        self._bar = self._begun = ""
        self._drawn = False

    def draw(self, lines: Sequence[str], bar: str) -> None:
        """Show these in place of those before."""
        with self._lock:
            gone = self._gone()
            self._lines, self._bar, self._drawn = [*lines], bar, True
            self._send(gone + self._shown())

    def clear(self) -> None:
        """Take them away."""
        with self._lock:
            if self._drawn:
                self._send(self._gone())
            if self._begun:
                self._send(self._begun)
            self._lines, self._bar, self._begun, self._drawn = [], "", "", False

    def write(self, written: str) -> int:
        """Whole lines go above."""
        with self._lock:
            whole, newline, self._begun = (self._begun + written).rpartition("\n")
            if newline:
                gone, shown = (self._gone(), self._shown()) if self._drawn else ("", "")
                self._send(gone + whole + newline + shown)
        return len(written)

    def isatty(self) -> bool:
        """As the stream itself."""
        return bool(self._stream and self._stream.isatty())

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """As the stream itself."""
        return self._stream.encoding if self._stream else "utf-8"

    def _gone(self) -> str:
        above = UP.format(len(self._lines)) + BELOW if self._lines else ""
        return (ERASE + above) if self._drawn else ""

    def _shown(self) -> str:
        return "".join(f"{ERASE}{line}\n" for line in self._lines) + ERASE + self._bar

    def _send(self, sent: str) -> None:
        with contextlib.suppress(OSError):  # a bar is not worth an error
            if self._stream:
                self._stream.write(sent)
                self._stream.flush()


@contextlib.contextmanager
def below(bottom: Bottom) -> Iterator[None]:
    """What a block prints, also a model's own words, goes above the lines."""
    with contextlib.redirect_stderr(bottom), contextlib.redirect_stdout(bottom):
        yield


class Board:
    """A line for each check of the model that is looked at, and for each before that needs
    attention."""

    def __init__(self, colour: bool) -> None:
        self._colour = colour
        self._case = ""
        self._rows: dict[tuple[str, str], tuple[Result, bool]] = {}

    def hear(self, result: Result, done: bool) -> None:
        """Take in the findings of a check so far."""
        if text.case(result) != self._case:
            self._case = text.case(result)
            self._rows = {k: row for k, row in self._rows.items() if _bad(row[0])}
        self._rows[self._case, result.check] = result, done

    def lines(self) -> list[str]:
        """As many as the terminal has room for; the last ones if there are more."""
        columns, rows = shutil.get_terminal_size()
        found = [self._line(*key, *row, columns - 1) for key, row in self._rows.items()]
        return found[-max(0, rows - RESERVED) :] if rows > RESERVED else []

    def _line(self, case: str, check: str, result: Result, done: bool, columns: int) -> str:
        bad = _bad(result)
        name = check if case == self._case else f"{case} {check}"
        n = sum(f.verdict != Verdict.SKIPPED for f in result.findings)
        claims = f"{n} claim{'s' * (n != 1)}"
        told = _sentence(text.most_telling(result)) if bad else claims
        known = text.loud(result.verdict) if done or bad else "..."
        style = text.style(result.verdict) if done or bad else Style.DIM
        rest = f" {name:12} {told}{'' if done else ' so far'}"
        return painted(f"{known:12}", style, self._colour) + rest[: max(0, columns - 12)]


def _sentence(finding: Finding) -> str:
    """The number first: a line may be cut."""
    if finding.expected is None or not finding.number:
        return finding.note or text.statement(finding)
    at = f", at {text.place(finding)}" if finding.where else ""
    return f"{finding.quantity} {finding.number}, allowed {text.bound(finding)}{at}"


def _bad(result: Result) -> bool:
    return result.verdict in text.BAD
