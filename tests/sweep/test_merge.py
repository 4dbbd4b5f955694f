"""Reports are made one where they belong together, and nowhere else."""
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome
from sweeps import QUESTION, lay

Command = Callable[..., Outcome]


@pytest.fixture
def parts(tmp_path: Path, cli: Command, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    lay(tmp_path)
    monkeypatch.chdir(tmp_path)
    for k in (1, 2):
        assert cli(*QUESTION, "--shard", f"{k}/2", "--export-json", f"{k}.json").code == 0
    return [Path("1.json"), Path("2.json")]


def changed(path: Path, *place: str, to: Any) -> None:
    data = json.loads(path.read_text())
    inner = data
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = to
    path.write_text(json.dumps(data))


def test_what_does_not_belong_together_is_one_sentence(parts: list[Path], cli: Command) -> None:
    def told(*names: Any) -> str:
        outcome = cli("merge", *names)
        assert outcome.code == 2 and outcome.err.count("\n") == 1, outcome
        return outcome.err

    one, two = parts
    whole = two.read_text()
    assert "no report of part 2/2" in told(one)
    assert "1.json and 1.json are both" not in told(one, one)  # the same file, given twice
    Path("copy.json").write_text(one.read_text())
    assert "copy.json and 1.json are both part 1/2" in told(one, "copy.json")
    changed(two, "versions", "numba", to="0.1")
    sentence = told(one, two)
    assert "not of the same versions: numba 0.1 in 2.json and" in sentence
    two.write_text(whole)
    changed(two, "settings", "seed", to=7)
    assert "not of the same settings: seed is 7 in 2.json and 0 in 1.json" in told(one, two)
    two.write_text(whole)
    changed(two, "measured", "sweep", "whole", to="another")
    assert "2.json is a part of another whole than 1.json" in told(one, two)
    two.write_text(whole)
    changed(two, "measured", "sweep", to=None)
    assert "2.json is a whole report, others are parts" in told(one, two)
    two.write_text(whole)
    changed(two, "command", to="run")
    assert "2.json is a report of run and 1.json one of furnace" in told(one, two)
    two.write_text("half")
    assert "2.json is not a report" in told(one, two)


def test_whole_reports_are_put_one_after_another(
    tmp_path: Path, cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    ask = ["furnace", "--model", "lambert", "--theta-o", 0, "--samples", "2^10"]
    for k, more in enumerate(([], ["-p", "albedo=0.3"])):
        cli(*ask, *more, "--export-json", f"{k}.json")
    merged = cli("merge", "0.json", "1.json", "--export-json", "both.json")
    assert merged.code == 0 and merged.out.count("lambert(albedo=") == 2
    over = cli("merge", "0.json", "--export-json", "0.json")
    assert "cannot write 0.json: it is read" in over.err
