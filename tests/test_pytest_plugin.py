"""The pytest plugin, in a project that knows nothing of this one."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path
from xml.etree import ElementTree

import pytest

PLUGIN = "montecarlo_brdf.pytest_plugin"
PROJECT = """\
checks = ["furnace", "limits"]
theta_o = [30]
samples = 16384

[[models]]
model = "src/gain.py"
checks = ["furnace"]

[[models]]
model = "lambert"
params = { albedo = [0.2, 1] }
"""
GAIN = "import math\n\n\ndef f(wo, wi, p):\n    return 1.05 / math.pi\n"


@pytest.fixture
def scratch(tmp_path: Path) -> Path:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "gain.py").write_text(GAIN, encoding="utf-8")
    (tmp_path / "brdf-check.toml").write_text(PROJECT, encoding="utf-8")
    return tmp_path


def pytest_in(folder: Path, *arguments: str) -> tuple[int, str]:
    """Exit code and output of pytest; it names the plugin if the installation does not know it."""
    known = {entry.value for entry in entry_points(group="pytest11")}
    named = [] if PLUGIN in known else ["-p", PLUGIN]
    command = [sys.executable, "-m", "pytest", *named, *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", timeout=120)
    return done.returncode, done.stdout + done.stderr


def test_one_test_per_model_case_and_check(scratch: Path) -> None:
    code, out = pytest_in(scratch, "-rs", "--junitxml=junit.xml", "-W", "error")
    assert code == 1, out
    assert "A <= 1 at theta_o 30°: found 1.05" in out and "Traceback" not in out
    assert "f: src/gain.py:4" in out and "reproduce: brdf-check run --model src/gain.py" in out
    suite = ElementTree.parse(scratch / "junit.xml").getroot()[0]
    names = [case.get("name") for case in suite.iter("testcase")]
    assert names == [
        "src/gain.py furnace",
        *[f"lambert(albedo={a}) {c}" for a in ("0.2", "1") for c in ("furnace", "limits")],
    ]
    assert [suite.get(k) for k in ("failures", "errors")] == ["1", "0"]


def test_a_model_that_does_not_load_is_one_failure_among_others(scratch: Path) -> None:
    (scratch / "src" / "gain.py").write_text("def f(wo, wi, p) return 1\n", encoding="utf-8")
    code, out = pytest_in(scratch, "-W", "error", "-k", "load or 0.2")
    assert code == 1 and "Traceback" not in out, out
    assert "line 1: expected ':'" in out and "1 failed, 2 passed" in out


def test_mistakes_are_sentences(scratch: Path) -> None:
    (scratch / "brdf-check.toml").write_text(PROJECT.replace("furnace", "furnce"), encoding="utf-8")
    code, out = pytest_in(scratch)
    assert code == 2 and "brdf-check.toml, line 1: no check 'furnce'" in out
    assert "Traceback" not in out


def test_other_projects_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text("[project]\nname = 'x'\n", encoding="utf-8")
    (tmp_path / "test_x.py").write_text("def test_x():\n    pass\n", encoding="utf-8")
    code, out = pytest_in(tmp_path, "-q", ".")
    assert code == 0 and "1 passed" in out
