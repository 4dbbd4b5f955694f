"""The same bytes from a Dask cluster of two worker processes, and when one of them is killed."""
from __future__ import annotations

import importlib.util
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Outcome
from sweeps import QUESTION, TASKS, answers, lay, results

from montecarlo_brdf.sweep import pools

needs_dask = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None, reason="distributed is not installed"
)
CLUSTER = [sys.executable, str(Path(__file__).with_name("cluster.py"))]
Command = Callable[..., Outcome]


@pytest.fixture
def cluster() -> Iterator[list[str]]:
    """The scheduler's address, and the workers' process ids."""
    begun = subprocess.Popen(
        CLUSTER, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    assert begun.stdout and begun.stdin
    yield begun.stdout.readline().split()
    begun.stdin.close()
    begun.stdout.close()
    try:
        begun.wait(30)
    finally:
        begun.kill()


@needs_dask
@pytest.mark.parametrize("killed", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_the_same_bytes_from_a_cluster_also_if_a_worker_is_killed(
    killed: bool, cluster: list[str], tmp_path: Path, cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", sys.path[:])
    monkeypatch.chdir(tmp_path)
    lay(tmp_path, pause=0.02)
    truth = results(cli(*QUESTION).out)
    (address, first, _), kept = cluster, tmp_path / "answers.jsonl"
    more = ["--executor", f"dask://{address}", "--results", kept.name]
    command = [sys.executable, "-m", "montecarlo_brdf", *QUESTION, *more]
    asked = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + 60.0
    while killed and time.monotonic() < until and len(answers(kept)) < 2:
        time.sleep(0.01)
    if killed:
        os.kill(int(first), signal.SIGKILL)
        assert len(answers(kept)) < TASKS  # in the middle
    out, err = asked.communicate(timeout=120)
    assert (asked.returncode, "Traceback" in err) == (0, False), err
    assert results(out) == truth


@needs_dask
def test_a_scheduler_that_does_not_answer_is_one_sentence(
    cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pools, "PATIENCE", 0.3)
    outcome = cli("furnace", "--model", "lambert", "--executor", "dask://127.0.0.1:1")
    assert outcome.code == 2
    assert outcome.err == "Error: no Dask scheduler answers at dask://127.0.0.1:1\n"


def test_without_the_package_one_is_told_what_to_install(
    cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    outcome = cli("furnace", "--model", "lambert", "--executor", "dask://127.0.0.1:1")
    assert outcome.code == 2 and "pip install 'montecarlo-brdf[cluster]'" in outcome.err
