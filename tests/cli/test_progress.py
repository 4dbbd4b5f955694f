"""The progress bar: one for all threads, as wide as the terminal, none without stderr."""

from __future__ import annotations

import concurrent.futures
import sys
import time
from types import SimpleNamespace

import pytest

from montecarlo_brdf.cli import _live, _terminal
from montecarlo_brdf.compile import kernel


@pytest.fixture(autouse=True)
def heard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BRDF_CHECK_QUIET")


def test_checks_side_by_side_share_a_progress_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second of two that came at once found a bar without a task."""
    monkeypatch.setattr(_terminal, "PATIENCE", 0.0)
    monkeypatch.setattr(_terminal, "INTERVAL", 0.0)
    monkeypatch.setenv("TERM", "xterm")
    written: list[str] = []

    def write(text: str) -> int:
        before = len(written)
        time.sleep(0.01)
        assert len(written) == before  # nobody else wrote meanwhile
        written.append(text)
        return len(text)

    terminal = SimpleNamespace(isatty=lambda: True, write=write, flush=lambda: 0)
    monkeypatch.setattr(sys, "stderr", terminal)
    with _terminal.progress("test") as update, concurrent.futures.ThreadPoolExecutor(4) as pool:
        for done in [pool.submit(update, 0.1 * k) for k in range(8)]:
            done.result()
    assert len(written) > 1 and written[-1] == _live.ERASE
    assert all(text.startswith(_live.ERASE) for text in written)


def test_a_progress_bar_is_no_wider_than_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    assert " 25% 9 s left" in _terminal.line("furnace", 0.25, 3.0)
    monkeypatch.setenv("COLUMNS", "20")
    assert len(_terminal.line("furnace", 0.25, 3.0)) < 20


def test_no_progress_without_stderr(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_terminal, "PATIENCE", 0.0)
    monkeypatch.setattr(sys, "stderr", None)
    with _terminal.progress("test") as update:
        update(0.5)


def test_one_is_told_while_a_model_is_compiled(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(_terminal, "LONG", 0.01)
    for quiet in ("", "1"):
        monkeypatch.setenv("BRDF_CHECK_QUIET", quiet)
        with _terminal.progress("test"):
            for hear in kernel.listeners:
                hear("my.py")
            time.sleep(0.1)
        told = capsys.readouterr().err
        assert ("compiling my.py, first time: " in told) == (not quiet)
        assert not kernel.listeners
