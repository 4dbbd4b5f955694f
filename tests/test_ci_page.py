"""docs/ci.md: what it shows is accepted, and what it lists is all there is."""
from __future__ import annotations

import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import click
import pytest

from montecarlo_brdf import testing
from montecarlo_brdf.cli import _requests, commands
from montecarlo_brdf.report import formats

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
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


def steps_of_the_action() -> str:
    """What the action runs."""
    text = (ROOT / "action.yml").read_text(encoding="utf-8")
    found = re.search(r"      run: \|\n((?:        .*\n)+)", text)
    assert found
    return textwrap.dedent(found[1])


@pytest.mark.skipif(os.name == "nt", reason="needs bash")
def test_the_steps_of_the_action_run(tmp_path: Path) -> None:
    command = tmp_path / "brdf-check"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m montecarlo_brdf "$@"\n')
    command.chmod(0o755)
    project = 'checks = ["isotropy"]\n[[models]]\nmodel = "lambert"\n'
    (tmp_path / "my checks.toml").write_text(project, encoding="utf-8")
    there = {"CONFIG": "my checks.toml", "ARGUMENTS": "--max-time 100 --seed 3",
             "REPORTS": str(tmp_path / "all reports")}  # fmt: skip
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", steps_of_the_action()], cwd=tmp_path, timeout=120,
        env={**os.environ, **there, "PATH": path}, capture_output=True, encoding="utf-8",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    written = {p.name for p in (tmp_path / "all reports").iterdir()}
    assert written == {"report.html", "report.json", "report.sarif", "junit.xml"}


def test_the_hook_names_options_that_exist() -> None:
    text = (ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8")
    entry = re.search(r"entry: brdf-check (\w+) (.*)", text)
    assert entry
    found = commands.get_command(click.Context(commands), entry[1])
    assert found
    options = {word for p in found.params for word in p.opts}
    assert set(re.findall(r"--[\w-]+", entry[2])) <= options
