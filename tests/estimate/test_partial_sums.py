"""Interrupted sums go on where they were, and end with the bytes of a sum that never stopped."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kernels
import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate import work
from montecarlo_brdf.estimate.partial_sums import PartialSums

MANY = ["furnace", "--model", "ggx", "--theta-o", "40", "--sampler", "cosine", "--points",
        "independent", "--tolerance", "1e-7", "--samples", "2^22", "--format", "json"]  # fmt: skip


def job(seed: int = 5, samples: int = 3 * work.CHUNK + 1000, model: str = "ggx") -> work.Job:
    loaded = mb.load(model)
    names = ["albedo_cosine", "albedo_uniform"]
    return kernels.job(loaded, [loaded.parameters()], names, "independent", seed, samples, 2)


class Stopped(Exception):
    """What Ctrl-C is to these tests."""


def stopped_after(calls: int, threads: int) -> str:
    """The file's content when a job was stopped after some of its calls."""
    written: list[str] = []
    sums = PartialSums(written.append)
    seen: list[float] = []

    def progress(done: float) -> None:
        seen.append(done)
        if len(seen) == calls:
            raise Stopped

    with pytest.raises(Stopped):
        work.run(job(), threads, progress, sums)
    sums.write()
    return written[-1]


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("calls", [1, 3, 5, 7])
def test_resumed_is_uninterrupted(calls: int, threads: int) -> None:
    sums, seen = PartialSums(lambda text: None, stopped_after(calls, threads)), list[float]()
    assert work.run(job(), 4 - threads, seen.append, sums) == work.run(job())
    assert len(seen) == 8 - calls and seen[-1] == 1.0  # only what was missing
    seen.clear()
    assert work.run(job(), 1, seen.append, sums) == work.run(job()) and not seen


def test_only_the_same_job_is_resumed() -> None:
    sums = PartialSums(lambda text: None, stopped_after(3, 1))
    assert sums.begun(job()) is not None
    assert sums.begun(job(seed=6)) is None
    assert sums.begun(job(samples=4 * work.CHUNK)) is None
    assert sums.begun(job()._replace(kernel=job(model="beckmann").kernel)) is None


DAMAGE: list[Callable[[str], str]] = [
    lambda t: t[:-20],
    lambda t: t.replace("1", "2", 40),
    lambda t: "{}",
    lambda t: "[" * 10**5,
    lambda t: t + t,
]


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_files_are_refused(damage: Callable[[str], str]) -> None:
    with pytest.raises(UserError, match="does not hold partial sums"):
        PartialSums(lambda text: None, damage(stopped_after(2, 1)))


def test_furnace_resumes(
    cli: Callable[..., Outcome], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    whole = json.loads(cli(*MANY).out)["results"]
    called: list[Any] = []

    def once(job: work.Job, call: work.Call, real: Any = work._call) -> Any:
        called.append(call)
        if len(called) == stop:
            raise KeyboardInterrupt
        return real(job, call)

    monkeypatch.setattr(work, "_call", once)
    file = tmp_path / "sums.json"
    stop = 30
    assert cli(*MANY, "--threads", "1", "--resume", file).code == 130
    before, stop = len(called), 0
    assert json.loads(cli(*MANY, "--resume", file).out)["results"] == whole
    resumed, called[:] = len(called) - before, []
    cli(*MANY, "--samples", "2^22")
    assert before - 1 + resumed - small(called) <= len(called)  # long calls were not made twice


def small(calls: list[Any]) -> int:
    """Calls of jobs so short that nothing of them is kept."""
    return sum(call.count < work.CHUNK for call in calls)


def test_mistakes(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.json"
    wrong.write_text("{}")
    done = cli(*MANY, "--resume", wrong)
    assert done.code == 2 and "cannot resume from" in done.err and wrong.read_text() == "{}"
    assert cli(*MANY, "--resume", tmp_path / "no" / "sums.json").code == 5
