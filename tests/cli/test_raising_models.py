"""Models that raise, print or end the process: others are judged, and what happened is told."""

from __future__ import annotations

import importlib.util
import json
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from conftest import Outcome

Command = Callable[..., Outcome]
FINE = "import math\ndef f(wo, wi, p):\n    return 0.5 / math.pi\n"
GRAZING = """
import math
def f(wo, wi, p):
    if wi[2] < 0.01 and wo[2] < 0.2:
        raise ValueError("grazing!")
    return 0.5 / math.pi
"""
WHERE = "raised ValueError (line 5): grazing! at wo = ("
PROJECT = """
checks = ["isotropy", "furnace"]
theta_o = [85]
[[models]]
model = "broken.py"
[[models]]
model = "grazing.py"
[[models]]
model = "fine.py"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "fine.py").write_text(FINE)
    (tmp_path / "grazing.py").write_text(GRAZING)
    (tmp_path / "low.py").write_text(GRAZING.replace("0.01 and wo[2] < 0.2", "0.3"))
    (tmp_path / "broken.py").write_text("def f(wo, wi, p) return 1")
    (tmp_path / "brdf-check.toml").write_text(PROJECT)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_one_raising_model_loses_no_other(folder: Path, cli: Command) -> None:
    outcome = cli("run", "--export", "r.json", "--export", "r.xml")
    assert outcome.code == 4 and outcome.err.count("Error: ") == 2 and WHERE in outcome.err
    report = json.loads((folder / "r.json").read_text())
    verdicts = {(r["model"], r["check"]): r["verdict"] for r in report["results"]}
    assert verdicts[("fine.py", "furnace")] == verdicts[("fine.py", "isotropy")] == "pass"
    assert verdicts[("broken.py", "run")] == verdicts[("grazing.py", "run")] == "error"
    tests = ElementTree.parse(folder / "r.xml").getroot()
    assert len(list(tests.iter("error"))) >= 2 and tests.get("failures") == "0"


def test_models_of_a_list_too(folder: Path, cli: Command) -> None:
    outcome = cli("furnace", "--model", "grazing.py,fine.py", "--theta-o", 85)
    assert outcome.code == 4 and WHERE in outcome.err and "2 pass, 1 error" in outcome.out
    assert "nan" not in outcome.out


#: commands -> what the sentence says of the place
PLACES = {
    "furnace --model grazing.py --theta-o 85": "wi = (",
    "converge --model grazing.py --theta-o 85 --samples 2^12": "wi = (",
    "compare lambert grazing.py --theta-o 85": "wi = (",
    "compare grazing.py lambert --theta-o 85": "wi = (",
    "bench --model grazing.py --theta-o 85 --quick": "wi = (",
    "radiance --model grazing.py --environment constant:1 --theta-o 85": "wi = (",
    "render --model low.py --furnace --size 16 -o r.png": "wi = (",
}


@pytest.mark.parametrize("line", PLACES)
def test_what_was_raised_and_where(line: str, folder: Path, cli: Command) -> None:
    outcome = cli(*line.split())
    assert outcome.code == 4 and outcome.err.count("\n") == 1
    assert WHERE in outcome.err and PLACES[line] in outcome.err


SAMPLE = """
def sample(wo, u, p):
    if u[0] > 0.999999:
        raise ValueError("end")
    return 0.0, 0.0, 1.0
def pdf(wo, wi, p):
    return 1.0
"""


def test_a_sampler_that_raises_at_an_end(folder: Path, cli: Command) -> None:
    (folder / "fine.py").write_text(FINE + SAMPLE)
    outcome = cli("furnace", "--model", "fine.py", "--theta-o", 30)
    assert outcome.code == 4 and "fine.py raised ValueError (line 7): end" in outcome.err
    assert "u = (0.9999999999999999, 0, 0)" in outcome.err


PRINTS = {
    "at the top": "print('hello')\n" + FINE,
    "in f": FINE.replace("    return", "    print('hello')\n    return"),
    "in prepare": FINE + "def prepare(p):\n    print('hello')\n    return (1.0,)\n",
}


@pytest.mark.parametrize(
    "where", [pytest.param(w, marks=[pytest.mark.slow] if w == "in f" else []) for w in PRINTS]
)
def test_what_a_model_prints_is_no_report(where: str, folder: Path, process: Command) -> None:
    (folder / "fine.py").write_text(PRINTS[where])
    line = ("furnace", "--model", "fine.py", "--theta-o", 0, "--samples", 64, "--format", "json")
    outcome = process(*line)
    assert json.loads(outcome.out)["command"] == "furnace" and "hello" in outcome.err


def test_what_numpy_warns_of_is_told_by_verdicts(folder: Path, process: Command) -> None:
    (folder / "fine.py").write_text("def f(wo, wi, p):\n    return 1e300 * 1e300 * (wi[2] - 0.5)\n")
    outcome = process("run", "--model", "fine.py", "--check", "reciprocity,isotropy")
    assert outcome.code in (0, 1, 3) and outcome.err == ""


def test_a_precision_that_needs_a_package(cli: Command) -> None:
    if importlib.util.find_spec("ml_dtypes"):
        pytest.skip("it is installed")
    outcome = cli("stress", "--model", "lambert", "--precision", "bfloat16")
    assert outcome.code == 2 and "bfloat16 needs the package ml_dtypes" in outcome.err


ENDS = {
    "when loaded": "os._exit(0)\n" + FINE,
    "in f": FINE.replace("    return", "    os._exit(0)\n    return"),
}


@pytest.mark.parametrize("text", ENDS.values(), ids=[*ENDS])
def test_a_process_that_is_ended_has_no_verdict(text: str, folder: Path, process: Command) -> None:
    (folder / "fine.py").write_text("import os\n" + text)
    outcome = process("furnace", "--model", "fine.py")
    assert outcome.code == 4 and "ended the process by os._exit(0)" in outcome.err


def test_a_mistake_anywhere_in_a_file_is_no_bug_of_ours(folder: Path, cli: Command) -> None:
    few = "def prepare(p):\n    return FEW.pop()\nFEW = [(1.0,)] * 2\n"
    (folder / "fine.py").write_text(FINE + few)
    outcome = cli("furnace", "--model", "fine.py")
    assert outcome.code == 4 and "IndexError (line 5): pop from empty list" in outcome.err


def test_checks_that_do_not_meet_it_are_told(folder: Path, cli: Command) -> None:
    outcome = cli("run", "--model", "grazing.py", "--theta-o", 0, "--check", "furnace,isotropy")
    assert outcome.code == 4 and "2 pass, 1 error" in outcome.out and WHERE in outcome.err
