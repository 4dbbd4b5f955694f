"""The engine: hand tasks to workers a few at a time, keep what they answer, ask again where one
died.

The order of answers shows nowhere: they are kept by task.
"""
from __future__ import annotations

import json
import math
import queue
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from typing import Any, NamedTuple

from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.estimate.plan import Progress
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.sweep import task as tasks
from montecarlo_brdf.sweep import worker
from montecarlo_brdf.sweep.journal import Journal
from montecarlo_brdf.sweep.pools import Pool
from montecarlo_brdf.sweep.task import Task
from montecarlo_brdf.sweep.texts import Texts
from montecarlo_brdf.verify.question import failed
from montecarlo_brdf.verify.supervision import Deadline

AHEAD = 2  # requests a worker has before it, so that it never waits
SPAN = 1.0  # seconds that a request should take at least
HANDING = 6e-3  # seconds that a request takes of whoever hands it out (scripts/scale.py) ...
BUSY = 0.25  # ... who should be busy no more than this share of the time
MOST = 1024  # tasks of a request
TICK = 0.1  # seconds after which Ctrl-C and limits are looked at
GRACE = 1.0  # seconds that tasks may go on after the limit
ATTEMPTS = 3  # of a task whose worker dies each time
Batch = list[Task]


class Request(NamedTuple):
    """Some tasks that a worker has."""

    batch: Batch
    executor: Executor
    alone: bool  # nobody else is asked meanwhile: if the worker dies these tasks did it


Perform = Callable[[str, Mapping[str, bytes], int | None], str]


class Engine:
    """Tasks on their way to a pool of workers."""

    def __init__(
        self, pool: Pool, texts: Texts, journal: Journal, perform: Perform = worker.answered
    ) -> None:
        """perform: what workers do, by its name; another function only measures the engine."""
        self._pool, self._texts, self._journal, self._perform = pool, texts, journal, perform
        self._executor: Executor = pool.executor
        self._waiting: deque[Task] = deque()
        self._suspects: deque[Batch] = deque()  # their worker died: asked alone
        self._attempts: dict[str, int] = {}
        self._running: dict[Future[str], Request] = {}
        self._ended: queue.SimpleQueue[Future[str]] = queue.SimpleQueue()
        self._mean: float | None = None  # seconds of a task

    def ask(
        self, todo: Sequence[Task], limit: Deadline, progress: Progress | None = None
    ) -> None:
        """Ask all tasks that the journal has no answer to, and keep the answers in it; those that
        are not answered GRACE seconds after the limit are left.

        Raises UserError where workers are of other versions, or all of them are lost.
        """
        left = {task.key: task for task in todo if task.key not in self._journal.answers}
        self._waiting.extend(left.values())
        done, late = len(todo) - len(left), math.inf
        while self._running or ((self._waiting or self._suspects) and not limit.over()):
            if not limit.over():
                self._submit()
            elif (late := min(late, time.monotonic())) + GRACE < time.monotonic():
                return
            try:
                done += self._take(self._ended.get(timeout=TICK))
            except queue.Empty:
                continue
            if progress:
                progress(done / len(todo))

    def _submit(self) -> None:
        """Keep workers busy, or find out which task kills them."""
        if self._suspects:
            if not self._running:
                self._send(self._suspects.popleft(), alone=True)
            return
        room = AHEAD * max(1, self._pool.width()) - len(self._running)
        for _ in range(room):
            if not self._waiting:
                return
            size = min(self._size(), len(self._waiting))
            self._send([self._waiting.popleft() for _ in range(size)])

    def _size(self) -> int:
        """Tasks of a request: as many as spare whoever hands them out, and fewer towards the end,
        for all workers."""
        if self._mean is None:
            return 1
        width = max(1, self._pool.width())
        span = max(SPAN, HANDING / BUSY * width)
        share = len(self._waiting) // (2 * AHEAD * width)
        return max(1, min(int(span / max(self._mean, 1e-9)), share, MOST))

    def _send(self, batch: Batch, alone: bool = False, large: bool = False) -> None:
        hashes = {file.content for task in batch for file in task.files}
        asked = tasks.written(batch), self._texts.of(hashes, large), self._pool.threads
        try:
            future = self._executor.submit(self._perform, *asked)
        except self._pool.deaths:  # while nothing was asked
            self._renew(self._executor)
            future = self._executor.submit(self._perform, *asked)
        self._running[future] = Request(batch, self._executor, alone)
        future.add_done_callback(self._ended.put)

    def _take(self, future: Future[str]) -> int:
        """Keep what was answered; how many tasks are done with."""
        request = self._running.pop(future)
        batch = request.batch
        try:
            told = json.loads(future.result())
        except self._pool.deaths:
            self._renew(request.executor)
            return self._died(request)
        except self._pool.lost as error:
            kept = "what they answered is kept where --results says: begin again with the same"
            raise UserError(f"the workers were lost; {kept}") from error
        if other := tasks.difference(tasks.identity(), told["identity"]):
            raise UserError(f"a worker has another version, {other}: results would be a mixture")
        if "missing" in told:
            self._send(batch, request.alone, large=True)
            return 0
        for task, answer in zip(batch, told["answers"], strict=True):
            if "refused" in answer:
                raise UserError(answer["refused"])
            self._journal.add(task.key, answer)
        spent = sum(answer["seconds"] for answer in told["answers"]) / len(batch)
        self._mean = spent if self._mean is None else 0.5 * (self._mean + spent)
        return len(batch)

    def _renew(self, executor: Executor) -> None:
        """After a death; all requests to one executor end with it, another is needed once."""
        if self._pool.renewed and executor is self._executor:
            self._executor = self._pool.renewed()

    def _died(self, request: Request) -> int:
        """Ask again, alone; then by halves, until it is known which task did it. That is given up
        when its worker died again and again."""
        batch = request.batch
        if not request.alone:
            self._suspects.append(batch)
            return 0
        if len(batch) > 1:
            self._suspects.extend((batch[: len(batch) // 2], batch[len(batch) // 2 :]))
            return 0
        (task,) = batch
        self._attempts[task.key] = self._attempts.get(task.key, 0) + 1
        if self._attempts[task.key] < ATTEMPTS:
            self._suspects.append(batch)
            return 0
        sentence = f"the process that was asked ended without an answer, {ATTEMPTS} times"
        error = ModelError(sentence)
        self._journal.answers[task.key] = plain(failed(task.command, task.name, error))
        return 1


def plain(report: Report) -> dict[str, Any]:
    """A report made here as a worker would answer it."""
    results = report.to_dict()["results"]
    return {"settings": report.settings, "results": results, "times": [0.0] * len(results),
            "seconds": 0.0}  # fmt: skip
