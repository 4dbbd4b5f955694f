"""Models under the parameter names of others: equal where they are, refused where nothing fits."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

from montecarlo_brdf import load
from montecarlo_brdf.counterpart import counterpart
from montecarlo_brdf.errors import UserError

Command = Callable[..., Outcome]
RENAMED = """
from typing import NamedTuple
from montecarlo_brdf.models import ggx_anisotropic as theirs
class Params(NamedTuple):
    ax: float = 0.3
    ay: float = 0.1
domain = {"ax": (0.05, 1.0), "ay": (0.05, 1.0)}
isotropic = False
def f(wo, wi, p):
    return theirs.f(wo, wi, theirs.Params(p.ax, p.ay, 1.0))
"""
RIGHT = "ggx_anisotropic(alpha_x=ax, alpha_y=ay, f0=1)"
PROJECT = """
checks = ["equality"]
[[models]]
model = "my.py"
against = { model = "ggx_anisotropic", params = { alpha_x = "ax", alpha_y = "ay" } }
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "my.py").write_text(RENAMED)
    (tmp_path / "brdf-check.toml").write_text(PROJECT)
    (tmp_path / "fit.py").write_text(FIT)
    monkeypatch.chdir(tmp_path)
    return tmp_path


FIT = """
def f(wo, wi, p):
    return 0.1
def albedo(cos_theta_o, p):
    return 0.801
"""


def test_the_same_values_under_other_names(folder: Path) -> None:
    ours, wo, wi = load("my.py"), (0.6, 0.0, 0.8), (0.0, 0.28, 0.96)
    other = counterpart(RIGHT, ours)
    p, q = ours.parameters(ax=0.5), other.parameters(ax=0.5, ay=0.1)
    assert other.f(wo, wi, other.prepared(q)) == ours.f(wo, wi, p)


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("ggx_anisotropic", "ax, ay of model my.py has no counterpart"),
        ("ggx_anisotropic(alpha_x=ax)", "ay of model my.py has no counterpart"),
        ("ggx_anisotropic(alpha_z=ax, alpha_y=ay)", "did you mean 'alpha_"),
        ("ggx_anisotropic(alpha_x=axe, alpha_y=ay)", "did you mean 'ax'"),
        ("ggx_anisotropic(alpha_x)", "a counterpart is written"),
    ],
)
def test_what_has_no_counterpart(spec: str, said: str, folder: Path) -> None:
    with pytest.raises(UserError, match="(?s)" + said.replace("(", r"\(")):
        counterpart(spec, load("my.py"))


def test_run_takes_a_mapping_and_repeats_it(folder: Path, cli: Command) -> None:
    line = ("run", "--model", "my.py", "--check", "equality", "--against")
    assert cli(*line, "ggx_anisotropic").code == 2
    assert cli(*line, RIGHT).code == 0
    wrong = cli(*line, "ggx_anisotropic(alpha_x=ay, alpha_y=ax)")
    assert wrong.code == 1
    assert "--against 'ggx_anisotropic(alpha_x=ay, alpha_y=ax)'" in wrong.out
    assert cli("run").code == 0  # as the project's file says


def test_a_value_that_was_chosen_needs_none(folder: Path, cli: Command) -> None:
    line = ("run", "--model", "my.py", "--check", "equality", "-p", "ax=0.2", "-p", "ay=0.4")
    assert cli(*line, "--against", "ggx_anisotropic").code == 0


def test_compare_searches_the_ranges_that_both_have(folder: Path, cli: Command) -> None:
    same = cli("compare", "my.py", RIGHT, "--theta-o", 30)
    assert same.code == 0 and "f for all ax, ay" in same.out
    (folder / "my.py").write_text(RENAMED.replace("p.ay, 1.0", "p.ay + max(0.0, p.ax - 0.9), 1.0"))
    assert cli("compare", "my.py", RIGHT, "--theta-o", 30).code == 1


def test_a_declared_albedo_is_held_to_an_absolute_tolerance(folder: Path, cli: Command) -> None:
    line = ("compare", "fit.py", "lambert", "--theta-o", "0,60", "--declared")
    assert (cli(*line, 0.002).code, cli(*line, 0.0005).code) == (0, 1)
    assert "declares no albedo" in cli("compare", "my.py", "lambert", "--declared", 0.1).err
