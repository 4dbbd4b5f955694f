"""Nothing is written over what was read, nor under a name that says something else."""

from __future__ import annotations

import json
import shlex
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

Command = Callable[..., Outcome]
MODEL = "import math\ndef f(wo, wi, p):\n    return 0.5 / math.pi\n"
PROJECT = '[[models]]\nmodel = "my.py"\nchecks = ["isotropy"]\n'
SCENE = """
[surface]
model = "lambert"
[environment]
kind = "image"
file = "sky.npy"
[view]
theta_o_deg = [30]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """One of every kind of file that a command reads."""
    import numpy as np

    (tmp_path / "my.py").write_text(MODEL)
    (tmp_path / "brdf-check.toml").write_text(PROJECT)
    (tmp_path / "scene.toml").write_text(SCENE)
    np.save(tmp_path / "sky.npy", np.ones((4, 8, 3)))
    monkeypatch.chdir(tmp_path)
    return tmp_path


#: command line -> the file that it must leave alone
OVER = {
    "furnace --model my.py --theta-o 0 --export-json my.py": "my.py",
    "compare my.py lambert --export-json my.py": "my.py",
    "bench --model my.py --quick --export my.py": "my.py",
    "furnace --model my.py --theta-o 0 --resume my.py": "my.py",
    "run --export-json brdf-check.toml": "brdf-check.toml",
    "run --baseline old.json --export old.json": "old.json",
    "run --baseline old.json --export-json ./link.json": "old.json",
    "plot old.svg -o old.svg": "old.svg",
    "render scene.toml --size 8 -o sky.npy": "sky.npy",
}  # fmt: skip


@pytest.mark.parametrize("line", OVER)
def test_an_input_is_not_overwritten(line: str, folder: Path, cli: Command) -> None:
    assert cli("run", "--export", "old.json").code == 0
    (folder / "link.json").symlink_to("old.json")
    shutil.copy("old.json", "old.svg")
    before = (folder / OVER[line]).read_bytes()
    outcome = cli(*shlex.split(line))
    assert outcome.code == 2 and outcome.err.startswith("Error: cannot ")
    assert outcome.err.count("\n") == 1 and (folder / OVER[line]).read_bytes() == before


def test_an_output_may_be_written_again(folder: Path, cli: Command) -> None:
    for _ in range(2):
        assert cli("run", "--export", "new.json").code == 0
    assert cli("run", "--baseline", "new.json", "--export", "newer.json").code == 0


WRONG = {
    "furnace --model lambert --export-json a.xml": "name must end in .json",
    "furnace --model lambert --plot x.jpg": "cannot draw x.jpg: the name must end in",
    "render --model lambert --furnace -o x.bmp": "cannot draw x.bmp: the name must end in",
    "bench --model lambert --export a.png": "name must end in .json",
    "furnace --model lambert --export-json ''": "the name of a file is needed",
    "furnace --model lambert --export ''": "the name of a file is needed",
    "furnace --model lambert --plot ''": "the name of a file is needed",
    "run --config ''": "the name of a file is needed",
}


@pytest.mark.parametrize("line", WRONG)
def test_a_name_that_cannot_be_meant(line: str, folder: Path, cli: Command) -> None:
    outcome = cli(*shlex.split(line))
    assert outcome.code == 2 and WRONG[line] in outcome.err and not outcome.out
    assert not list(folder.glob("*.jpg")) + list(folder.glob("*.bmp"))


def test_a_byte_order_mark_says_nothing(folder: Path, cli: Command) -> None:
    text = (folder / "brdf-check.toml").read_text()
    (folder / "brdf-check.toml").write_text(text, encoding="utf-8-sig")
    outcome = cli("run", "--format", "json")
    assert outcome.code == 0 and json.loads(outcome.out)["verdict"] == "pass"
