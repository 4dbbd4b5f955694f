"""brdf-check stress: tables, verdicts, reproduction lines, pictures, mistakes."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Cli = Callable[..., Any]


def test_textbook_fails_and_ours_holds(cli: Cli) -> None:
    for name, code in (("textbook_phong", 1), ("phong", 0)):
        done = cli("stress", "--model", name, "--quick", "--precision", "float32,float64")
        assert done.code == code, done.out


def test_reproduction_line_reproduces(cli: Cli) -> None:
    done = cli("stress", "--model", "textbook_phong", "--quick", "--precision", "float32")
    line = re.search(r"brdf-check (stress .*)", done.out)
    value = re.search(r"float32 gives (\S+), the truth is (\S+)", done.out)
    assert line and value
    again = cli(*line[1].split())
    shown = dict(row.split()[:2] for row in again.out.splitlines())
    assert float(shown["float32"]) == pytest.approx(float(value[1]), rel=1e-8)
    assert float(shown["truth"]) == pytest.approx(float(value[2]), rel=1e-8)


def test_comparison_report_and_picture(cli: Cli, tmp_path: Path) -> None:
    picture, export = tmp_path / "d.png", tmp_path / "d.json"
    done = cli("stress", "--compare", "textbook_ggx", "schlick_ggx", "--quick",
               "--precision", "float64", "--plot", picture, "--export-json", export)  # fmt: skip
    assert done.code == 1 and picture.stat().st_size > 10_000
    report = json.loads(export.read_text())
    assert [r["model"] for r in report["results"]] == ["textbook_ggx", "schlick_ggx"]
    assert [r["verdict"] for r in report["results"]] == ["fail", "pass"]
    assert cli("plot", export, "-o", tmp_path / "again.png").code == 0
    assert (tmp_path / "again.png").read_bytes() == picture.read_bytes()


def test_text_on_stdout_and_exports_in_files(cli: Cli, tmp_path: Path) -> None:
    exports = [tmp_path / "d.json", tmp_path / "d.csv"]
    options = [word for path in exports for word in ("--export", path)]
    done = cli("stress", "--model", "lambert", "--quick", "--precision", "float32", *options)
    assert done.code == 0 and "PASS" in done.out
    assert json.loads(exports[0].read_text())["results"][0]["verdict"] == "pass"
    assert exports[1].read_text().startswith("model,")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--quick"], "either --model MODEL or --compare A B"),
        (["--model", "textbok_ggx"], "did you mean 'textbook_ggx'"),
        (["--model", "ggx", "--precision", "float33"], "did you mean 'float32'"),
        (["--model", "ggx", "--max-error", "0"], "max-error must be a number in (0, 1]"),
        (["--model", "ggx", "--at", "0,0,1"], "six numbers"),
        (["--model", "ggx", "--plot", "x.gif"], ".png, .svg or .pdf"),
    ],
)
def test_mistakes(cli: Cli, arguments: list[str], said: str) -> None:
    done = cli("stress", *arguments, "--quick")
    assert done.code in (2, 5) and said in done.err


def test_infinite_errors_are_the_worst_of_a_heat_map() -> None:
    from montecarlo_brdf.report.pictures.stability import _worst

    points = [(30.0, 0.1, None), (30.0, 0.1, 1e-9), (89.0, 0.1, 0.0), (89.0, 0.2, 7.0)]
    assert _worst(points) == {(60.0, 0.1): 1.0, (1.0, 0.1): 0.0, (1.0, 0.2): 1.0}


def test_a_heat_map_has_a_cell_per_angle_and_value_and_names_the_parameter() -> None:
    from montecarlo_brdf.judge.finding import Command, Report, Result
    from montecarlo_brdf.report.pictures.stability import figure

    points = [(theta, value, 1e-6) for theta in (0.0, 60.0, 89.99) for value in (1e-4, 0.3)]
    measured = {"precisions": [[{"name": "float32", "parameter": "alpha", "eps": 6e-8}]]}
    report = Report(Command.STRESS, {}, [Result("m", {}, "stability", [], [points])], measured)
    axes = figure(report).axes[0]
    assert axes.get_ylabel() == "alpha" and axes.get_title() == "m, float32"
    assert [t.get_text() for t in axes.get_xticklabels()] == ["90", "30", "0.01"]
    assert [t.get_text() for t in axes.get_yticklabels()] == ["0.0001", "0.3"]
    assert axes.collections[0].get_array().shape == (2, 3)


def test_a_model_that_disclaims_positivity_may_be_negative() -> None:
    from montecarlo_brdf import loading
    from montecarlo_brdf.stability.stress import Loss
    from montecarlo_brdf.verify.stress import result

    found = Loss("float32", 1e-5, 2.0**-23, counts={"nan": 0, "inf": 0, "negative": 3})
    said = {n: result(loading.load(n), [found], ("float32",)) for n in ("phong", "phong_unclamped")}
    verdicts = {n: [(f.quantity, f.verdict) for f in r.findings][1] for n, r in said.items()}
    assert verdicts["phong"] == ("f is NaN, Inf, negative", "fail")
    assert verdicts["phong_unclamped"] == ("f is NaN, Inf", "pass")
