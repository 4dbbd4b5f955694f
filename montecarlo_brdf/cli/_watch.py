"""--watch: the same question again in the living process whenever a file changes that its answer is
made of, what changed against the last verdict first."""
from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from montecarlo_brdf.cli import INTERRUPTED, _terminal, of_a_model
from montecarlo_brdf.cli._options import Answer
from montecarlo_brdf.cli._sources import Sources
from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.report import baseline
from montecarlo_brdf.verify.supervision import left_behind

MOST = 10  # lines of what changed


def watched(answer: Answer) -> int:
    """Answer after every change until Ctrl-C; the exit code of the last answer, 130 if there is
    none."""
    loop = _Loop(answer)
    try:
        while True:
            loop.again()
            _say(f"watching {_names([p for p in loop.sources.stamps if not p.is_dir()])}")
            _say(f"\n{_names(loop.sources.changed())} changed")
    except KeyboardInterrupt:
        return loop.code


class _Loop:
    """One answer after another."""

    def __init__(self, answer: Answer) -> None:
        self._answer, self.sources = answer, Sources()
        self.code = INTERRUPTED
        self._before: Report | None = None  # the last verdict
        self._first = True

    def again(self) -> None:
        """Answer, with what is wrong as one sentence. A mistake in what is asked, which no edit
        mends, ends it."""
        try:
            with self.sources.recorded():
                self.code = self._answer(self._compared)
        except UserError as error:
            if self._first and not isinstance(error, ModelError):
                raise
            self.code = _complaint(str(error), error.exit_code)
        except Exception as error:
            sentence = of_a_model(error)
            if not sentence:
                raise
            self.code = _complaint(sentence, ModelError.exit_code)
        if not self.sources.stamps:
            raise UserError("--watch needs a file of your own: nothing here could change")
        if left_behind():
            _say("note: code of an answer before still runs and takes a processor; begin anew")
        self._first = False

    def _compared(self, report: Report) -> None:
        """Tell what changed since the last verdict."""
        if report.measured.get("interrupted"):
            raise KeyboardInterrupt
        if self._before:
            changes = [str(one) for one in baseline.changes(report, self._before)]
            found = [*changes, *baseline.moved(report, self._before)]
            for sentence in found[:MOST]:
                _say(sentence)
            if len(found) > MOST:
                _say(f"and {len(found) - MOST} more")
            if not found:
                _say(f"nothing changed: {report.verdict}")
        self._before = report


def _complaint(sentence: str, code: int) -> int:
    click.echo(f"Error: {sentence}", err=True)
    return code


def _say(sentence: str) -> None:
    if not _terminal.quiet():
        click.echo(sentence, err=True)


def _names(paths: Sequence[Path]) -> str:
    """'my.py, other.py and 3 more'."""
    names = sorted(os.path.relpath(path) for path in paths)
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more
