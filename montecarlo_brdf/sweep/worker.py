"""What a worker does: lay down the text of a model, load it, ask, and answer in plain data."""
from __future__ import annotations

import functools
import json
import os
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from montecarlo_brdf import loading
from montecarlo_brdf.counterpart import counterpart
from montecarlo_brdf.errors import ModelError, TooSlow, UserError
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.model import Model
from montecarlo_brdf.sweep import task as tasks
from montecarlo_brdf.sweep.task import File, Task, mark
from montecarlo_brdf.sweep.texts import Folder
from montecarlo_brdf.verify.furnace import furnace
from montecarlo_brdf.verify.question import failed
from montecarlo_brdf.verify.run import run

MODELS = 64  # that a process keeps loaded
_lock = threading.Lock()  # a worker's threads import one model after another


def answered(asked: str, sent: Mapping[str, bytes], threads: int | None = 1) -> str:
    """The answers to some tasks, in JSON.

    asked: from `tasks.written`. sent: contents of files by their hash. threads: within a task.
    Besides "answers" there may be "missing", hashes of contents that must be sent for any answer.
    """
    told: dict[str, Any] = {"identity": tasks.identity(), "process": os.getpid()}
    todo = tasks.read(asked)
    with _lock:
        lacking = {h for one in todo for h in folder().lacks(one.files, sent)}
    if lacking:
        return json.dumps({**told, "missing": sorted(lacking)})
    return json.dumps({**told, "answers": [_answer(one, threads) for one in todo]})


def _answer(task: Task, threads: int | None) -> dict[str, Any]:
    """What a report would hold, or why it cannot be asked so."""
    began = time.perf_counter()
    paths = folder().laid(task.files)
    try:
        report = QUESTIONS[task.command](task, paths, threads)
    except ModelError as error:
        report = failed(task.command, task.name, error)
    except TooSlow as error:
        told = Finding(task.command, {}, Verdict.INCONCLUSIVE, note=str(error))
        report = Report(task.command, {}, [Result(task.name, {}, task.command, [told])])
    except UserError as error:
        return {"refused": _here(str(error), task.files, paths)}
    found = replace(report, versions=tasks.identity()).to_dict()
    for result in found["results"]:
        if "source" in result:
            result["source"] = _source(result["source"], task.files, paths)
    answer = {
        "settings": found["settings"], "results": found["results"],
        "times": report.measured.get("seconds_of_results", []),
        "diagnosis": found.get("diagnosis", []),
    }  # fmt: skip
    named: dict[str, Any] = _here(answer, task.files, paths)
    return {**named, "seconds": time.perf_counter() - began}


def _run(task: Task, paths: Sequence[Path], threads: int | None) -> Report:
    terms = dict(task.terms)
    model = _model(task.model, task.files, tuple(paths))
    fixed, against = terms.pop("fixed"), terms.pop("against")
    other = counterpart(_filled(against, paths), model, fixed) if against else None
    p = None if task.params is None else [model.parameters(**task.params)]
    return run(model, p, fixed=fixed, against=other, threads=threads, **terms)


def _furnace(task: Task, paths: Sequence[Path], threads: int | None) -> Report:
    model = _model(task.model, task.files, tuple(paths))
    sets = [model.parameters(**(task.params or {}))]
    return furnace(model, sets, threads=threads, **task.terms)


#: command -> its question, as a worker asks it
QUESTIONS: dict[Command, Callable[[Task, Sequence[Path], int | None], Report]] = {
    Command.RUN: _run,
    Command.FURNACE: _furnace,
}


@functools.cache
def folder() -> Folder:
    """That of this process."""
    return Folder()


@functools.lru_cache(MODELS)
def _model(spec: str, files: tuple[File, ...], paths: tuple[Path, ...]) -> Model:
    """One for all its tasks: they share its machine code."""
    with _lock:
        root = str(folder().root)
        sys.path[:] = [place for place in sys.path if not place.startswith(root)]
        return loading.load(_filled(spec, paths))


def _filled(spec: str, paths: Sequence[Path]) -> str:
    for k, path in enumerate(paths):
        spec = spec.replace(mark(k), str(path))
    return spec


def _source(told: Mapping[str, Any], files: Sequence[File], paths: Sequence[Path]) -> Any:
    """Where f lies for who asked."""
    place = Path(os.path.abspath(told["file"]))
    shown = {path: file.shown for file, path in zip(files, paths, strict=True)}
    return {**told, "file": shown.get(place, told["file"])}


def _here(value: Any, files: Sequence[File], paths: Sequence[Path]) -> Any:
    """The same with the names that files have for who asked."""
    if isinstance(value, str):
        for file, path in zip(files, paths, strict=True):
            value = value.replace(str(path), file.named)
        return value
    if isinstance(value, dict):
        return {k: _here(v, files, paths) for k, v in value.items()}
    return [_here(v, files, paths) for v in value] if isinstance(value, (list, tuple)) else value
