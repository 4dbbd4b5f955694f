"""Running a user's code where it can be left: if it takes for ever, limits and Ctrl-C still hold.

The work runs in a thread while the caller waits. A thread that is left gets an exception at its
next line of Python; inside machine code it ends with that call, or with the process.
"""
from __future__ import annotations

import ctypes
import functools
import math
import sys
import threading
import time
from collections.abc import Callable

TICK = 0.1  # seconds; waiting that cannot be interrupted (on Windows) must be short
UNWINDING = 0.25  # seconds: an import that is cut off must be cleared away before others import
STACK = 64 << 20  # bytes: compilers recurse deeply, and some systems give threads little


class Deadline:
    """A moment after which no new claim is begun."""

    def __init__(self, seconds: float = math.inf) -> None:
        self._end = time.monotonic() + seconds

    def over(self) -> bool:
        """Whether the time is up."""
        return time.monotonic() > self._end


class Left(BaseException):
    """Raised inside work that nobody waits for any more."""


class _Work:
    """A function in a thread that has begun, with what became of it."""

    def __init__(self, function: Callable[[], object]) -> None:
        self._function = function
        self.error: BaseException | None = None
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)
        before = threading.stack_size(STACK)
        try:
            self.thread.start()
        finally:
            threading.stack_size(before)

    def _run(self) -> None:
        try:
            self._function()
        except BaseException as error:
            self.error = error
        finally:
            self.ended.set()

    def leave(self) -> None:
        """Have the thread end at its next line."""
        _hush()
        _left.append(self.thread)
        identity = ctypes.c_ulong(self.thread.ident or 0)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(identity, ctypes.py_object(Left))


_left: list[threading.Thread] = []


def left_behind() -> int:
    """How many threads that nobody waits for still run."""
    _left[:] = [thread for thread in _left if thread.is_alive()]
    return len(_left)


@functools.cache
def _hush() -> None:
    """In a compiler's callback `Left` cannot be raised: Python need not print it either."""
    before = sys.unraisablehook

    def hook(unraisable: sys.UnraisableHookArgs) -> None:
        if unraisable.exc_type is not Left:
            before(unraisable)

    sys.unraisablehook = hook


def supervised(
    function: Callable[[], object], limit: Deadline, grace: float = 0.0, threads: int = 1
) -> bool:
    """Run `function`, in several threads at once if so asked; False if it was left because the
    limit was over for `grace` seconds.

    Raises what the function raises in any thread. KeyboardInterrupt leaves the function at once.
    """
    works = [_Work(function) for _ in range(threads)]
    late: float | None = None
    try:
        while (running := _running(works)) and not any(work.error for work in works):
            if running[0].ended.wait(TICK) or not limit.over():
                continue
            late = late or time.monotonic()
            if time.monotonic() - late >= grace:
                break
        errors = [work.error for work in works if work.error]
    finally:  # also when whoever waits here is interrupted, or left itself
        left = _running(works)
        for work in left:
            work.leave()
        until = time.monotonic() + UNWINDING
        for work in left:
            work.ended.wait(max(0.0, until - time.monotonic()))
    if errors:
        raise errors[0]
    return not left


def _running(works: list[_Work]) -> list[_Work]:
    return [work for work in works if not work.ended.is_set()]
