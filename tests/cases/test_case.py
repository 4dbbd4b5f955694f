"""What a case lets searches vary, and how much its effort allows."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.errors import UserError

Command = Callable[..., Outcome]


@pytest.mark.slow
def test_weights_of_a_mixture_are_not_searched(cli: Command) -> None:
    model = mb.load("0.6 lambert + 0.4 ggx")
    assert searched(model, {}) == ("lambert_albedo", "ggx_alpha", "ggx_f0")
    assert searched(model, {"ggx.alpha": 0.3}) == ("lambert_albedo", "ggx_f0")
    assert cli("run", "--model", "0.6 lambert + 0.4 ggx", "--check", "energy").code == 0


def test_effort_is_a_share_of_every_budget() -> None:
    model = mb.load("lambert")
    case = Case(model, model.parameters(), (45.0,))
    assert [case.budget(n) for n in (1, 7, 20_000)] == [1, 7, 20_000]
    for effort in (0.001, 0.05, 0.5, math.nextafter(1.0, 0.0)):
        little = case._replace(effort=effort)
        assert little.budget(20_000) == math.ceil(20_000 * effort)
        assert little.budget(20_000, least=300) == max(300, math.ceil(20_000 * effort))
        assert little.budget(3, least=300) == 3


def test_a_run_of_little_effort_says_so_and_looks_at_less(cli: Command) -> None:
    model = mb.load("ggx")
    whole, little = (mb.run(model, names=["reciprocity"], effort=e) for e in (1.0, 0.01))
    assert whole.verdict == little.verdict == "pass"
    assert "effort" not in whole.settings and little.settings["effort"] == 0.01
    points = [sum(f.samples or 0 for r in x.results for f in r.findings) for x in (little, whole)]
    assert 10 * points[0] < points[1]  # where the code turns is asked at any effort
    assert cli("run", "--model", "ggx", "--check", "isotropy", "--effort", 0.01).code == 0


@pytest.mark.parametrize("effort", [0.0, -0.1, 1.5, math.nan])
def test_effort_is_a_share(effort: float) -> None:
    with pytest.raises(UserError, match=r"effort must be a number in \(0, 1\]"):
        mb.run(mb.load("lambert"), effort=effort)


@pytest.mark.parametrize("tolerance", [-1.0, 1.0, math.nan])
def test_tolerances_of_checks_are_shares(tolerance: float) -> None:
    with pytest.raises(UserError, match=r"tolerance must be a number in \[0, 1\)"):
        mb.run(mb.load("lambert"), names=("energy",), tolerances={"energy": tolerance})

