"""Cutting work on arrays into kernel calls that are short: Ctrl-C and time limits wait for one."""
from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

LONGEST = 0.05  # seconds that a call should take at most
FIRST = 64  # items of the first call, as long as nothing is known


def pieces(kernel: Any, n: int) -> Iterator[tuple[int, int]]:
    """(start, count) of each call; as many items as the pace of the call before allows.

    How the work is cut never shows in results: every item is computed alone.
    """
    start = 0
    while start < n:
        pace = getattr(kernel, "item_pace", LONGEST / FIRST)
        count = min(n - start, max(1, int(LONGEST / pace)))
        began = time.perf_counter()
        yield start, count
        kernel.item_pace = max((time.perf_counter() - began) / count, 1e-9)
        start += count
