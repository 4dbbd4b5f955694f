"""brdf-check.toml: what it asks for is what runs; mistakes come with line and allowed values."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

from montecarlo_brdf.cli import _requests

GOOD = """\
checks = ["reciprocity"]
theta_o = "0:60:2"
samples = 16384

[[models]]
model = "mine.py"

[[models]]
model = "lambert"
checks = ["reciprocity", "isotropy"]
params = { albedo = [0.2, [0.9, 0.5]] }
tolerances = { isotropy = 1e-3 }
"""
MINE = "def f(wo, wi, p):\n    return 0.25\n"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Path]:
    """Write the file of a project beside its model, and stand in a folder below."""
    (tmp_path / "mine.py").write_text(MINE, encoding="utf-8")
    (tmp_path / "below").mkdir()
    monkeypatch.chdir(tmp_path / "below")

    def write(text: str, name: str = "brdf-check.toml") -> Path:
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def test_requests(project: Callable[[str], Path]) -> None:
    requests = _requests.read(project(GOOD)).requests
    assert [(r.model.name, r.terms.names) for r in requests] == [
        ("../mine.py", ("reciprocity",)),
        ("lambert", ("reciprocity", "isotropy")),
    ]
    assert [r.terms.tolerances for r in requests] == [{}, {"isotropy": 1e-3}]
    assert all(r.terms.theta_o_deg == [0.0, 60.0] for r in requests)
    assert all(r.terms.samples == 16384 for r in requests)
    assert [tuple(p) for p in requests[1].p or ()] == [(0.2,), ((0.9, 0.5),)]
    assert [r.title() for r in requests[1].single()] == [
        "lambert(albedo=0.2)",
        "lambert(albedo=0.9/0.5)",
    ]
    again = _requests.read(project(GOOD), {"seed": 3, "tolerance": 0.5}).requests
    assert again[1].terms.tolerance == 0.5


def test_run_finds_the_file_above(
    project: Callable[[str], Path], cli: Callable[..., Outcome], tmp_path: Path
) -> None:
    project(GOOD)
    done = cli("run", "--format", "json")
    results = json.loads(done.out)["results"]
    assert done.code == 0, done.err
    assert [(r["model"], r["check"]) for r in results] == [
        ("../mine.py", "reciprocity"),
        *[("lambert", "reciprocity"), ("lambert", "isotropy")] * 2,
    ]
    assert results[0]["source"]["line"] == 1


def test_pyproject(project: Callable[..., Path], cli: Callable[..., Outcome]) -> None:
    text = "[project]\nname = 'x'\n[tool.brdf-check]\nchecks = 'reciprocity'\n"
    project(text + "[[tool.brdf-check.models]]\nmodel = 'lambert'\nalbedo = 1\n", "pyproject.toml")
    done = cli("run")
    assert done.code == 2 and "pyproject.toml, line 7" in done.err and "params" in done.err
    project(text.replace("checks", "cheks"), "pyproject.toml")
    assert "line 4: no key of [tool.brdf-check] 'cheks'" in cli("run").err


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ('["reciprocity"]', '["recipocity"]', 1, "did you mean 'reciprocity'"),
        ('["reciprocity"]', "[]", 1, "a list of names"),
        ('"0:60:2"', "[0, 90]", 2, "[0, 90) degrees, not 90"),
        ('"0:60:2"', '"0:60"', 2, "first:last:count"),
        ("16384", "0", 3, "a whole number from 1 to"),
        ("16384", "true", 3, "a whole number from 1 to"),
        ('"mine.py"', '"other.py"', 6, "no model file"),
        ('"mine.py"', "7", 6, "text in quotes"),
        ('"lambert"', '"lamber"', 9, "did you mean 'lambert'"),
        ("albedo =", "albdo =", 11, "choose from albedo"),
        ("[0.9, 0.5]", "1.5", 11, "a number in [0, 1], not '1.5'"),
        ("[0.9, 0.5]", "true", 11, "a number, text as -p takes it"),
        ("{ isotropy", "{ isotropic", 12, "did you mean 'isotropy'"),
        ("1e-3", "2", 12, "a number in [0, 1]"),
        ("params", "parameters", 11, "did you mean 'params'"),
        ("samples", "inconclusive = 'maybe'\nsamples", 3, "choose from pass, fail"),
        ("samples", "points = 'grid'\nsamples", 3, "choose from"),
        ("samples", "max_time = -1\nsamples", 3, "a number of at least"),
        ("[[models]]", "[[model]]", 5, "did you mean 'models'"),
        ("theta_o = ", "theta_o = = ", 2, "not a TOML file"),
    ],
)
def test_mistakes(
    project: Callable[[str], Path],
    cli: Callable[..., Outcome],
    old: str,
    new: str,
    line: int,
    told: str,
) -> None:
    assert old in GOOD
    done = cli("run", "--config", project(GOOD.replace(old, new)))
    assert done.code == 2 and done.out == ""
    assert told in done.err and f"line {line}" in done.err, done.err
    assert done.err.count("\n") == 1


def test_a_model_that_does_not_load(
    project: Callable[[str], Path], cli: Callable[..., Outcome]
) -> None:
    path = project(GOOD)
    (path.parent / "mine.py").write_text("1/0\n", encoding="utf-8")
    done = cli("run")
    assert done.code == 4 and "line 6" in done.err and "ZeroDivisionError" in done.err


def test_nothing_to_run(
    cli: Callable[..., Outcome], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = cli("run")
    assert done.code == 2 and "--model" in done.err and "brdf-check.toml" in done.err
    (tmp_path / "brdf-check.toml").write_text("seed = 1\n", encoding="utf-8")
    assert "[[models]]" in cli("run").err
    (tmp_path / "brdf-check.toml").write_text(GOOD.replace("mine.py", "phong"), encoding="utf-8")
    done = cli("run", "--check", "furnace", "-p", "n=3")
    assert done.code == 2 and done.err.startswith("Error: -p, --check need")


def test_a_pattern_and_a_folder_stand_for_their_models(
    tmp_path: Path, cli: Callable[..., Outcome], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "b").mkdir()
    monkeypatch.chdir(tmp_path / "b")
    monkeypatch.setattr(sys, "path", sys.path[:])
    for name in ("one.py", "two.py"):
        (tmp_path / "b" / name).write_text("def f(wo, wi, p):\n    return 0.1\n")
    (tmp_path / "b" / "broken.py").write_text("def f(:\n")
    checks = 'checks = ["positivity"]\n'
    for model, expected in (("../b", "broken one two"), ("[ot]*.py", "one two")):
        (tmp_path / "b" / "brdf-check.toml").write_text(f'{checks}[[models]]\nmodel = "{model}"\n')
        out = cli("run", "--effort", 0.01, "--format", "json").out
        found = [Path(result["model"]).stem for result in json.loads(out)["results"]]
        assert found == expected.split()
    (tmp_path / "b" / "brdf-check.toml").write_text('[[models]]\nmodel = "no/*.py"\n')
    outcome = cli("run")
    assert outcome.code == 2 and "brdf-check.toml, line 2: no file fits no/*.py" in outcome.err
