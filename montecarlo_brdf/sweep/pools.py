"""Who answers: threads of this process, processes of this machine, or a Dask cluster's, all behind
`concurrent.futures.Executor`."""
from __future__ import annotations

import contextlib
import logging
import multiprocessing
import os
import re
import signal
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import (
    BrokenExecutor,
    CancelledError,
    Executor,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from multiprocessing.process import BaseProcess
from multiprocessing.util import _run_finalizers  # type: ignore[attr-defined]
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.verify.question import all_threads

THREADS, PROCESSES, DASK = "threads", "processes", "dask://"
ALLOWED = "threads, processes, processes:COUNT or dask://HOST:PORT"
PATIENCE = 10.0  # seconds that a scheduler may take to answer
LASTS = 5.0  # seconds for which the number of its workers is taken for known
EXTRA = "montecarlo-brdf[cluster]"


class Pool(NamedTuple):
    """An executor, and what one must know of its workers."""

    executor: Executor
    width: Callable[[], int]  # how many workers there are now
    threads: int | None = 1  # of each; None for all of the machine
    deaths: tuple[type[BaseException], ...] = (BrokenExecutor,)  # a worker has ended
    lost: tuple[type[BaseException], ...] = (CancelledError,)  # all have
    renewed: Callable[[], Executor] | None = None  # another executor after a death


@contextlib.contextmanager
def pool(said: str, threads: int | None) -> Iterator[Pool]:
    """The workers that --executor names. threads: of this process, where they are its own.

    Raises UserError for a name that stands for none, a scheduler that does not answer."""
    if said == THREADS:
        executor = ThreadPoolExecutor(1)
        try:
            yield Pool(executor, lambda: 1, threads)
        finally:
            executor.shutdown(wait=False, cancel_futures=True)
    elif match := re.fullmatch(rf"{PROCESSES}(?::([1-9]\d{{0,3}}))?", said):
        with _processes(int(match[1] or threads or all_threads())) as made:
            yield made
    elif said.startswith(DASK):
        with _dask(said.removeprefix(DASK)) as made:
            yield made
    else:
        raise UserError(f"executor must be {ALLOWED}, not {said!r}")


@contextlib.contextmanager
def _processes(count: int) -> Iterator[Pool]:
    made: list[ProcessPoolExecutor] = []

    def another() -> ProcessPoolExecutor:
        spawn = multiprocessing.get_context("spawn")
        made.append(ProcessPoolExecutor(count, mp_context=spawn, initializer=_begun))
        return made[-1]

    try:
        yield Pool(another(), lambda: count, renewed=another)
    finally:  # what they still do is of no use to anybody
        for executor in made:
            for process in [*(executor._processes or {}).values()]:
                process.kill()
            executor.shutdown(cancel_futures=True)
        _run_finalizers(0)  # as at an exit, which `cli` leaves out


def _begun() -> None:
    """In a process: Ctrl-C is its parent's, and it ends with that."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent:
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)


class _Width:
    """How many tasks a cluster can do at once; to ask takes the scheduler's time."""

    def __init__(self, client: Any) -> None:
        self._client, self._known, self._due = client, 0, 0.0

    def __call__(self) -> int:
        if time.monotonic() >= self._due:
            self._known = sum(self._client.nthreads().values())
            self._due = time.monotonic() + (LASTS if self._known else 0.0)
        return self._known


@contextlib.contextmanager
def _dask(address: str) -> Iterator[Pool]:
    try:
        import distributed
    except ImportError:
        needed = f"needs the package distributed: pip install '{EXTRA}'"
        raise UserError(f"--executor {DASK}{address} {needed}") from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL + 1)  # one sentence says it
    if not re.fullmatch(r"[^/\s]+:\d+", address):
        raise UserError(f"executor must be {ALLOWED}, not {DASK + address!r}")
    try:
        client: Any = distributed.Client(f"tcp://{address}", timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        raise UserError(f"no Dask scheduler answers at {DASK}{address}") from error
    try:
        executor = client.get_executor(pure=False)
        lost = (CancelledError, distributed.client.FutureCancelledError)
        yield Pool(executor, _Width(client), deaths=(distributed.KilledWorker,), lost=lost)
    finally:
        with contextlib.suppress(Exception):  # the scheduler may be gone
            client.close(timeout=1.0)
