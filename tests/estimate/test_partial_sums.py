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
from montecarlo_brdf.estimate.evaluate import CHUNK, Call, Job, run
from montecarlo_brdf.estimate.partial_sums import PartialSums

MANY = ["furnace", "--model", "ggx", "--theta-o", "40", "--sampler", "cosine", "--points",
        "independent", "--tolerance", "1e-7", "--samples", "2^22", "--format", "json"]  # fmt: skip


def job(seed: int = 5, samples: int = 3 * CHUNK + 1000, model: str = "ggx") -> Job:
    loaded = mb.load(model)
    names = ["albedo_cosine", "albedo_uniform"]
    return kernels.job(loaded, [loaded.parameters()], names, "independent", seed, samples, 2)


class Stopped(Exception):
    """What Ctrl-C is to these tests."""


class Counted(PartialSums):
    """Partial sums that know after how many calls they were asked, and stop after some."""

    def __init__(self, content: str = "", stop: int = -1) -> None:
        self.written: list[str] = []
        super().__init__(self.written.append, content)
        self.seen: list[int] = []
        self.stop = stop

    def keep(self, job: Job, calls: int, stacks: Any) -> None:
        super().keep(job, calls, stacks)
        self.seen.append(calls)
        if calls == self.stop:
            raise Stopped


def stopped_after(calls: int, threads: int) -> str:
    """The file's content when a job was stopped after some of its calls."""
    sums = Counted(stop=calls)
    with pytest.raises(Stopped):
        run(job(), threads, sums)
    sums.write()
    return sums.written[-1]


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("calls", [1, 3, 5, 7])
def test_resumed_is_uninterrupted(calls: int, threads: int) -> None:
    sums = Counted(stopped_after(calls, threads))
    assert run(job(), 4 - threads, sums) == run(job())
    assert sums.seen == list(range(calls + 1, 9))  # only what was missing
    sums.seen.clear()
    assert run(job(), 1, sums) == run(job()) and not sums.seen


def test_only_the_same_job_is_resumed() -> None:
    sums = PartialSums(lambda text: None, stopped_after(3, 1))
    assert sums.begun(job()) is not None
    assert sums.begun(job(seed=6)) is None
    assert sums.begun(job(samples=4 * CHUNK)) is None
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

    def once(job: Job, call: Call, real: Any = Job.moments) -> Any:
        called.append(call)
        if len(called) == stop:
            raise KeyboardInterrupt
        return real(job, call)

    monkeypatch.setattr(Job, "moments", once)
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
    return sum(call.count < CHUNK for call in calls)


def test_mistakes(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.json"
    wrong.write_text("{}")
    done = cli(*MANY, "--resume", wrong)
    assert done.code == 2 and "cannot resume from" in done.err and wrong.read_text() == "{}"
    assert cli(*MANY, "--resume", tmp_path / "no" / "sums.json").code == 5
