"""The file of answers: a line of JSON each, only ever added to, so that nothing that was answered
is lost with the process that asked.

A line that is not whole, as the last one of a process that was killed, counts as absent. Numbers
that are not finite stand as Python writes them, NaN and Infinity.
"""
from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TextIO

from montecarlo_brdf.errors import OutputError, UserError
from montecarlo_brdf.files import check_writable
from montecarlo_brdf.sweep.task import difference

KIND = "answers of brdf-check, a task a line"


class Journal:
    """Answers by the key of their task; without a file they live as long as the process."""

    def __init__(self, path: Path | None, identity: Mapping[str, str]) -> None:
        """Read what is there. Raises UserError for a file of something else, or of other versions:
        their answers cannot be mixed."""
        self._path, self.answers = path, dict[str, dict[str, Any]]()
        self._file: TextIO | None = None
        if path is None:
            return
        check_writable(path)
        head = {"kind": KIND, "identity": dict(identity)}
        try:
            lines = path.read_bytes().splitlines() if path.exists() else []
            rows = [row for line in lines if (row := _row(line))]
            _check(path, lines, rows, identity)
            self.answers = {row["task"]: row["answer"] for row in rows if "answer" in row}
            whole = not lines or path.read_bytes().endswith(b"\n")
            self._file = open(path, "a", encoding="utf-8")  # noqa: SIM115  for the whole sweep
            self._file.write("" if whole else "\n")
            if not rows:
                self._write(head)
        except OSError as error:
            raise OutputError(f"cannot write {path}: {error.strerror or error}") from error

    def add(self, key: str, answer: dict[str, Any]) -> None:
        """Keep an answer."""
        self.answers[key] = answer
        if self._file:
            try:
                self._write({"task": key, "answer": answer})
            except OSError as error:
                sentence = f"cannot write {self._path}: {error.strerror or error}"
                raise OutputError(sentence) from error

    def close(self) -> None:
        """Nothing more comes."""
        if self._file:
            self._file.close()

    def _write(self, row: Mapping[str, Any]) -> None:
        assert self._file
        self._file.write(json.dumps(row) + "\n")
        self._file.flush()


def _row(line: bytes) -> dict[str, Any] | None:
    try:
        row = json.loads(line)
    except ValueError:
        return None
    return row if isinstance(row, dict) else None


def _check(
    path: Path, lines: list[bytes], rows: list[dict[str, Any]], identity: Mapping[str, str]
) -> None:
    heads = [row for row in rows if row.get("kind") == KIND]
    if any(line.strip() for line in lines) and not heads:
        raise UserError(f"{path} holds something else than answers: give another name")
    for head in heads:
        if other := difference(identity, head.get("identity", {})):
            raise UserError(f"{path} holds answers of other versions ({other}): give another name")
