"""What stdout and stderr are, and what they are given: text in columns, and a progress bar for work
that takes longer than half a second."""

from __future__ import annotations

import contextlib
import math
import os
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from typing import TextIO

import click

from montecarlo_brdf.cli import _live
from montecarlo_brdf.compile import folders
from montecarlo_brdf.compile.kernel import listeners
from montecarlo_brdf.judge.finding import Result
from montecarlo_brdf.report.text import PLAIN_WIDTH
from montecarlo_brdf.verify.question import Heard

PATIENCE = 0.5
INTERVAL = 0.1  # seconds from one drawing to the next
CELLS = 40
LONG = 3.0  # seconds of compiling after which one is told
LASTS = 2.0  # seconds for which a kernel counts as being compiled


_kept: list[TextIO] = []


@contextlib.contextmanager
def answers_alone() -> Iterator[None]:
    """stdout is for what a command says: what a model's file prints meanwhile goes to stderr."""
    from montecarlo_brdf.foreign import translation

    heard = set[str]()

    def hear(sentence: str) -> None:
        if sentence not in heard and not quiet():
            click.echo(sentence, err=True)
        heard.add(sentence)

    _kept.append(sys.stdout)
    translation.listeners.append(hear)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield
    finally:
        _kept.pop()
        translation.listeners.remove(hear)


def stdout() -> TextIO:
    """Where answers go."""
    return _kept[-1] if _kept else sys.stdout


def width() -> int:
    """Characters of a line: of the terminal, or what a page has room for."""
    known = stdout() is not None and stdout().isatty()
    return shutil.get_terminal_size((PLAIN_WIDTH, 24)).columns if known else PLAIN_WIDTH


def colour() -> bool:
    """Whether stdout gets colours: as https://no-color.org and https://force-color.org say."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown"):
        return False
    forced = os.environ.get("FORCE_COLOR")
    return bool(forced) or (stdout() is not None and stdout().isatty())


def tell(text: str) -> None:
    """Print text that may have colours."""
    click.echo(text, file=stdout(), nl=not text.endswith("\n"), color=colour())


@contextlib.contextmanager
def progress(title: str, results: bool = False) -> Iterator[Shown]:
    """A callback for the fraction done; draws nothing unless stderr is a terminal.

    results: show them as they are decided, where stdout is a terminal too."""
    if why := folders.fault():
        slow = "everything is compiled anew each time"
        click.echo(f"Warning: cannot write to {folders.directory()} ({why}): {slow}", err=True)
    if quiet():
        yield Shown()
        return
    both = results and _terminal() and stdout().isatty()
    bar = _Bar(title, colour() if both else None)
    listeners.append(bar.compiles)
    try:
        with _live.below(bar.bottom) if both else contextlib.nullcontext():
            yield bar
    finally:
        listeners.remove(bar.compiles)
        bar.end()


class Shown:
    """How far a command is, for somebody who does not want to know."""

    #: takes in the findings of a check so far; None where nobody sees them
    hear: Heard | None = None

    def __call__(self, done: float) -> None:
        """So much is done."""


class _Bar(Shown):
    """The same on a terminal, drawn in intervals, for threads that all tell how far they are."""

    def __init__(self, title: str, colour: bool | None) -> None:
        """colour: of results; None for no results."""
        self.bottom = _live.Bottom(sys.stderr)
        self._title, self._board = title, None if colour is None else _live.Board(colour)
        self._started = time.monotonic()
        self._due, self._done = self._started + PATIENCE, 0.0
        self._lock = threading.Lock()
        self._words = _Words(self.bottom)
        self.hear = self._hear if self._board else None

    def __call__(self, done: float) -> None:
        self._done = done
        self._draw()

    def _hear(self, result: Result, done: bool) -> None:
        if self._board:
            with self._lock:
                self._board.hear(result, done)

    def compiles(self, model: str) -> None:
        """A kernel of a model is compiled now."""
        self._words.hear(model)
        self._draw()

    def end(self) -> None:
        """Say nothing any more."""
        self._words.end()
        self.bottom.clear()

    def _draw(self) -> None:
        now = time.monotonic()
        if now < self._due or not _terminal():
            return
        with self._lock:
            self._due = now + INTERVAL
            bar = line(self._words.now() or self._title, self._done, now - self._started)
            self.bottom.draw(self._board.lines() if self._board else [], bar)


class _Words:
    """What to say while machine code is made, which the first run of a model waits for."""

    def __init__(self, bottom: _live.Bottom) -> None:
        self._bottom = bottom
        self._model, self._kernels, self._last = "", 0, -math.inf
        self._timer: threading.Timer | None = None

    def hear(self, model: str) -> None:
        """A kernel is compiled; the next seconds belong to it."""
        self._kernels = self._kernels + 1 if model == self._model else 1
        self._model, self._last = model, time.monotonic()
        if self._timer is None:
            self._timer = threading.Timer(LONG, self._say)
            self._timer.daemon = True
            self._timer.start()

    def now(self) -> str:
        """'compiling my.py, first time (3)', if that is so."""
        recent = time.monotonic() - self._last < LASTS
        return f"compiling {self._model}, first time ({self._kernels})" if recent else ""

    def _say(self) -> None:
        self._bottom.write(f"compiling {self._model}, first time: the next run need not\n")

    def end(self) -> None:
        """Say nothing any more."""
        if self._timer:
            self._timer.cancel()


def quiet() -> bool:
    """Whether nobody wants to hear how it goes: --quiet, or BRDF_CHECK_QUIET."""
    context = click.get_current_context(silent=True)
    asked = bool(context and context.params.get("quiet"))
    return asked or bool(os.environ.get("BRDF_CHECK_QUIET"))


def line(title: str, done: float, seconds: float) -> str:
    """'furnace ########............  42% 13 s left', no wider than the terminal."""
    done = min(max(done, 0.0), 1.0)
    left = f"{(1.0 - done) / done * seconds:.0f} s left" if done else ""
    bar = ("#" * round(CELLS * done)).ljust(CELLS, ".")
    return f"{title} {bar} {done:4.0%} {left}"[: shutil.get_terminal_size().columns - 1]


def _terminal() -> bool:
    return bool(sys.stderr and sys.stderr.isatty()) and os.environ.get("TERM") != "dumb"
