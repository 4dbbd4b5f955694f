"""Every example of every help text runs as it is printed, in a folder with nothing of ours."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import pytest
from conftest import Outcome
from test_model_file import EXACT

from montecarlo_brdf.cli import commands

Command = Callable[..., Outcome]
GGX = "from montecarlo_brdf.models.ggx import Params, domain, f, lobe, pdf, sample\n"
ANISO = """
from typing import NamedTuple
from montecarlo_brdf.models import ggx_anisotropic as theirs
class Params(NamedTuple):
    ax: float = 0.3
    ay: float = 0.1
isotropic = False
def f(wo, wi, p):
    return theirs.f(wo, wi, theirs.Params(p.ax, p.ay, 1.0))
"""
ALPHA = EXACT.replace("albedo: float = 0.8", "albedo: float = 0.5\n    alpha: float = 0.5")
#: what the examples call a user's own
FILES = {
    "my_brdf.py": ALPHA,
    "brdfs/my_brdf.py": ALPHA,
    "my_ggx.py": GGX,
    "my_aniso.py": ANISO,
    "my_fit.py": GGX + "def albedo(cos_theta_o, p):\n    return 0.99\n",
}
#: takes minutes, or never ends: scripts/wheel_examples.py runs these too
LONG = ("--model all", "--watch")


def examples(text: str) -> list[str]:
    """The command lines of a help text, without what is said beside them."""
    lines = [line.strip() for line in text.splitlines()]
    return [re.sub(r"\s{3,}\(.*\)$", "", s) for s in lines if s.startswith("brdf-check ")]


def all_examples() -> Iterator[str]:
    context = click.Context(commands)
    yield from examples(str(commands.epilog))
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command and command.epilog, f"{name} has no example"
        found = examples(command.epilog)
        assert found, f"{name} has no example"
        yield from found


def test_every_command_has_an_example() -> None:
    assert len(list(all_examples())) > 40


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("a folder with blanks")
    for name, text in FILES.items():
        (path / name).parent.mkdir(exist_ok=True)
        (path / name).write_text(text, encoding="utf-8")
    return path


@pytest.mark.slow
@pytest.mark.parametrize("line", dict.fromkeys(all_examples()))
def test_an_example_runs(
    line: str, folder: Path, process: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    if any(words in line for words in LONG):
        pytest.skip("minutes")
    monkeypatch.chdir(folder)
    words = shlex.split(line.partition(" > ")[0])[1:]
    shutil.rmtree("examples", ignore_errors=True)
    if "--copy" not in words:
        process("examples", "--copy", "examples")
    process("init")
    process("furnace", "--model", "lambert", "--theta-o", 0, "--export", "report.json",
            "--export", "furnace.json", "--export", "run.json")  # fmt: skip
    if words[0] == "merge":
        sweep = ("furnace", "--model", "lambert", "-p", "albedo=0.1,0.2,0.3", "--theta-o", 0)
        for k in (1, 2, 3):
            process(*sweep, "--shard", f"{k}/3", "--export-json", f"part{k}.json")
    if words[0] == "plot":
        process("bench", "--model", "lambert", "--quick", "--export", "time.json")
    outcome = process(*words)
    assert outcome.code in (0, 1, 3), outcome.err
