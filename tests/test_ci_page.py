"""docs/ci.md: what it shows is accepted, and what it lists is all there is."""
from __future__ import annotations

import re
from pathlib import Path

import click

from montecarlo_brdf import testing
from montecarlo_brdf.cli import _requests, commands
from montecarlo_brdf.report import formats

PAGE = (Path(__file__).parents[1] / "docs" / "ci.md").read_text(encoding="utf-8")
MINE = """\
from typing import NamedTuple
class Params(NamedTuple):
    alpha: float = 0.1
    f0: float = 1.0
def f(wo, wi, p):
    return 0.1
"""


def block(language: str) -> str:
    found = re.search(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    assert found
    return found[1]


def test_the_file_shown_is_read(tmp_path: Path) -> None:
    (tmp_path / "brdfs").mkdir()
    for name in ("plastic", "my_ggx"):
        (tmp_path / "brdfs" / f"{name}.py").write_text(MINE, encoding="utf-8")
    (tmp_path / "brdf-check.toml").write_text(block("toml"), encoding="utf-8")
    project = _requests.read(tmp_path / "brdf-check.toml")
    assert project.max_time == 300
    assert [len(r.p or ()) for r in project.requests] == [0, 3, 0]
    assert [r.terms.names for r in project.requests] == [None, None, ("furnace", "energy")]
    assert {r.terms.tolerance for r in project.requests} == {None, 1e-2}
    assert all(r.terms.tolerances == {"furnace": 1e-3} for r in project.requests)


def test_all_keys_formats_and_assertions_are_told() -> None:
    for key in (*_requests.SHARED, "model", "params", "against", "max_time", "inconclusive"):
        assert f"`{key}`" in PAGE, key
    for name in formats.SUFFIXES:
        assert f"| `{name}` |" in PAGE, name
    python = block("python")
    compile(python, "docs/ci.md", "exec")
    assert set(re.findall(r"assert_\w+", python)) <= set(testing.__all__)


def test_the_workflow_runs_a_command_that_exists() -> None:
    command = re.search(r"run: brdf-check (\w+) (.*)", block("yaml"))
    assert command and command[1] == "run"
    found = commands.get_command(click.Context(commands), "run")
    assert found
    options = {word for p in found.params for word in p.opts}
    assert set(re.findall(r"--[\w-]+", command[2])) <= options
