"""One tolerance for values; laws keep theirs unless they are named."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

Command = Callable[..., Outcome]
ONE_WAY = "def f(wo, wi, p):\n    return 0.3 + 1e-4 * wo[2]\n"


def allowed(outcome: Outcome) -> dict[str, set[float]]:
    results = json.loads(outcome.out)["results"]
    return {r["check"]: {f["tolerance"] for f in r["findings"]} for r in results}


def test_laws_keep_their_tolerance(cli: Command, user_file: Callable[..., Path]) -> None:
    line = ("run", "--model", user_file(ONE_WAY), "--check", "reciprocity,isotropy,energy")
    loose = cli(*line, "--tolerance", 0.01, "--format", "json")
    assert loose.code == 1
    assert allowed(loose) == {"energy": {0.01}, "reciprocity": {1e-6}, "isotropy": {1e-6}}


def test_a_single_check_by_name(cli: Command, user_file: Callable[..., Path]) -> None:
    line = ("run", "--model", user_file(ONE_WAY), "--check", "reciprocity,energy", "--tolerance")
    outcome = cli(*line, "reciprocity=0.01,1e-4", "--format", "json")
    assert outcome.code == 0
    assert allowed(outcome) == {"energy": {1e-4}, "reciprocity": {0.01}}
    failed = cli(*line, "reciprocity=1e-5")
    assert "--tolerance reciprocity=1e-05" in failed.out and failed.code == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("recipocity=0.1", "did you mean 'reciprocity'"),
        ("reciprocity=2", "must be a number in [0, 1)"),
        ("reciprocity=", "is not a number"),
        ("=0.1", "names no check"),
    ],
)
def test_what_is_no_tolerance(text: str, said: str, cli: Command) -> None:
    outcome = cli("run", "--model", "lambert", "--tolerance", text)
    assert outcome.code == 2 and said in outcome.err


def test_a_file_says_the_same(
    cli: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "my.py").write_text(ONE_WAY)
    text = 'tolerance = 0.01\nchecks = ["reciprocity", "energy"]\n[[models]]\nmodel = "my.py"\n'
    (tmp_path / "brdf-check.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    assert allowed(cli("run", "--format", "json")) == {"reciprocity": {1e-6}, "energy": {0.01}}
