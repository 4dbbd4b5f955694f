"""A task: a question of one model with one parameter set, as plain data.

Its key is the hash of all that its answer depends on, the content of the model's files among it,
and of nothing else: where these lie is not part of it.
"""
from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf import __version__
from montecarlo_brdf.judge.finding import Command, versions


class File(NamedTuple):
    """A file that a model is made of."""

    place: str  # below the folder that holds all of them
    content: str  # hash
    named: str  # what sentences call it
    shown: str  # what reports call it: relative if it lies below here


class Task(NamedTuple):
    """What somebody is asked."""

    command: Command
    model: str  # as `load` takes it, `mark(k)` in place of the path of file k
    name: str  # the same as it was typed
    params: dict[str, Any] | None  # as `Model.parameters` takes them; None: all are searched
    terms: dict[str, Any]  # what else the question takes
    files: tuple[File, ...] = ()

    @property
    def key(self) -> str:
        """Hash of all that the answer depends on."""
        files = [(f.place, f.content) for f in self.files]
        content = json.dumps([*self[:2], self.params, self.terms, files], sort_keys=True)
        return hashlib.blake2b(content.encode(), digest_size=16).hexdigest()


def mark(k: int) -> str:
    """What stands for the path of file k: no path has it."""
    return f"\0{k}\0"


def written(tasks: Sequence[Task]) -> str:
    """Tasks as JSON."""
    return json.dumps([list(task) for task in tasks])


def read(text: str) -> list[Task]:
    """The tasks in a JSON text; what was a tuple is one again."""
    return [_task(*row) for row in json.loads(text)]


def _task(
    command: str, model: str, name: str, params: Mapping[str, Any] | None, terms: dict[str, Any],
    files: Sequence[Sequence[str]],
) -> Task:  # fmt: skip
    values = None
    if params is not None:
        values = {k: tuple(v) if isinstance(v, list) else v for k, v in params.items()}
    return Task(Command(command), model, name, values, terms, tuple(File(*row) for row in files))


@functools.cache
def identity() -> dict[str, str]:
    """What two processes must share for their answers to be parts of one report."""
    code = hashlib.blake2b(digest_size=8)
    root = Path(__file__).parent.parent
    for path in sorted(root.rglob("*.py")):
        code.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return {**versions(), "montecarlo_brdf": f"{__version__} ({code.hexdigest()})"}


def difference(ours: Mapping[str, str], theirs: Mapping[str, str]) -> str:
    """'numba 0.61.0 there and 0.62.1 here'; empty if there is none."""
    for name in {**ours, **theirs}:
        here, there = ours.get(name, "no"), theirs.get(name, "no")
        if here != there:
            return f"{name} {there} there and {here} here"
    return ""
