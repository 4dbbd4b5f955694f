"""The report: its JSON schema, and the text and pictures made from it."""
from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import SEVERITY, Command, Finding, Report, Result

Call = Callable[..., Outcome]

NUMBER = (int, float)
#: name -> type of a report's members
REPORT = {
    "schema": int,
    "command": str,
    "verdict": str,
    "versions": dict,
    "settings": dict,
    "results": list,
    "measured": dict,
}
RESULT = {"model": str, "params": dict, "check": str, "verdict": str, "findings": list}
FINDING = {
    "where": dict,
    "quantity": str,
    "value": NUMBER,
    "stderr": NUMBER,
    "expected": NUMBER,
    "tolerance": NUMBER,
    "resolves": NUMBER,
    "verdict": str,
    "bound": str,
    "level": NUMBER,
    "samples": int,
    "estimator": str,
    "reference": dict,
    "estimators": list,
}


def conforms(data: dict[str, Any], schema: dict[str, Any]) -> None:
    assert set(data) >= set(schema)
    for name, kind in schema.items():
        assert isinstance(data[name], kind) and not isinstance(data[name], bool), name


def strict(text: str) -> Any:
    """JSON as every language reads it: without NaN and Infinity."""

    def refuse(name: str) -> None:
        raise AssertionError(name)

    return json.loads(text, parse_constant=refuse)


@pytest.fixture(scope="module")
def report() -> Report:
    model = mb.load("lambert_unnormalised")
    return mb.furnace(model, model.parameters(c=0.5), theta_o_deg=[0, 60], samples=2**16)


def test_json_follows_the_schema(report: Report) -> None:
    data = strict(report.to_json())
    conforms(data, REPORT)
    assert (data["schema"], data["command"], data["verdict"]) == (1, "furnace", "fail")
    assert {"montecarlo_brdf", "python", "numba", "llvmlite", "numpy"} <= set(data["versions"])
    (result,) = data["results"]
    conforms(result, RESULT)
    assert (result["model"], result["params"]) == ("lambert_unnormalised", {"c": 0.5})
    assert [f["where"] for f in result["findings"]] == [
        {"theta_o_deg": t} for t in (0, 0, 60, 60)
    ]
    for finding in result["findings"]:
        conforms(finding, FINDING)
        assert finding["verdict"] in SEVERITY
        row = finding["estimators"][0]
        assert {"estimator", "value", "stderr", "samples", "verdict"} <= set(row)


def test_the_missing_pi_is_found_in_numbers(report: Report) -> None:
    finding = report.results[0].findings[1]
    assert finding.value == pytest.approx(math.pi / 2, rel=1e-12)
    assert 0.0 < finding.stderr < 1e-9
    assert finding.hint == "A / c = pi: the factor 1/pi is missing"


def test_results_have_no_timings(report: Report) -> None:
    again = mb.furnace(
        mb.load("lambert_unnormalised"),
        mb.load("lambert_unnormalised").parameters(c=0.5),
        theta_o_deg=[0, 60],
        samples=2**16,
        threads=2,
    )
    one, two = strict(report.to_json()), strict(again.to_json())
    assert json.dumps(one["results"]) == json.dumps(two["results"])
    assert one["settings"] == two["settings"]
    assert "seconds" in one["measured"]


def test_numbers_that_json_has_no_name_for_become_null() -> None:
    finding = Finding("A", {"theta_o_deg": 0.0}, "fail", value=math.nan, stderr=math.inf)
    odd = Result("m", {"a": (1.0, math.inf)}, "furnace", [finding])
    (result,) = strict(Report(Command.FURNACE, {}, [odd]).to_json())["results"]
    assert result["findings"][0]["value"] is None and result["findings"][0]["stderr"] is None
    assert result["params"]["a"] == [1.0, None]


def test_export_is_what_format_json_prints(cli: Call, tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    lambert = ("furnace", "--model", "lambert", "--theta-o", "0,60", "--sampler", "cosine")
    outcome = cli(*lambert, "--export-json", path, "--format", "json")
    assert outcome.code == 0 and path.read_text(encoding="utf-8") == outcome.out
    strict(outcome.out)


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_plot_draws_the_same_picture_again(kind: str, cli: Call, tmp_path: Path) -> None:
    """furnace --plot and plot REPORT.json give the same file but for a PDF's date."""
    one, two, export = (tmp_path / name for name in (f"one.{kind}", f"two.{kind}", "report.json"))
    arguments = ("--theta-o", "0,60", "--export-json", export, "--plot", one)
    assert cli("furnace", "--model", "lambert", *arguments).code == 0
    assert cli("plot", export, "-o", two).code == 0
    starts = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[kind]
    assert one.read_bytes().startswith(starts) and one.stat().st_size > 1000
    if kind != "pdf":
        assert one.read_bytes() == two.read_bytes()


def test_the_picture_shows_albedo_reference_and_error(report: Report) -> None:
    from montecarlo_brdf.report.pictures import albedo

    figure = albedo.figure(report)
    _, bottom = figure.axes
    assert bottom.get_yscale() == "log" and "theta_o" in bottom.get_xlabel()
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert any("reference" in text for text in labels) and any("stderr" in text for text in labels)


def test_text_shows_verdict_estimate_and_false_alarm_rate(cli: Call) -> None:
    arguments = ("--theta-o", "60", "--sampler", "cosine", "-p", "c=0.5")
    out = cli("furnace", "--model", "lambert_unnormalised", *arguments).out
    lines = out.splitlines()
    assert lines[0] == "lambert_unnormalised(c=0.5)  furnace"
    assert "1.5707963(0)" in out and "<= 1" in out
    assert lines[-1].startswith("FAIL  1 pass, 1 fail;")
    assert "seed 0" in lines[-1] and "chance of a false alarm <= 2e-09" in lines[-1]
    assert "\x1b[" not in out


def test_verbose_shows_every_estimator(cli: Call) -> None:
    quick = ("furnace", "--model", "lambert", "--theta-o", 0, "-v")
    out = cli(*quick).out
    for sampler in ("uniform", "cosine", "own"):
        assert f"A: {sampler} 0." in out
