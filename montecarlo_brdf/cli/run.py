"""brdf-check run"""
from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options

EPILOG = """\b
Examples:
  brdf-check run --model ggx
  brdf-check run --model my_brdf.py -p alpha=0.05:1:log5 --check energy,reciprocity
  brdf-check run --model my_ggx.py --against ggx --max-time 10
  brdf-check run --model all
  brdf-check run                      (all that brdf-check.toml names)
"""


@click.command("run", epilog=EPILOG, short_help="Every check of one, several or all models.")
@_options.optional_model_option
@click.option("--config", type=click.Path(path_type=Path), metavar="FILE",
              help="Without --model: what to check, instead of the nearest brdf-check.toml or "
              "[tool.brdf-check] of a pyproject.toml. [--config ci/brdf-check.toml]")  # fmt: skip
@click.option("--check", "names", default="all", show_default=True, metavar="NAMES",
              help="Which checks, separated by commas. [--check energy,pdf]")
@click.option("--theta-o", default="0,45,80", show_default=True, metavar="DEGREES",
              help="Angles of the viewer in [0, 90) for checks that look at some. "
              "[--theta-o 0:85:6]")
@click.option("--phi-o", default="0", metavar="DEGREES", help="Azimuth of the viewer. [--phi-o 45]")
@click.option("--against", metavar="MODEL",
              help="A model that it must equal in values. [--against ggx]")
@click.option("--max-time", type=float, metavar="SECONDS",
              help="Begin no claim after this; the rest is inconclusive. [--max-time 60]")
@click.option("--effort", type=_options.Number("in (0, 1]"), default=1.0, show_default=True,
              help="Share of the pairs, places and nodes that checks look at. [--effort 0.1]")
@click.option("--baseline", type=click.Path(path_type=Path), metavar="REPORT.json",
              help="Tell what changed since an earlier report; exit with 0 if nothing got worse. "
              "[--baseline main.json]")  # fmt: skip
@_options.sampling_options
@_options.output_options
def command(**options: Any) -> int:
    """All checks, or those named, with the worst finding of each, its likely cause and a command
    that reproduces it. Parameters without -p are searched over their range for the worst case.
    Without --model: the models and cases of the project's brdf-check.toml (docs/ci.md)."""
    from montecarlo_brdf.cli._running import run_all

    return run_all(options, _options.given())
