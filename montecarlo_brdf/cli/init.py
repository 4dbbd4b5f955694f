"""brdf-check init"""

from __future__ import annotations

from pathlib import Path

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check init
  brdf-check init --model brdfs/plastic.py
"""
MODEL = '''\
"""My BRDF: a diffuse surface.

f = albedo/pi  [1/sr]

albedo: what it reflects, 0 to 1.
"""
import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albedo": (0.0, 1.0)}
scales_with = "albedo"


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
'''
PROJECT = """\
# What `brdf-check run` and pytest check here: every model, all checks.
theta_o = [0, 45, 80]

[[models]]
model = "{model}"
"""
TEST = '''\
"""The BRDFs of this project conserve energy and are reciprocal."""
from pathlib import Path

from montecarlo_brdf.testing import assert_conserves_energy, assert_reciprocal

MODEL = Path(__file__).parent / "{model}"


def test_energy():
    assert_conserves_energy(MODEL)


def test_reciprocity():
    assert_reciprocal(MODEL)
'''


@click.command("init", epilog=EPILOG, short_help="A first brdf-check.toml, model and test.")
@click.option("--model", type=_options.FILE, default="my_brdf.py", show_default=True,
              metavar="FILE",
              help="The model: yours, or a new one. [--model brdfs/plastic.py]")  # fmt: skip
def command(model: Path) -> int:
    """Write brdf-check.toml, test_brdf.py and, where there is none, a model to begin with. Then
    `brdf-check run` and `pytest` check it. Nothing that exists is changed."""
    from montecarlo_brdf.cli._terminal import tell
    from montecarlo_brdf.files import check_writable, write_text

    if model.suffix != ".py" or model.is_absolute():
        raise UserError(f"the model must be a .py file below this folder, not {model}")
    name = model.as_posix().replace('"', '\\"')
    wanted = {Path("brdf-check.toml"): PROJECT, Path("test_brdf.py"): TEST, model: MODEL}
    made = {p: text.replace("{model}", name) for p, text in wanted.items() if not p.exists()}
    model.parent.mkdir(parents=True, exist_ok=True)
    for path in made:
        check_writable(path)
    for path, text in made.items():
        write_text(path, text)
        tell(f"wrote {path}")
    for path in wanted.keys() - made.keys():
        tell(f"left {path} as it is")
    return 0
