"""What programs read: the schema holds for every report, SARIF for its readers, times in JUnit."""

from __future__ import annotations

import json
import os
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from conftest import Outcome

from montecarlo_brdf import loading
from montecarlo_brdf.judge.finding import Bound, Command, Finding, Report, Result, Verdict
from montecarlo_brdf.report import formats

jsonschema = pytest.importorskip("jsonschema")
ROOT = Path(__file__).parents[2]
Call = Callable[..., Outcome]
RAISES = "def f(wo, wi, p):\n    if wi[2] < 0.4:\n        raise ValueError('low')\n    return 0.1\n"

#: commands of every kind, and the exit codes that they may have
LINES = {
    "furnace --model lambert_unnormalised -p c=0.5 --theta-o 0,60": 1,
    "run --model raises.py,lambert --check furnace,isotropy --theta-o 0": 4,
    "run --model lambert --max-time 0.0001": 3,
    "identities": 0,
    "converge --model lambert --sampler cosine --points sobol": 0,
    "compare lambert lambert -p albedo=0.5/0.2 --theta-o 0": 0,
    "radiance --model lambert --environment cosine:2 --theta-o 0": 0,
    "stress --model lambert --quick": 0,
}


@pytest.fixture
def schema(cli: Call) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(cli("schema").out)
    jsonschema.Draft202012Validator.check_schema(found)
    return found


@pytest.mark.parametrize("line", LINES)
def test_reports_follow_the_schema(
    line: str, schema: dict[str, Any], cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("raises.py").write_text(RAISES)
    outcome = cli(*line.split(), "--format", "json")
    assert outcome.code == LINES[line], outcome.err
    jsonschema.validate(json.loads(outcome.out), schema)


DAMAGES: list[Callable[[dict[str, Any]], object]] = [
    lambda r: r.pop("verdict"),
    lambda r: r.update(schema=0),
    lambda r: r["results"][0].update(verdict="perhaps"),
    lambda r: r["results"][0]["findings"][0].pop("quantity"),
    lambda r: r["results"][0]["findings"][0].update(value="much"),
]


@pytest.mark.parametrize("damage", DAMAGES)
def test_the_schema_sees_what_is_no_report(
    damage: Callable[[dict[str, Any]], object], schema: dict[str, Any], cli: Call
) -> None:
    line = ("furnace", "--model", "lambert", "--theta-o", 0)
    report = json.loads(cli(*line, "--format", "json").out)
    damage(report)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(report, schema)


def failing(verdict: Verdict) -> Finding:
    return Finding("A <= 1", {}, verdict, Bound.AT_MOST, 1.5, 0.0, 1.0, 1e-5, samples=4, hint="pi")


def sarif_rows() -> list[Result]:
    source = {"file": "my brdf.py", "line": 3, "functions": {"f": 3, "sample": 9}}
    return [
        Result("my brdf.py", {}, "energy", [failing(Verdict.FAIL)] * 3, [], source),
        Result("my brdf.py", {}, "sampling", [failing(Verdict.KNOWN)], [], source),
        Result("ggx", {}, "furnace", [failing(Verdict.PASS)]),
        Result("", {}, "identities", [failing(Verdict.INCONCLUSIVE)]),
        Result("/a b/<x>.py", {}, "load", [failing(Verdict.ERROR)], [],
               {"file": "/a b/<x>.py", "line": 0}),
    ]  # fmt: skip


def test_sarif() -> None:
    found = json.loads(formats.render(Report(Command.RUN, {}, sarif_rows()), "sarif"))
    (run,) = found["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert found["version"] == "2.1.0" and run["tool"]["driver"]["name"] == "brdf-check"
    assert [r["level"] for r in run["results"]] == ["error", "note", "warning", "error"]
    assert all(rules[r["ruleIndex"]]["id"] == r["ruleId"] for r in run["results"])
    places = [r["locations"][0]["physicalLocation"] for r in run["results"] if "locations" in r]
    assert [p["region"]["startLine"] for p in places] == [3, 9, 1]
    uris = [p["artifactLocation"]["uri"] for p in places]
    assert uris == ["my%20brdf.py", "my%20brdf.py", "file:///a%20b/%3Cx%3E.py"]
    assert "A <= 1: found 1.5(0)" in run["results"][0]["message"]["text"]


#: sarif-schema-2.1.0.json of github.com/oasis-tcs/sarif-spec, which is not ours to copy
OFFICIAL = os.environ.get("SARIF_SCHEMA", "")


@pytest.mark.skipif(not OFFICIAL, reason="SARIF_SCHEMA names no sarif-schema-2.1.0.json")
def test_sarif_follows_the_official_schema() -> None:
    official = json.loads(Path(OFFICIAL).read_text(encoding="utf-8"))
    asked = jsonschema.validators.validator_for(official)
    validator = asked(official, format_checker=asked.FORMAT_CHECKER)
    for rows in (sarif_rows(), []):
        found = json.loads(formats.render(Report(Command.RUN, {}, rows), "sarif"))
        validator.validate(found)
        found["runs"][0]["tool"]["driver"].pop("name")
        assert not validator.is_valid(found)


def test_junit_tells_how_long_it_took(cli: Call) -> None:
    out = cli("run", "--model", "lambert", "--check", "furnace,energy", "--format", "junit").out
    root = ElementTree.fromstring(out)
    (suite,) = root
    cases = [float(test.get("time", "")) for test in suite.iter("testcase")]
    assert sum(cases) > 0.0 and float(root.get("time", "")) > 0.0
    assert sum(cases) == pytest.approx(float(suite.get("time", "")), abs=1e-3 * len(cases))


def test_models_for_programs(cli: Call) -> None:
    found = {m["name"]: m for m in json.loads(cli("models", "--format", "json").out)}
    assert [*found] == loading.names()
    assert found["lambert"]["parameters"]["albedo"] == {"default": 0.8, "domain": [0.0, 1.0]}
    assert json.loads(cli("show", "phong", "--format", "json").out) == found["phong"]
    assert found["blinn_phong"]["choices"]["norm"]["picked"] == "n+2"
    shown = cli("models").out.splitlines()
    assert all(any(name in line.split() for line in shown) for name in loading.names())


def test_quiet_leaves_the_verdict(cli: Call) -> None:
    out = cli("furnace", "--model", "lambert", "--theta-o", 0, "--quiet").out
    assert out.count("\n") == 1 and out.startswith("PASS  2 pass")


def test_doctor(cli: Call, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    outcome = cli("doctor")
    for name in ("numba", "python", "processor", "threads", "cache", "mpmath"):
        assert any(line.startswith(f"{name} ") for line in outcome.out.splitlines()), name
    (tmp_path / "file").touch()
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path / "file" / "cache"))
    assert "cannot be written" in cli("doctor").out
    warned = cli("furnace", "--model", "lambert", "--theta-o", 0)
    assert warned.code == 0 and warned.err.startswith("Warning: cannot write to ")


def test_examples_are_there(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert "cook_torrance.toml" in cli("examples").out
    assert cli("examples", "--copy", "examples").code == 0
    scene = ("radiance", "examples/lambert.toml", "--theta-o", 0)
    assert cli(*scene).code == 0
    again = cli("examples", "--copy", "examples")
    assert again.code == 2 and "lambert.toml" in again.err


def test_pages_are_there(cli: Call) -> None:
    listed = [line.split()[0] for line in cli("docs").out.splitlines()]
    assert listed == sorted(p.stem for p in (ROOT / "docs").glob("*.md"))
    shipped = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    wheel = shipped["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    assert {*wheel} == {"docs", "examples"}
    assert cli("docs", "tutorial").out.startswith("# From 1/")
    assert "did you mean 'scenes'" in cli("docs", "scene").err
    printed = cli("docs", "index").out + cli("docs", "tutorial").out
    assert "toctree" not in printed and "<!--" not in printed
    assert "| check a file of yours |" in printed and "$ brdf-check init" in printed


def test_a_project_to_begin_with(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("test_brdf.py").write_text("mine\n")
    outcome = cli("init", "--model", "brdfs/plastic.py")
    assert outcome.code == 0 and "left test_brdf.py as it is" in outcome.out
    assert Path("test_brdf.py").read_text() == "mine\n"
    assert cli("run", "--effort", 0.03, "--quiet", "--inconclusive", "pass").code == 0
    Path("test_brdf.py").unlink()
    cli("init", "--model", "brdfs/plastic.py")
    compile(Path("test_brdf.py").read_text(), "test_brdf.py", "exec")
    assert cli("init", "--model", "/x.py").code == 2


@pytest.mark.parametrize(
    ("words", "last", "expected"),
    [
        ("run --check", "furnace,en", "furnace,energy"),
        ("run --points", "so", "sobol"),
        ("furnace --sampler", "co", "cosine"),
        ("furnace --format", "sa", "sarif"),
        ("furnace --model ggx -p", "al", "alpha="),
        ("furnace --model blinn_phong -p", "norm=ex", "norm=exact"),
    ],
)
def test_values_are_completed(
    words: str, last: str, expected: str, cli: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    from click.shell_completion import ShellComplete

    from montecarlo_brdf.cli import commands

    completion = ShellComplete(commands, {}, "brdf-check", "_BRDF_CHECK_COMPLETE")
    found = completion.get_completions(words.split(), last)
    assert expected in [item.value for item in found]
