"""A sweep gives the same bytes whoever answers: threads, processes, parts on their own machines, a
process that was killed and begun again."""
from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest
from conftest import Outcome
from sweeps import QUESTION, TASKS, answers, lay, results

from montecarlo_brdf.cli import _specs

Command = Callable[..., Outcome]
BEGIN = [sys.executable, "-m", "montecarlo_brdf"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    lay(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", sys.path[:])
    return tmp_path


@pytest.fixture
def truth(folder: Path, cli: Command) -> str:
    """The results without a sweep."""
    outcome = cli(*QUESTION, "--threads", 1)
    assert outcome.code == 0
    return results(outcome.out)


def test_the_same_bytes_by_threads_and_parts(folder: Path, cli: Command, truth: str) -> None:
    for threads in (1, 2):
        outcome = cli(*QUESTION, "--threads", threads, "--executor", "threads")
        assert outcome.code == 0 and results(outcome.out) == truth
    for k in (1, 2, 3):
        cli(*QUESTION, "--shard", f"{k}/3", "--export-json", f"{k}.json")
    whole = cli("merge", "2.json", "3.json", "1.json", "--format", "json")
    assert whole.code == 0 and results(whole.out) == truth
    assert str(folder) not in truth and "sub/two.py" in truth


def test_the_same_bytes_by_processes_and_after_a_kill(folder: Path, truth: str) -> None:
    """A process answers until somebody kills it; two others answer the rest."""
    lay(folder, pause=0.02)
    kept = folder / "answers.jsonl"
    command = [*BEGIN, *QUESTION, "--results", kept.name]
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + 60.0
    while len(answers(kept)) < 2 and time.monotonic() < until:
        time.sleep(0.01)
    first.kill()
    assert first.wait() == -signal.SIGKILL
    before = answers(kept)
    assert 2 <= len(before) < TASKS
    with kept.open("a") as file:
        file.write('{"task": "half a li')
    command += ["--executor", "processes:2"]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=120)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False), done.stderr
    assert results(done.stdout) == truth
    after = kept.read_text()
    assert after.count('"task": ') == TASKS + 1 and after.count("half a li") == 1


def test_run_and_what_does_not_load(folder: Path, cli: Command) -> None:
    (folder / "brdfs" / "broken.py").write_text("def f(:\n")
    question = ["run", "--model", "brdfs/one.py,brdfs/broken.py", "--against", "brdfs/sub/two.py"]
    question += ["--check", "equality,positivity", "--effort", "0.01", "--format", "json"]
    whole, spread = cli(*question), cli(*question, "--executor", "threads")
    assert whole.code == spread.code == 4
    assert results(whole.out) == results(spread.out)


def test_patterns_and_folders(folder: Path, cli: Command, capsys: pytest.CaptureFixture) -> None:
    assert _specs.expanded("brdfs") == ["brdfs/one.py", "brdfs/sub/two.py"]
    assert "no model, without a function f: common.py, sub/common.py" in capsys.readouterr().err
    assert _specs.expanded("brdfs/**/*.py")[:2] == ["brdfs/common.py", "brdfs/one.py"]
    assert _specs.expanded("0.5 lambert + 0.5 ggx") == ["0.5 lambert + 0.5 ggx"]
    os.mkdir("empty")
    for model, sentence in (("empty", "no file of a model in empty"), ("no/*.py", "no file fits")):
        outcome = cli("furnace", "--model", model)
        assert outcome.code == 2 and sentence in outcome.err


@pytest.mark.slow  # processes of their own
def test_ctrl_c_tells_what_was_answered_and_leaves_no_process(folder: Path) -> None:
    lay(folder, pause=0.05)
    kept = folder / "answers.jsonl"
    command = [*BEGIN, *QUESTION, "--executor", "processes:2", "--results", kept.name]
    asked = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    until = time.monotonic() + 60.0
    while not answers(kept) and time.monotonic() < until:
        time.sleep(0.01)
    os.killpg(asked.pid, signal.SIGINT)
    out, err = asked.communicate(timeout=60)
    assert asked.returncode == 130 and "Traceback" not in err, err
    assert 0 < out.count("not answered: interrupted") < TASKS
    with pytest.raises(ProcessLookupError):
        while time.monotonic() < until:
            os.killpg(asked.pid, 0)
            time.sleep(0.1)


@pytest.mark.slow
def test_a_model_that_kills_its_process_is_told_and_the_others_are_answered(
    folder: Path, cli: Command
) -> None:
    path = folder / "brdfs" / "one.py"
    kills = "    if p.a == 0.5:\n        import os\n        os.kill(os.getpid(), 9)\n    return p"
    path.write_text(path.read_text().replace("    return p\n", f"{kills}\n", 1))
    outcome = cli(*QUESTION, "--executor", "processes:2")
    assert outcome.code == 4
    sentence = "the process that was asked ended without an answer, 3 times"
    assert outcome.err.count(sentence) == outcome.out.count(sentence) == 1
    assert outcome.out.count('"verdict": "error"') == 3  # finding, result, report


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--shard", "4/3"], "'4/3' is no part of a whole (write 1/3, 2/3 or 3/3)"),
        (["--shard", "0/3"], "is no part of a whole"),
        (["--shard", "half"], "is no part of a whole"),
        (["--shard", "9/9"], "there are 8 parameter sets: part 9/9 has none"),
        (["--executor", "cluster"], "executor must be threads, processes, processes:COUNT or dask"),
        (["--executor", "processes:0"], "executor must be"),
        (["--executor", "dask://nowhere"],
         "executor must be" if find_spec("distributed") else "'montecarlo-brdf[cluster]'"),
        (["--executor", "threads", "--watch"], "give --watch or --executor, not both"),
        (["--shard", "1/2", "--resume", "x"], "give --resume or --shard, not both"),
        (["--results", "brdfs/one.py"], "cannot write brdfs/one.py: it is read here"),
        (["--results", "other"], "other holds something else than answers"),
        (["--results", "older"], "other versions (numba 0.1 there and "),
    ],
)
def test_wrong_use_is_one_sentence(
    arguments: list[str], sentence: str, folder: Path, cli: Command
) -> None:
    (folder / "other").write_text("a diary\n")
    from montecarlo_brdf.sweep import journal, task

    older = journal.Journal(folder / "older", {**task.identity(), "numba": "0.1"})
    older.close()
    outcome = cli(*QUESTION, *arguments)
    assert outcome.code in (2, 5) and sentence in outcome.err and "Traceback" not in outcome.err
    assert outcome.err.splitlines()[-1].startswith("Error: ")
    assert (folder / "other").read_text() == "a diary\n"
