"""Cutting work on arrays into kernel calls that are short: Ctrl-C and time limits wait for one."""
from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

LONGEST = 0.05  # seconds that a call should take at most
FIRST = 64  # evaluations of the first call, as long as nothing is known


def pieces(kernel: Any, n: int, each: int = 1) -> Iterator[tuple[int, int]]:
    """(start, count) of each call over n items of `each` evaluations; as many items as the pace of
    the call before allows.

    How the work is cut never shows in results: every item is computed alone.
    """
    start = 0
    while start < n:
        pace = each * getattr(kernel, "evaluation_pace", LONGEST / FIRST)
        count = min(n - start, max(1, int(LONGEST / pace)))
        began = time.perf_counter()
        yield start, count
        kernel.evaluation_pace = max((time.perf_counter() - began) / (count * each), 1e-10)
        start += count
