"""What a shader author met who only read the README."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.checks import _draws

Command = Callable[..., Outcome]

SOMETIMES_NAN = """
import math


def f(wo, wi, p):
    return math.sqrt(wi[2] - 0.05) / math.pi
"""
HELPER = """
import math
from dataclasses import dataclass


@dataclass
class Light:
    x: float = 1.0


def f(wo, wi, p):
    return 0.5 / math.pi
"""
MISSPELT = """
import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albdo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi
"""


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "my_brdf.py"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_weights_of_a_mixture_are_not_searched(cli: Command) -> None:
    model = mb.load("0.6 lambert + 0.4 ggx")
    assert searched(model, {}) == ("lambert_albedo", "ggx_alpha", "ggx_f0")
    assert searched(model, {"ggx.alpha": 0.3}) == ("lambert_albedo", "ggx_f0")
    assert cli("run", "--model", "0.6 lambert + 0.4 ggx", "--check", "energy").code == 0


def test_a_rare_lobe_chosen_by_the_third_number_is_noticed() -> None:
    model = mb.load("0.0015 lambert + 0.9985 ggx")
    assert _draws.chooses(Case(model, model.parameters(), (45.0,)), 45.0)
    plain = mb.load("ggx")
    assert not _draws.chooses(Case(plain, plain.parameters(), (45.0,)), 45.0)


def test_nan_does_not_converge(cli: Command, tmp_path: Path) -> None:
    model = written(tmp_path, SOMETIMES_NAN)
    command = ["converge", "--model", model, "--sampler", "cosine", "--points", "sobol"]
    assert cli(*command, "--samples", "2^12").code == 1


def test_nan_is_drawn(cli: Command, tmp_path: Path) -> None:
    target = tmp_path / "nan.png"
    model = written(tmp_path, SOMETIMES_NAN)
    assert cli("furnace", "--model", model, "--theta-o", 0, "--plot", target).code == 1
    assert target.stat().st_size > 1000


def test_a_file_with_a_dataclass_is_loaded(tmp_path: Path) -> None:
    before = set(sys.modules)
    assert mb.load(written(tmp_path, HELPER)).f is not None
    assert "my_brdf" not in set(sys.modules) - before


def test_a_domain_of_no_parameter_is_told(tmp_path: Path) -> None:
    with pytest.raises(mb.ModelError, match="did you mean 'albedo'"):
        mb.load(written(tmp_path, MISSPELT))
