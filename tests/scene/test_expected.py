"""What a scene's author expects: held, refuted, and never executed."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome
from hypothesis import given
from hypothesis import strategies as st

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.expected import Expected, evaluated

Command = Callable[..., Outcome]
#: Lambert under a cap of radiance 2 and half angle 30 degrees about the normal
SCENE = """
[surface]
model = "lambert"
albedo = {albedo}
[environment]
kind = "cap"
half_angle_deg = 30
radiance = 2
[view]
theta_o_deg = [0, 60]
[expected]
radiance = {radiance}
{more}
"""
E_OVER_PI = "2 * sin(pi / 6)**2"  # E/pi of the cap


@pytest.fixture
def asked(cli: Command, tmp_path: Path) -> Callable[..., Outcome]:
    def ask(radiance: str, albedo: str = "0.6", more: str = "") -> Outcome:
        text = SCENE.format(radiance=radiance, albedo=albedo, more=more)
        (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
        return cli("radiance", tmp_path / "scene.toml", "--samples", "2^14", "--format", "json")

    return ask


@pytest.mark.parametrize(
    ("radiance", "more", "code"),
    [
        (f'"albedo * {E_OVER_PI}"', "", 0),
        ("0.3", "", 0),
        (f'"albedo * {E_OVER_PI} * mu_o**0"', "", 0),
        ("0.31", "", 1),
        ("0.31", "tolerance = 0.05", 0),
        ("0.31", "absolute = 0.02", 0),
        (f'"albedo * {E_OVER_PI} * mu_o"', "", 1),
    ],
)
def test_what_is_expected_is_held_or_refuted(
    radiance: str, more: str, code: int, asked: Callable[..., Outcome]
) -> None:
    outcome = asked(radiance, more=more)
    assert outcome.code == code, outcome.err
    found = json.loads(outcome.out)["results"][0]["findings"]
    mine = [f for f in found if f["quantity"] == "L_o as expected"]
    assert len(mine) == 2 and all(f["reference"]["kind"] == "declared" for f in mine)


def test_channels(asked: Callable[..., Outcome]) -> None:
    assert asked("[0.3, 0.1]", "[0.6, 0.2]").code == 0
    assert asked(f'"albedo * {E_OVER_PI}"', "[0.6, 0.2]").code == 0
    assert "3 values for 2 channels" in asked("[0.3, 0.1, 0.1]", "[0.6, 0.2]").err


BAD = {
    '"albdo * 2"': "no quantity 'albdo'; did you mean 'albedo'?",
    '"albedo *"': "is no formula",
    '"open(1)"': "no function 'open'",
    "\"__import__('os')\"": "no function '__import__'",
    '"albedo.real"': "a formula has no 'albedo.real'",
    '"1 / 0"': "has no value",
    '"10 ** 400"': "has no value",
    '"sqrt(-1)"': "has no value",
    "true": "must be a number, a formula in quotes, or a list",
    "[]": "must be a number, a formula in quotes, or a list",
}


@pytest.mark.parametrize("radiance", BAD)
def test_what_is_no_formula(radiance: str, asked: Callable[..., Outcome]) -> None:
    outcome = asked(radiance)
    assert outcome.code == 2 and BAD[radiance] in outcome.err and "line 12" in outcome.err


def test_formulas() -> None:
    names = {"a": 3.0, "pi": math.pi}
    assert evaluated("-a**2 + 2*(a - 1)/4 + min(a, 1)", names) == -7.0
    assert evaluated("cos(pi) + atan2(0, 1)", names) == -1.0
    assert Expected(("theta_o",)).value(2, 90.0, 0.0, {}) == pytest.approx(0.5 * math.pi)


@given(st.text(alphabet="a1.+-*/() **,minsqrt_[]'", max_size=40))
def test_any_text_is_a_number_or_a_sentence(text: str) -> None:
    try:
        assert math.isfinite(evaluated(text, {"a": 2.0}))
    except UserError as error:
        assert str(error)
