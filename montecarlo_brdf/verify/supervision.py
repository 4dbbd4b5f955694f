"""Running a user's code where it can be left: if it takes for ever, limits and Ctrl-C still hold.

The work runs in a thread while the caller waits. A thread that is left gets an exception at its
next line of Python; inside machine code it ends with that call, or with the process.
"""
from __future__ import annotations

import ctypes
import functools
import sys
import threading
import time
from collections.abc import Callable
from typing import Any, Protocol

TICK = 0.1  # seconds; waiting that cannot be interrupted (on Windows) must be short
UNWINDING = 0.25  # seconds: an import that is cut off must be cleared away before others import
STACK = 64 << 20  # bytes: compilers recurse deeply, and some systems give threads little


class Limit(Protocol):
    """Anything that knows when the time is up."""

    def over(self) -> bool:
        """Whether it is."""


class Left(BaseException):
    """Raised inside work that nobody waits for any more."""


class _Work:
    """A function in a thread, with what became of it."""

    def __init__(self, function: Callable[[], Any]) -> None:
        self._function = function
        self.error: BaseException | None = None
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        try:
            self._function()
        except BaseException as error:
            self.error = error
        finally:
            self.ended.set()

    def leave(self) -> None:
        """Have the thread end as soon as it can."""
        _hush()
        identity = ctypes.c_ulong(self.thread.ident or 0)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(identity, ctypes.py_object(Left))
        self.ended.wait(UNWINDING)


_left: list[_Work] = []


@functools.cache
def _hush() -> None:
    """In a compiler's callback `Left` cannot be raised: Python need not print it either."""
    before = sys.unraisablehook

    def hook(unraisable: Any) -> None:
        if unraisable.exc_type is not Left:
            before(unraisable)

    sys.unraisablehook = hook


def supervised(function: Callable[[], Any], limit: Limit, grace: float = 0.0) -> bool:
    """Run `function`; False if it was left because the limit was over for `grace` seconds.

    Raises what the function raises. KeyboardInterrupt leaves the function at once.
    """
    work = _started(function)
    late: float | None = None
    done = False
    try:
        while not (done := work.ended.wait(TICK)):
            if limit.over():
                late = late or time.monotonic()
                if time.monotonic() - late >= grace:
                    break
    finally:  # also when whoever waits here is interrupted, or left itself
        if not done:
            work.leave()
            _left.append(work)
    if done and work.error:
        raise work.error
    return done


def _started(function: Callable[[], Any]) -> _Work:
    size = threading.stack_size()
    threading.stack_size(STACK)
    try:
        work = _Work(function)
        work.thread.start()
    finally:
        threading.stack_size(size)
    return work


def still_running() -> bool:
    """Whether work that was left still runs: then a process must end without waiting for it."""
    return any(work.thread.is_alive() for work in _left)
