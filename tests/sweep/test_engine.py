"""The engine asks again where a worker died, finds out which task kills, and mixes no versions."""
from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from pathlib import Path
from typing import Any

import pytest

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Command
from montecarlo_brdf.sweep import engine
from montecarlo_brdf.sweep import task as tasks
from montecarlo_brdf.sweep.engine import ATTEMPTS, Engine
from montecarlo_brdf.sweep.journal import Journal
from montecarlo_brdf.sweep.pools import Pool
from montecarlo_brdf.sweep.task import File, Task
from montecarlo_brdf.sweep.texts import Texts
from montecarlo_brdf.verify.supervision import Deadline


def task(k: int, files: Sequence[File] = ()) -> Task:
    return Task(Command.RUN, "m", "m", {"k": k}, {}, tuple(files))


def nothing(asked: str, sent: Mapping[str, bytes], threads: int | None) -> str:
    """A worker that does nothing."""
    answer = {"settings": {}, "results": [], "times": [], "seconds": 1e-6}
    told = {"identity": tasks.identity(), "answers": [answer for _ in tasks.read(asked)]}
    return json.dumps(told)


class Direct(Executor):
    """Calls at once, and notes what it was asked."""

    def __init__(self, poison: int | None = None) -> None:
        self.asked: list[list[Any]] = []
        self._poison = poison

    def submit(self, function: Any, /, *arguments: Any, **more: Any) -> Future[Any]:
        future: Future[Any] = Future()
        ks = [one.params["k"] for one in tasks.read(arguments[0]) if one.params]
        self.asked.append(ks)
        if self._poison in ks:
            future.set_exception(BrokenExecutor("dead"))
        else:
            future.set_result(function(*arguments, **more))
        return future


def swept(executor: Direct, todo: Sequence[Task], perform: Any = nothing) -> Journal:
    journal = Journal(None, {})
    done: list[float] = []
    Engine(Pool(executor, lambda: 2), Texts(), journal, perform).ask(todo, Deadline(), done.append)
    assert done[-1] == 1.0 and done == sorted(done)
    return journal


def test_every_task_is_asked_once_and_more_at_a_time() -> None:
    executor = Direct()
    journal = swept(executor, [task(k) for k in range(1000)])
    assert sorted(k for ks in executor.asked for k in ks) == [*range(1000)]
    assert len(journal.answers) == 1000 and len(executor.asked) < 100
    swept(executor, [task(k) for k in range(3)])


def test_a_task_that_kills_is_given_up_and_nothing_else_is() -> None:
    executor = Direct(poison=500)
    todo = [task(k) for k in range(1000)]
    answers = swept(executor, todo).answers
    dead = [k for k, one in enumerate(todo) if answers[one.key]["results"]]
    assert dead == [500]
    note = answers[todo[500].key]["results"][0]["findings"][0]["note"]
    assert note == f"the process that was asked ended without an answer, {ATTEMPTS} times"
    assert executor.asked.count([500]) == ATTEMPTS


def test_workers_of_another_version_are_not_believed() -> None:
    def other(asked: str, sent: Mapping[str, bytes], threads: int | None) -> str:
        told = json.loads(nothing(asked, sent, threads))
        return json.dumps({**told, "identity": {**told["identity"], "numpy": "1.0"}})

    with pytest.raises(UserError, match="a worker has another version, numpy 1.0 there and"):
        swept(Direct(), [task(0)], other)


def test_large_files_are_sent_where_they_are_missing(tmp_path: Path) -> None:
    texts, path = Texts(), tmp_path / "table.npy"
    path.write_bytes(bytes(1 << 17))
    file = File("table.npy", texts.add(path), "table.npy", "table.npy")
    known: dict[str, bytes] = {}

    def perform(asked: str, sent: Mapping[str, bytes], threads: int | None) -> str:
        known.update(sent)
        if file.content not in known:
            return json.dumps({"identity": tasks.identity(), "missing": [file.content]})
        return nothing(asked, sent, threads)

    executor, journal = Direct(), Journal(None, {})
    asking = Engine(Pool(executor, lambda: 1), texts, journal, perform)
    asking.ask([task(0, [file]), task(1, [file])], Deadline())
    assert len(journal.answers) == 2 and known[file.content] == bytes(1 << 17)
    path.write_bytes(bytes(1 << 18))
    known.clear()
    with pytest.raises(UserError, match="was changed while its model was checked"):
        asking.ask([task(2, [file])], Deadline())


def test_after_the_limit_nothing_is_begun() -> None:
    executor, journal = Direct(), Journal(None, {})
    Engine(Pool(executor, lambda: 2), Texts(), journal, nothing).ask([task(0)], Deadline(-1.0))
    assert not executor.asked and not journal.answers


def test_what_goes_on_after_the_limit_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    class Never(Direct):
        def submit(self, function: Any, /, *arguments: Any, **more: Any) -> Future[Any]:
            self.asked.append([])
            return Future()

    monkeypatch.setattr(engine, "GRACE", 0.0)
    executor, journal = Never(), Journal(None, {})
    Engine(Pool(executor, lambda: 1), Texts(), journal, nothing).ask([task(0)], Deadline(0.05))
    assert len(executor.asked) == 1 and not journal.answers
