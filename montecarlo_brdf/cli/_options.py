"""Options that commands share, as records, and what happens to a finished report."""
from __future__ import annotations

import functools
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import click

from montecarlo_brdf.cli._values import Number, Read, Whole, number, numbers, read_seed
from montecarlo_brdf.errors import OutputError, UserError, unknown
from montecarlo_brdf.files import check_writable, write_bytes, write_text
from montecarlo_brdf.judge.finding import Policy, Report, Verdict
from montecarlo_brdf.report import formats

TEXT = "text"
FORMATS = (TEXT, *formats.SUFFIXES)
Command = Callable[..., int]
Option = Callable[[Command], Command]


def model_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[str]:
    """Completion of --model."""
    from montecarlo_brdf.loading import names

    return [n for n in names() if n.startswith(incomplete)]


#: options that several commands have, some with a help of their own
model = partial(
    click.option, "--model", "spec", metavar="MODEL", shell_complete=model_names,
    help="A built-in model, my_brdf.py, or my_brdf.py:name. [--model lambert]",
)  # fmt: skip
parameters = partial(
    click.option, "-p", "--param", "assignments", multiple=True, metavar="NAME=VALUE",
    help="A parameter or choice; lists and ranges make cases, a/b/c makes a colour. "
    "[-p albedo=0.5  -p alpha=0.1,0.3  -p alpha=0.05:1:log5  -p f0=1/0.7/0.3]",
)  # fmt: skip
theta_o = partial(
    click.option, "--theta-o", type=Read(numbers), metavar="DEGREES", show_default=True
)
phi_o = partial(
    click.option, "--phi-o", type=Read(number), metavar="DEGREES", default="0",
    help="Azimuth of the viewer. [--phi-o 45]",
)  # fmt: skip
seed = partial(
    click.option, "--seed", type=Read(read_seed), metavar="NUMBER", default="0", show_default=True,
    help="A number, or random (printed). [--seed 7]",
)  # fmt: skip
threads = partial(
    click.option, "--threads", type=Whole(),
    help="Threads; results do not depend on it. [--threads 1]  [default: all]",
)  # fmt: skip
tolerance = partial(
    click.option, "--tolerance", type=Number("in [0, 1)"),
    help="Allowed deviation: relative from a reference [default: 1e-4], absolute from a bound "
    "[default: 1e-5]. [--tolerance 1e-3]",
)  # fmt: skip
plot = partial(click.option, "--plot", type=click.Path(path_type=Path), metavar="FILE")


class Sampling(NamedTuple):
    """How to sample, as verify's questions take it."""

    points: str
    samples: int | None
    seed: int
    threads: int | None
    tolerance: float | None

    def keywords(self) -> dict[str, Any]:
        """The arguments of a question; samples that were not given are left to it."""
        return {k: v for k, v in self._asdict().items() if k != "samples" or v is not None}


def sampling_options(command: Command) -> Command:
    """--points, --samples, --seed, --threads, --tolerance, as one argument `sampling`."""
    return _gathered(command, "sampling", Sampling, [
        click.option("--points", default="sobol", show_default=True, metavar="SET",
                     help="Point set: sobol, independent, stratified or lattice. "
                     "[--points independent]"),
        click.option("--samples", type=Whole(), default=None,
                     help="The most samples a claim may take; it stops sooner where it is decided. "
                     "[--samples 2^20]  [default: 2^22; run: 2^20]"),
        seed(),
        threads(),
        tolerance(),
    ])  # fmt: skip


def output_options(command: Command) -> Command:
    """--format, --export, --export-json, --inconclusive, --verbose, and the command's --plot if it
    has one, as one argument `output`."""
    return _gathered(command, "output", Output, [
        click.option("--format", "form", default=TEXT, show_default=True, metavar="FORM",
                     help=f"What stdout gets: {', '.join(FORMATS)}. [--format junit]"),
        click.option("--export", "exports", type=click.Path(path_type=Path), metavar="FILE",
                     multiple=True,
                     help="Write the report in the format of the suffix: .json, .xml (JUnit), .md, "
                     ".csv; may be given more than once. [--export junit.xml]"),
        click.option("--export-json", type=click.Path(path_type=Path), metavar="FILE",
                     help="Write the whole report. [--export-json report.json]"),
        click.option("--inconclusive", type=click.Choice([p.value for p in Policy]), default=None,
                     callback=lambda _, __, word: word and Policy(word),
                     help="Count inconclusive as pass (exit 0) or fail (exit 1), not as exit 3."),
        click.option("-v", "--verbose", is_flag=True,
                     help="Show every estimator of every finding."),
    ])  # fmt: skip


def _gathered(
    command: Command, name: str, record: type[Sampling | Output], options: list[Option]
) -> Command:
    """Some options as one argument of the command: a record with a field for each."""

    @functools.wraps(command)
    def call(**values: Any) -> int:
        fields = {k: values.pop(k) for k in record._fields if k in values}
        return command(**values, **{name: record(**fields)})

    made: Command = call
    for option in reversed(options):
        made = option(made)
    return made


class Output(NamedTuple):
    """What becomes of a report."""

    form: str
    exports: tuple[Path, ...]
    export_json: Path | None
    inconclusive: Policy | None
    verbose: bool
    plot: Path | None = None

    def check(self) -> None:
        """Complain about outputs before hours of work, not after."""
        if self.form not in FORMATS:
            raise UserError(unknown("format", self.form, FORMATS))
        for path in filter(None, (self.export_json, self.plot, *self._files())):
            check_writable(path)
        if self.plot:
            from montecarlo_brdf.report.pictures import kind_of

            kind_of(self.plot)

    def _files(self) -> dict[Path, str]:
        """What to write besides pictures: file -> format."""
        known = formats.suffixes() if self.exports else {}
        for path in self.exports:
            if path.suffix not in known:
                raise UserError(unknown(f"format for {path}: suffix", path.suffix, known))
        found = {path: known[path.suffix] for path in self.exports}
        return {**found, **({self.export_json: "json"} if self.export_json else {})}


def import_format(output: Output) -> None:
    """Have at hand what takes longest to import of what `deliver` needs."""
    if output.form == TEXT:
        from montecarlo_brdf.cli import _terminal  # noqa: F401


def deliver(report: Report, output: Output) -> int:
    """Print, write and draw a report; the exit code of the command."""
    policy = output.inconclusive
    if policy:
        report.settings["inconclusive"] = policy
    if output.plot:
        from montecarlo_brdf.report import pictures

        write_bytes(output.plot, pictures.drawn(report, pictures.kind_of(output.plot)))
    for path, form in output._files().items():
        write_text(path, formats.render(report, form))
    if output.form != TEXT:
        click.echo(formats.render(report, output.form), nl=False)
    else:
        from montecarlo_brdf.cli import _terminal
        from montecarlo_brdf.report import text

        _terminal.tell(text.render(report, output.verbose, _terminal.width(), _terminal.colour()))
    if output.form == "github":
        _summarise(report)
    undecided = report.verdict == Verdict.INCONCLUSIVE
    return policy.code if policy and undecided else report.exit_code


def _summarise(report: Report) -> None:
    """Add the Markdown report to the page of the workflow run."""
    path = os.environ.get("GITHUB_STEP_SUMMARY")
    if not path:
        return
    try:
        with open(path, "a", encoding="utf-8") as file:
            file.write(formats.render(report, "markdown"))
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error
