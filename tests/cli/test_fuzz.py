"""Short fuzzing of everything that reads: the command line, models, reports, scenes, settings.

The long runs are scripts/fuzz.py, which draws from the same strategies.
"""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any

import fuzzed_files
import fuzzing
import pytest
from hypothesis import HealthCheck, given, settings

from montecarlo_brdf.cli import _requests
from montecarlo_brdf.cli import execute as run
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.read import read_scene

QUIET = settings(
    deadline=None,
    max_examples=60,
    derandomize=True,  # the same examples for everyone; scripts/fuzz.py explores
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@QUIET
@given(fuzzing.command_lines())
def test_command_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    assert run(fuzzing.in_folder(arguments, tmp_path)) in fuzzing.ANSWERS


@QUIET
@given(fuzzed_files.model_files())
def test_model_files(tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes) -> None:
    path = tmp_path / "fuzzed.py"
    path.write_bytes(content)
    assert run(["show", str(path)]) in fuzzing.ANSWERS


@settings(QUIET, max_examples=25)
@given(fuzzed_files.reports())
def test_reports(tmp_path: Path, capsys: pytest.CaptureFixture[str], report: Any) -> None:
    path = tmp_path / "report.json"
    path.write_text(report if isinstance(report, str) else json.dumps(report))
    assert run(["plot", str(path), "-o", str(tmp_path / "out.svg")]) in fuzzing.ANSWERS


@settings(QUIET, max_examples=40)
@given(fuzzed_files.scenes())
def test_scenes(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with contextlib.suppress(UserError):
        read_scene(path)


@settings(QUIET, max_examples=40)
@given(fuzzed_files.settings())
def test_settings(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "brdf-check.toml"
    path.write_bytes(content)
    with contextlib.suppress(UserError):
        _requests.read(path)


DEEP = "[surface]\nmodel = 'lambert'\nalbedo = " + "[" * 3000 + "]" * 3000
BARE = '{"schema": 1, "command": "run", "verdict": "pass", "results": [[{}]]}'


def test_what_long_runs_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Recursion in a TOML file; a baseline whose results are none."""
    (tmp_path / "deep.toml").write_text(DEEP)
    (tmp_path / "bare.json").write_text(BARE)
    baseline = ["run", "--model", "lambert", "--check", "isotropy", "--baseline"]
    assert run(["radiance", str(tmp_path / "deep.toml")]) == 2
    assert "nested too deeply" in capsys.readouterr().err
    assert run([*baseline, str(tmp_path / "bare.json")]) == 2
    assert "results are damaged" in capsys.readouterr().err


LONG_NAMES = [
    "show {}",
    "show {}.py",
    "plot r.json -o {}.svg",
    "furnace --model lambert --resume {}",
    "radiance --model lambert --environment image:{}.png",
]


@pytest.mark.parametrize("arguments", LONG_NAMES)
def test_names_that_no_file_can_have(capsys: pytest.CaptureFixture[str], arguments: str) -> None:
    """They were looked for, and the system's complaint was taken for one about stdout."""
    assert run(arguments.format("a" * 300).split()) in (2, 5)
    assert "stdout" not in capsys.readouterr().err


def test_mixtures_longer_than_a_file_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["show", " + ".join(["0.01 lambert"] * 40)]) == 0
