"""Options that commands share, and what happens to a finished report."""
from __future__ import annotations

import functools
import os
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli._values import Number, Whole, whole
from montecarlo_brdf.errors import OutputError, UserError, unknown
from montecarlo_brdf.report import formats

EXPORTS = "montecarlo_brdf.exports"  # where the context of a command keeps --export
FORMATS = ("text", *formats.names())


def model_names(ctx: Any, param: Any, incomplete: str) -> list[str]:
    """Completion of --model."""
    from montecarlo_brdf.loading import names

    return [n for n in names() if n.startswith(incomplete)]


def given() -> list[str]:
    """The options of the current command that were given, not left at their defaults."""
    context = click.get_current_context()
    default = (click.core.ParameterSource.DEFAULT, click.core.ParameterSource.DEFAULT_MAP, None)
    return [name for name in context.params if context.get_parameter_source(name) not in default]


def model_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """--model and -p."""
    return _model_options(command, required=True)


def optional_model_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """The same for a command that knows what to do without."""
    return _model_options(command, required=False)


def _model_options(command: Callable[..., Any], required: bool) -> Callable[..., Any]:
    command = click.option(
        "-p",
        "--param",
        "assignments",
        multiple=True,
        metavar="NAME=VALUE",
        help="A parameter or choice; lists and ranges make cases, a/b/c makes a colour. "
        "[-p albedo=0.5  -p alpha=0.1,0.3  -p alpha=0.05:1:log5  -p f0=1/0.7/0.3]",
    )(command)
    return click.option(
        "--model",
        "spec",
        required=required,
        metavar="MODEL",
        shell_complete=model_names,
        help="A built-in model, my_brdf.py, or my_brdf.py:name. [--model lambert]",
    )(command)


def sampling_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """--points, --samples, --seed, --threads, --tolerance."""
    options = [
        click.option("--points", default="sobol", show_default=True, metavar="SET",
                     help="Point set: sobol, independent, stratified or lattice. "
                     "[--points independent]"),
        click.option("--samples", type=Whole(), default=None,
                     help="The most samples a claim may take; it stops sooner where it is decided. "
                     "[--samples 2^20]  [default: 2^22; run: 2^20]"),
        click.option("--seed", default="0", show_default=True, metavar="NUMBER",
                     help="A number, or random (printed). [--seed 7]"),
        click.option("--threads", type=Whole(), default=None,
                     help="Threads; results do not depend on it. [--threads 1]  [default: all]"),
        click.option("--tolerance", type=Number("in [0, 1)"), default=None,
                     help="Allowed deviation: relative from a reference [default: 1e-4], absolute "
                     "from a bound [default: 1e-5]. [--tolerance 1e-3]"),
    ]  # fmt: skip
    return functools.reduce(lambda done, option: option(done), reversed(options), command)


def output_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """--format, --export, --export-json, --inconclusive, --verbose."""
    options = [
        click.option("--format", "form", default="text", show_default=True, metavar="FORM",
                     help=f"What stdout gets: {', '.join(FORMATS)}. [--format junit]"),
        click.option("--export", "exports", type=click.Path(path_type=Path), metavar="FILE",
                     multiple=True, expose_value=False, callback=_remembered,
                     help="Write the report in the format of the suffix: .json, .xml (JUnit), .md, "
                     ".csv; may be given more than once. [--export junit.xml]"),
        click.option("--export-json", type=click.Path(path_type=Path), metavar="FILE",
                     help="Write the whole report. [--export-json report.json]"),
        click.option("--inconclusive", type=click.Choice(["pass", "fail"]), default=None,
                     help="Count inconclusive as pass (exit 0) or fail (exit 1), not as exit 3."),
        click.option("-v", "--verbose", is_flag=True,
                     help="Show every estimator of every finding."),
    ]  # fmt: skip
    return functools.reduce(lambda done, option: option(done), reversed(options), command)


def _remembered(ctx: Any, param: Any, paths: tuple[Path, ...]) -> tuple[Path, ...]:
    """Keep --export for `check_outputs` and `deliver`, whichever command it belongs to."""
    ctx.meta[EXPORTS] = paths
    return paths


def exports() -> dict[Path, str]:
    """What the current command has to export: file -> format."""
    context = click.get_current_context(silent=True)
    paths = context.meta.get(EXPORTS, ()) if context else ()
    for path in paths:
        if path.suffix not in formats.suffixes():
            raise UserError(unknown(f"format for {path}: suffix", path.suffix, formats.suffixes()))
    return {path: formats.suffixes()[path.suffix] for path in paths}


def check_outputs(form: str, *paths: Path | None) -> None:
    """Complain about outputs before hours of work, not after."""
    from montecarlo_brdf.files import check_writable

    if form not in FORMATS:
        raise UserError(unknown("format", form, FORMATS))
    for path in (*paths, *exports()):
        if path is not None:
            check_writable(path)


def seed_of(text: str) -> int:
    """The seed, drawn and told if it is 'random'."""
    if text == "random":
        seed = secrets.randbits(32)
        click.echo(f"seed {seed}", err=True)
        return seed
    number = whole(text)
    if number is None or number >= 1 << 64:
        raise UserError(f"seed must be a whole number from 0 to 2^64 - 1, or random, not {text!r}")
    return number


def import_format(form: str) -> None:
    """Have at hand what takes longest to import of what `deliver` needs."""
    if form == "text":
        from montecarlo_brdf.cli import _terminal  # noqa: F401


def deliver(
    report: Any, form: str, export: Path | None, inconclusive: str | None, verbose: bool
) -> int:
    """Print and write a report; the exit code of the command."""
    if inconclusive:
        report.settings["inconclusive"] = inconclusive
    write_exports(report, export)
    if form == "text":
        from montecarlo_brdf.cli import _terminal
        from montecarlo_brdf.report import text

        _terminal.tell(text.render(report, verbose, _terminal.width(), _terminal.colour()))
    else:
        click.echo(formats.render(report, form), nl=False)
    if form == "github":
        _summarise(report)
    if report.verdict == "inconclusive" and inconclusive:
        return {"pass": 0, "fail": 1}[inconclusive]
    return int(report.exit_code)


def write_exports(report: Any, export_json: Path | None) -> None:
    """--export-json and every --export."""
    from montecarlo_brdf.files import write_text

    wanted = {**exports(), **({export_json: "json"} if export_json else {})}
    for path, form in wanted.items():
        write_text(path, formats.render(report, form))


def _summarise(report: Any) -> None:
    """Add the Markdown report to the page of the workflow run."""
    path = os.environ.get("GITHUB_STEP_SUMMARY")
    if not path:
        return
    try:
        with open(path, "a", encoding="utf-8") as file:
            file.write(formats.render(report, "markdown"))
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error
