"""Partial sums of long jobs in a file, so that billions of samples survive an interruption.

A job is cut into calls whose states merge in a fixed order (`evaluate`): how many calls are done,
and the states they have merged into, are all that a later run needs to end with the same bytes. A
job is found again by the hash of everything it depends on, its kernel's machine code included; sums
of another model, seed or version are never mixed in.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.statistics import Moments

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.evaluate import Job

FORMAT = "brdf-check partial sums 1"
EVERY = 10.0  # seconds between two writes
Stacks = list[list[list[tuple[int, Moments]]]]  # [result][replicate]: (rank, moments)


class PartialSums:
    """The partial sums of the jobs of a run; `save` is called with the file's new content."""

    def __init__(self, save: Callable[[str], None], content: str = "") -> None:
        """Raises UserError if `content` is anything but what was saved, or empty."""
        self._save = save
        self._jobs: dict[str, Any] = _read(content) if content else {}
        self._written = time.monotonic()

    def begun(self, job: Job) -> tuple[int, Stacks] | None:
        """How many calls of a job are done, and the states that they have merged into."""
        found = self._jobs.get(digest(job))
        if found is None:
            return None
        calls, stacks = found
        return calls, [[[(k, Moments(*m)) for k, m in s] for s in row] for row in stacks]

    def keep(self, job: Job, calls: int, stacks: Stacks) -> None:
        """Remember where a job stands; from time to time, write it down."""
        self._jobs[digest(job)] = calls, [[tuple(stack) for stack in row] for row in stacks]
        if time.monotonic() - self._written > EVERY:
            self.write()

    def write(self) -> None:
        """Write everything down."""
        jobs = json.dumps(self._jobs)
        head = {"format": FORMAT, "digest": _hash(jobs)}
        self._save(f"{json.dumps(head)}\n{jobs}\n")
        self._written = time.monotonic()


def digest(job: Job) -> str:
    """Hash of everything that the states of a job depend on."""
    return _hash(repr((job.kernel.key, tuple(job.reals), *job[2:])))


def _read(content: str) -> dict[str, Any]:
    try:
        first, jobs = content.splitlines()
        if json.loads(first) == {"format": FORMAT, "digest": _hash(jobs)}:
            return dict(json.loads(jobs))
    except (ValueError, RecursionError):
        pass
    raise UserError("it does not hold partial sums of this version, or it is damaged")


def _hash(text: str) -> str:
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()
