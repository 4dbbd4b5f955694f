"""A command on a pseudo-terminal, and what one would see there."""
from __future__ import annotations

import os
import re
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pty = pytest.importorskip("pty")

PATIENCE = 60.0  # seconds until an answer is taken for missing
BEGIN = "from montecarlo_brdf.cli import main; main()"


class Session:
    """A command on a terminal of its own."""

    def __init__(self, folder: Path, code: str, *arguments: str, **changed: str) -> None:
        ours, theirs = pty.openpty()
        environment = {**os.environ, "TERM": "dumb", "COLUMNS": "200", **changed}
        environment.pop("BRDF_CHECK_QUIET", None)
        self.process = subprocess.Popen(
            [sys.executable, "-c", code, *arguments], cwd=folder, env=environment,
            stdin=theirs, stdout=theirs, stderr=theirs, start_new_session=True,
        )  # fmt: skip
        os.close(theirs)
        self._terminal = ours
        self._text = ""

    def until(self, *words: str) -> str:
        """What is said until some words, one after another."""
        end = time.monotonic() + PATIENCE
        said = ""
        for word in words:
            while word not in self._text:
                ready, _, _ = select.select([self._terminal], [], [], end - time.monotonic())
                assert ready, f"{word!r} was not said: {said + self._text}"
                self._text += os.read(self._terminal, 1 << 16).decode().replace("\r\n", "\n")
            before, found, self._text = self._text.partition(word)
            said += before + found
        return said

    def rest(self) -> str:
        """All that is said until the end."""
        while True:
            try:
                read = os.read(self._terminal, 1 << 16)
            except OSError:  # the other end is closed
                read = b""
            if not read:
                return self._text.replace("\r\n", "\n")
            self._text += read.decode()

    def interrupt(self) -> int:
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE)

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._terminal)


CODE = re.compile(r"\x1b\[(\d*)([A-Za-z])|(\r)|(\n)|([^\x1b\r\n]+)")


def screen(sent: str) -> str:
    """What a terminal shows at the end of what it was sent: text, and the codes that we use."""
    rows, at, column = [""], 0, 0
    for count, code, back, down, text in CODE.findall(sent):
        if back:
            column = 0
        elif down:
            at, column = at + 1, 0
            rows += [""] if at == len(rows) else []
        elif code == "A":
            at -= int(count or 1)
        elif code == "K":
            rows[at] = rows[at][:column]
        elif code == "J":
            rows[at:] = [rows[at][:column]]
        elif text:
            rows[at] = rows[at][:column].ljust(column) + text + rows[at][column + len(text) :]
            column += len(text)
        else:
            assert code == "m", code
    return "\n".join(rows)
