"""The progress bar: one for all threads, none without stderr."""

from __future__ import annotations

import concurrent.futures
import sys
import time
from types import SimpleNamespace

import pytest

from montecarlo_brdf.cli import _progress


def test_checks_side_by_side_share_a_progress_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second of two that came at once found a bar without a task."""
    monkeypatch.setattr(_progress, "PATIENCE", 0.0)
    terminal = SimpleNamespace(isatty=lambda: True, write=lambda text: len(text), flush=lambda: 0)
    monkeypatch.setattr(sys, "stderr", terminal)
    import rich.progress

    slow = rich.progress.Progress.add_task

    def add_task(self: rich.progress.Progress, *given: object, **named: object) -> object:
        time.sleep(0.05)
        return slow(self, *given, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(rich.progress.Progress, "add_task", add_task)
    with _progress.progress("test") as update, concurrent.futures.ThreadPoolExecutor(4) as pool:
        for done in [pool.submit(update, 0.1 * k) for k in range(8)]:
            done.result()


def test_no_progress_without_stderr(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_progress, "PATIENCE", 0.0)
    monkeypatch.setattr(sys, "stderr", None)
    with _progress.progress("test") as update:
        update(0.5)
