"""Values that are no numbers: a failure, also where curves are fitted and pictures drawn."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from conftest import Outcome

Command = Callable[..., Outcome]

SOMETIMES_NAN = """
import math


def f(wo, wi, p):
    return math.sqrt(wi[2] - 0.05) / math.pi
"""


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "my_brdf.py"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_nan_does_not_converge(cli: Command, tmp_path: Path) -> None:
    model = written(tmp_path, SOMETIMES_NAN)
    command = ["converge", "--model", model, "--sampler", "cosine", "--points", "sobol"]
    assert cli(*command, "--samples", "2^12").code == 1


def test_nan_is_drawn(cli: Command, tmp_path: Path) -> None:
    target = tmp_path / "nan.png"
    model = written(tmp_path, SOMETIMES_NAN)
    assert cli("furnace", "--model", model, "--theta-o", 0, "--plot", target).code == 1
    assert target.stat().st_size > 1000
