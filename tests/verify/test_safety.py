"""Models that take for ever: limits hold, Ctrl-C holds, and what was found is not lost."""

from __future__ import annotations

import functools
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf import checks, load
from montecarlo_brdf.compile.bind import bound
from montecarlo_brdf.compile.kernel import Kernel
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import evaluate
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.moments import BLOCK
from montecarlo_brdf.verify import question
from montecarlo_brdf.verify.supervision import Deadline, left_behind, supervised

NEVER = "def f(wo, wi, p):\n    while True:\n        pass\n"
SLEEPS = "import time\ndef f(wo, wi, p):\n    time.sleep(10)\n    return 0.3\n"
#: returns for ordinary directions, never near the horizon: only machine code gets stuck
STUCK = """\
def f(wo, wi, p):
    x = 1.0
    while wi[2] < 0.05 and x > 0.0:
        x = x + wi[0] * wi[0] + 1e-3
    return 0.3
"""
#: about 0.1 ms per evaluation
SLOW = """\
import math
def f(wo, wi, p):
    x = wi[2]
    for k in range(30000):
        x = math.sqrt(x * x + 1e-300)
    return 0.3 + 0.0 * x
"""
#: seconds of patience with busy machines; limits of the program itself are stated where they are
PATIENCE = 20.0


def endless() -> None:
    while True:
        pass


def test_work_that_ends() -> None:
    done: list[int] = []
    assert supervised(lambda: done.append(1), Deadline(60.0)) and done == [1]
    with pytest.raises(ModelError, match="mine"):
        supervised(lambda: (_ for _ in ()).throw(ModelError("mine")), Deadline(60.0))


def test_work_that_does_not_end_is_ended() -> None:
    before = threading.active_count()
    nested = lambda: supervised(endless, Deadline(60.0))  # noqa: E731
    assert not supervised(endless, Deadline(0.1)) and not supervised(nested, Deadline(0.1))
    until = time.monotonic() + PATIENCE
    while threading.active_count() > before and time.monotonic() < until:
        time.sleep(0.05)
    assert threading.active_count() == before


def test_work_in_several_threads() -> None:
    """Each does its part; what one of them raises ends them all."""
    before, rest, done = threading.active_count(), iter(range(1000)), []
    assert supervised(lambda: done.extend(rest), Deadline(60.0), threads=3)
    assert sorted(done) == list(range(1000))
    assert not supervised(endless, Deadline(0.1), threads=2)
    turns = iter([endless, functools.partial(next, iter(()))])
    with pytest.raises(StopIteration):
        supervised(lambda: next(turns)(), Deadline(60.0), threads=2)
    until = time.monotonic() + PATIENCE
    while threading.active_count() > before and time.monotonic() < until:
        time.sleep(0.05)
    assert threading.active_count() == before


@pytest.mark.parametrize("text", [NEVER, SLEEPS, STUCK], ids=["never", "sleeps", "stuck"])
def test_max_time_holds(
    text: str, process: Callable[..., Outcome], user_file: Any, tmp_path: Path
) -> None:
    report = tmp_path / "report.json"
    model = user_file(text)
    started = time.monotonic()
    done = process("run", "--model", model, "--max-time", "2", "--export-json", report)
    assert time.monotonic() - started < 2.0 + 1.0 + PATIENCE
    assert done.code == 3, done.err
    results = json.loads(report.read_text(encoding="utf-8"))["results"]
    notes = [f["note"] for r in results for f in r["findings"] if f["verdict"] == "inconclusive"]
    assert len(results) >= 10 and any("--max-time was over" in note for note in notes)


def test_the_report_tells_that_the_model_did_not_return(
    cli: Callable[..., Outcome], user_file: Any
) -> None:
    done = cli("run", "--model", user_file(NEVER), "--max-time", "3", "--format", "json")
    notes = {f["note"] for r in json.loads(done.out)["results"] for f in r["findings"]}
    assert done.code == 3 and len(notes) == 1
    assert "--max-time was over before the model returned" in notes.pop()


def test_without_a_limit_a_model_gets_some_seconds(
    cli: Callable[..., Outcome], user_file: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(question, "PATIENCE", 0.3)
    path = user_file(NEVER)
    done = cli("run", "--model", path, "--format", "json")
    assert done.code == 3
    notes = {f["note"] for r in json.loads(done.out)["results"] for f in r["findings"]}
    assert len(notes) == 1 and "did not return from its first few evaluations" in notes.pop()
    done = cli("furnace", "--model", path)
    assert done.code == 3 and "did not return" in done.err and done.err.count("\n") == 1


def interrupted(report: Path, *arguments: object, ready: Callable[[], bool]) -> float:
    """Seconds from Ctrl-C to the end, of a run interrupted once `ready`."""
    command = [sys.executable, "-m", "montecarlo_brdf", "run", *map(str, arguments)]
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    # a job in a shell's background ignores Ctrl-C, and so do all that it starts
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen([*command, "--export-json", str(report)], **quiet) as running:
        until = time.monotonic() + 3.0 * PATIENCE
        while not ready() and time.monotonic() < until:
            time.sleep(0.05)
        time.sleep(0.5)
        running.send_signal(signal.SIGINT)
        started = time.monotonic()
        try:
            _, errors = running.communicate(timeout=3.0 * PATIENCE)
        finally:
            running.kill()
    assert running.returncode == 130 and b"Traceback" not in errors, errors
    return time.monotonic() - started


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
@pytest.mark.parametrize("text", [NEVER, STUCK, SLOW], ids=["never", "stuck", "slow"])
def test_interrupts(text: str, user_file: Any, tmp_path: Path) -> None:
    mark, report = tmp_path / "mark", tmp_path / "report.json"
    begun = f"import pathlib\npathlib.Path({str(mark)!r}).touch()\n"  # runs when it is loaded
    seconds = interrupted(report, "--model", user_file(begun + text), ready=mark.exists)
    assert seconds < 1.0 + PATIENCE / 4.0  # a second, and what a busy machine adds
    found = json.loads(report.read_text(encoding="utf-8"))
    assert found["measured"]["interrupted"] is True and found["verdict"] in ("inconclusive", "fail")
    names = {r["check"] for r in found["results"]}  # "run": a busy machine had not begun yet
    assert names == {"run"} or names >= {"positivity", "furnace", "sampling"}


def test_threads_never_show_in_a_run() -> None:
    """Checks side by side give the same bytes, in the same order, as one after another."""
    one, three = (
        mb.run(mb.load("phong"), samples=1 << 14, threads=t).to_dict()["results"] for t in (1, 3)
    )
    assert len(one) == len(checks.asked(mb.load("phong"))) and json.dumps(three) == json.dumps(one)


def test_cuts_never_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """Calls of any length down to one block give the same bytes."""
    model = load("ggx")
    p = model.parameters(alpha=0.2)

    def bits(seconds: float) -> list[str]:
        monkeypatch.setattr(evaluate, "LONGEST", seconds)
        sizes = (1000, 1 << 14, 48_000, (1 << 18) + 12_345)
        found = [
            directional_albedo(model, p, 45.0, points=points, samples=n, threads=threads)
            for n in sizes
            for points in ("sobol", "independent")
            for threads in (1, 2)
        ]
        return [f"{e.mean.hex()} {e.stderr.hex()}" for e in found]

    whole = bits(60.0)
    assert all(bits(seconds) == whole for seconds in (1e-9, 2e-5, 3e-4))


@pytest.mark.parametrize(
    ("pace", "most"), [(1e-3, BLOCK), (2e-5, 5000), (1e-9, 15_000)]
)
def test_calls_of_a_slow_kernel_are_short(pace: float, most: int) -> None:
    """Whole blocks of one replicate or whole replicates, every sample once."""

    kernel = Kernel(bound(int), "mine")
    kernel.pace = pace
    pieces = list(evaluate.pieces(kernel, 3, 5000))
    assert all(many * size <= most and done % BLOCK == 0 for _, many, done, size in pieces)
    samples = [
        (r, i)
        for skipped, many, done, size in pieces
        for r in range(skipped, skipped + many)
        for i in range(done, done + size)
    ]
    assert samples == [(r, i) for r in range(3) for i in range(5000)]


def test_where_a_file_lies_never_shows(tmp_path: Path) -> None:
    """The same file in another folder gives the same numbers, alone and within a mixture."""
    text = "def f(wo, wi, p):\n    return 0.1 + 0.1 * wi[2]\n"
    found = []
    for folder in (tmp_path / "here", tmp_path / "over_there"):
        folder.mkdir()
        (folder / "tinted.py").write_text(text)
        mixed = f"0.5 {folder / 'tinted.py'} + 0.5 lambert"
        models = (str(folder / "tinted.py"), mixed)
        runs = [mb.furnace(mb.load(m), samples=1 << 12, theta_o_deg=60.0) for m in models]
        runs.append(mb.run(mb.load(models[0]), samples=1 << 12, names=("positivity", "energy")))
        findings = [f for r in runs for result in r.results for f in result.findings]
        found.append([(f.quantity, f.value, f.stderr, f.verdict) for f in findings])
    assert repr(found[0]) == repr(found[1])


def test_code_that_was_left_and_runs_on_is_counted() -> None:
    before, held = left_behind(), threading.Lock()
    with held:
        assert not supervised(held.acquire, Deadline(0.1))  # no line of Python in which to end
        assert left_behind() == before + 1
    until = time.monotonic() + 10.0
    while left_behind() > before and time.monotonic() < until:
        time.sleep(0.01)
    assert left_behind() == before
