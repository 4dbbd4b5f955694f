"""brdf-check compare A B: values, A and R side by side; and --baseline of run."""
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome

from montecarlo_brdf import load
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.verify.compare import compare

FACTOR = "import math\ndef f(wo, wi, p):\n    return {} / math.pi\n"
#: not reciprocal: A at 60 degrees and R at 60 degrees differ
LOPSIDED = "def f(wo, wi, p):\n    return 0.1 * (1.0 + wi[2])\n"


def test_equal_models(cli: Callable[..., Outcome], user_file: Any) -> None:
    done = cli("compare", "lambert", user_file(FACTOR.format(0.5)), "-p", "albedo=0.5")
    assert done.code == 0 and "against" in done.out


def test_a_factor_is_named(cli: Callable[..., Outcome], user_file: Any) -> None:
    path = user_file(FACTOR.format("0.5 * math.pi"))
    options = ("-p", "albedo=0.5", "--format", "json", "--theta-o", "0,60")
    done = cli("compare", path, "lambert", *options)
    assert done.code == 1
    (result,) = json.loads(done.out)["results"]
    values, *albedos = result["findings"]
    assert "3.14159 everywhere" in values["hint"]
    assert [f["quantity"] for f in albedos] == ["A", "R", "A", "R"]
    assert all(f["expected"] == pytest.approx(0.5) for f in albedos)
    assert all(f["value"] == pytest.approx(0.5 * 3.141592653589793) for f in albedos)


def test_a_and_r_are_different_questions(user_file: Any) -> None:
    model, other = load(str(user_file(LOPSIDED))), load("lambert")
    report = compare(model, other, theta_o_deg=(60.0,))
    a, r = (f for f in report.results[0].findings if f.quantity in "AR")
    assert a.value == pytest.approx(0.1 * 3.141592653589793 * (1.0 + 2.0 / 3.0))
    assert r.value == pytest.approx(0.1 * 3.141592653589793 * 1.5)
    assert "theta_o_deg" in a.where and "theta_i_deg" in r.where


def test_parameters_go_to_whoever_has_them(cli: Callable[..., Outcome]) -> None:
    done = cli("compare", "lambert", "ggx", "-p", "albedo=1", "-p", "alpha=0.5,1", "--theta-o", "0",
               "--format", "json")  # fmt: skip
    results = json.loads(done.out)["results"]
    assert [r["params"] for r in results] == [{"albedo": 1.0}] * 2
    assert ["alpha=0.5" in r["check"] for r in results] == [True, False]
    done = cli("compare", "lambert", "ggx", "-p", "albdo=1")
    assert done.code == 2 and "did you mean 'albedo'" in done.err


def test_tolerance_and_angles_are_checked() -> None:
    with pytest.raises(UserError, match=r"\[0, 90\)"):
        compare(load("lambert"), load("lambert"), theta_o_deg=(90.0,))
    with pytest.raises(UserError, match="tolerance"):
        compare(load("lambert"), load("lambert"), tolerance=2.0)


def test_baseline_fails_only_for_what_got_worse(
    cli: Callable[..., Outcome], user_file: Any, tmp_path: Path
) -> None:
    def run(factor: float, *more: object) -> Outcome:
        path = user_file(FACTOR.format(factor))
        return cli("run", "--model", path, "--check", "furnace", "--samples", "2^14", *more)

    bad, good = tmp_path / "bad.json", tmp_path / "good.json"
    assert run(1.05, "--export-json", bad).code == 1
    done = run(1.05, "--baseline", bad)
    assert done.code == 0 and "baseline: 0 worse, 0 other changes" in done.err
    done = run(0.5, "--baseline", bad, "--export-json", good)
    assert done.code == 0 and done.err.count("fixed: ") == 3
    done = run(1.05, "--baseline", good)
    assert done.code == 1 and done.err.count("new failure: ") == 3
    assert run(0.5, "--baseline", tmp_path / "none.json").code == 2
