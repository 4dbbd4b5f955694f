"""brdf-check table"""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._options import Read, finite, listed
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.judge.finding import Policy

if TYPE_CHECKING:
    from montecarlo_brdf.model import Model
    from montecarlo_brdf.table.axes import Axis
    from montecarlo_brdf.verify.table import Answer

EPILOG = """\b
Examples:
  brdf-check table ggx --axis mu=0:1:64 --axis alpha=0:1:64 --export ggx_e.npz
  brdf-check table ggx --quantity split-sum --axis mu=0:1:64 --axis r=0:1:64
      -p "alpha=max(r^2, 1e-4)" --target-error 1e-6 --export ggx_lut.h --export ggx_lut.exr
  brdf-check table ggx --quantity average --axis alpha=0:1:32@edges -p alpha=0.001
  brdf-check table my_brdf.py --axis mu=0:1:32 --axis roughness=0:1:32 --plot table.png
  brdf-check table ggx --axis mu=0:1:64 --axis alpha=0:1:64 --fit polynomial:6
  brdf-check table ggx --against their_lut.npy --axis mu=0:1:32 --axis alpha=0:1:32
      --tolerance 2e-3
  brdf-check table fon -p albedo=1 --axis mu=0:1:64 --axis sigma=0:1:16 --against fits.py:e_fon
"""
USUAL = ("mu=0:1:32",)
AXIS = re.compile(r"(?P<name>[A-Za-z_]\w*)=(?P<low>[^:@]+):(?P<high>[^:@]+):(?P<size>[^:@]+)"
                  r"(?:@(?P<placement>\w+))?")  # fmt: skip
FILES = (".npz", ".csv", ".h", ".exr")
IDENTIFIER = re.compile(r"\W")


class Files(NamedTuple):
    """What a table is written to."""

    exports: tuple[Path, ...]
    number: str
    export_json: Path | None
    plot: Path | None
    name: str | None

    def check(self, axes: int, quantities: int) -> None:
        """Complain before hours of work."""
        from montecarlo_brdf.files import check_writable
        from montecarlo_brdf.report.pictures import kind_of
        from montecarlo_brdf.table.written import exr

        for path in filter(None, (*self.exports, self.export_json, self.plot)):
            check_writable(path)
        for path in self.exports:
            if path.suffix not in FILES:
                raise UserError(unknown(f"format for {path}: suffix", path.suffix, FILES))
            if path.suffix == ".exr":
                exr.check(axes, quantities)
        if self.export_json:
            _options.check_suffix(self.export_json, "json")
        if self.plot:
            kind_of(self.plot)


@click.command("table", epilog=EPILOG, short_help="Albedo and split-sum tables, certified.")
@click.argument("spec", metavar="MODEL", shell_complete=_options.model_names)
@click.option("--quantity", type=Read(listed), default="albedo", show_default=True, metavar="NAMES",
              help="Some of albedo (E of the viewer's angle), average (over all angles), scale and "
              "bias (A = scale f0 + bias), split-sum (both). [--quantity albedo,split-sum]")
@click.option("--axis", "ranges", multiple=True, metavar="NAME=LOW:HIGH:SIZE[@edges]",
              help="One to three of mu (cosine of the viewer's angle), theta, phi (degrees), a "
              "parameter, or a name that a formula of -p takes. Values lie at the centres of SIZE "
              "intervals, or from end to end with @edges. [--axis mu=0:1:64]  [default: mu=0:1:32]")
@click.option("-p", "--param", "assignments", multiple=True, metavar="NAME=VALUE",
              shell_complete=_options.parameter_names,
              help="Another parameter or choice, or a formula of the axes. [-p f0=0.04  "
              "-p 'alpha=max(roughness^2, 1e-4)']")
@click.option("--theta-o", type=Read(_options.number), default="0", metavar="DEGREES",
              help="The viewer, where no axis says. [--theta-o 45]")
@_options.phi_o()
@click.option("--split", default="f0", show_default=True, metavar="NAME",
              help="The parameter that scale and bias are of; f must be affine in it. [--split ks]")
@click.option("--target-error", type=finite("in [1e-12, 1)"), default=None,
              help="Absolute error of every cell. [--target-error 1e-6]  [default: 1e-5, or a "
              "tenth of --tolerance]")
@click.option("--confidence", type=finite("in (0, 1)"), default="0.99", show_default=True,
              help="That the errors of all cells hold at once. [--confidence 0.999]")
@click.option("--fresh", type=_options.WHOLE, default="512", show_default=True,
              help="Random places besides the cells where interpolation, fits and others are "
              "measured. [--fresh 10000]")
@click.option("--fit", default=None, metavar="WAY:DEGREE",
              help="A polynomial of this degree in every axis, by least squares (polynomial:6) or "
              "through Chebyshev's nodes (chebyshev:6), and its worst error. [--fit polynomial:6]")
@click.option("--against", default=None, metavar="FILE|FORMULA",
              help="A table (.npz, .npy, .csv, .exr, .h), a function in a Python file or a formula "
              "to hold against the truth; ';' parts the formulas of several quantities. "
              "[--against fits.py:karis]")
@_options.tolerance(help="Absolute deviation allowed to a fit and to what is held against the "
                    "table; without it they are measured and not judged. [--tolerance 1e-3]")
@click.option("--export", "exports", type=_options.FILE, metavar="FILE", multiple=True,
              help="Write the table as .npz, .csv, .h (C and C++) or .exr; may be given more than "
              "once. [--export lut.h]")
@click.option("--number", type=click.Choice(("float", "half")), default="float", show_default=True,
              help="What numbers are in .h and .exr. [--number half]")
@click.option("--name", default=None, metavar="NAME",
              help="What identifiers in a header begin with. [--name ggx]  [default: the file's]")
@_options.seed()
@_options.threads()
@click.option("--resume", type=_options.FILE, default=None, metavar="FILE",
              help="Keep the cells in FILE, every ten seconds and at Ctrl-C, and go on from them. "
              "[--resume cells.bin]")
@click.option("--format", "form", default=_options.TEXT, show_default=True, metavar="FORM",
              shell_complete=_options.one_of(lambda: _options.FORMATS),
              help=f"What stdout gets: {', '.join(_options.FORMATS)}. [--format json]")
@click.option("--export-json", type=_options.FILE, metavar="FILE",
              help="Write the whole report, with all cells. [--export-json report.json]")
@_options.plot(help="The table, and how far a fit or another table is off, as PNG, SVG or PDF. "
               "[--plot table.png]")
@click.option("--inconclusive", type=click.Choice([p.value for p in Policy]), default=None,
              callback=lambda _, __, word: word and Policy(word),
              help="Count inconclusive as pass (exit 0) or fail (exit 1), not as exit 3.")
@click.option("-q", "--quiet", is_flag=True, help="Print the verdict alone, and no progress.")
def command(
    spec: str, quantity: str | list[str], ranges: tuple[str, ...], assignments: tuple[str, ...],
    theta_o: float, phi_o: float, split: str, target_error: float | None, confidence: float,
    fresh: int, fit: str | None, against: str | None, tolerance: float | None,
    exports: tuple[Path, ...], number: str, name: str | None, seed: int, threads: int | None,
    resume: Path | None, form: str, export_json: Path | None, plot: Path | None,
    inconclusive: Policy | None, quiet: bool,
) -> int:  # fmt: skip
    """A table of what a model reflects, with a certificate for every cell.

    Every cell is estimated until its error is at most --target-error; all errors hold at once with
    --confidence. What is lost between the cells is measured at fresh places. Nothing is judged but
    whether the cells got there, and with --tolerance a fit or somebody else's table.
    """
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.verify.table import Wish, table

    model = loading.load(spec)
    axes, asked = axes_of(ranges, against), _quantities(quantity)
    files = Files(exports, number, export_json, plot, name)
    files.check(len(axes), len(asked))
    model, fixed, formulas = assigned(model, assignments, [axis.name for axis in axes])
    curve = bool(plot or export_json or form == _options.JSON)
    wish = Wish(target_error, confidence, fresh, fit, against, curve)
    with progress(f"table {model.name}") as update:
        answer = table(
            model, axes, asked, fixed=fixed, formulas=formulas, theta_o_deg=theta_o,
            phi_o_deg=phi_o, split=split, wish=wish, tolerance=tolerance, seed=seed,
            threads=threads, resume=resume, progress=update, command=_typed(),
        )  # fmt: skip
    write(answer, files)
    return _deliver(answer, form, inconclusive, quiet)


def axes_of(ranges: Sequence[str], against: str | None) -> tuple[Axis, ...]:
    """The axes as people type them, or those of a table that brings its own."""
    from montecarlo_brdf.table import theirs
    from montecarlo_brdf.table.axes import checked

    brought = theirs.axes_of(against) if against and not ranges else None
    return brought[0] if brought else checked([_axis(text) for text in ranges or USUAL])


def _quantities(asked: str | list[str]) -> list[str]:
    if isinstance(asked, str):
        raise UserError("--quantity takes names: albedo, average, scale, bias, split-sum")
    return asked


def _axis(text: str) -> Axis:
    from montecarlo_brdf.table.axes import Axis, Placement

    match = AXIS.fullmatch(text.strip())
    size = match and _options.whole(match["size"])
    placement = (match and match["placement"]) or str(Placement.CENTRES)
    if placement not in list(Placement):
        raise UserError(f"axis {text!r}: " + unknown("placement", placement, Placement))
    if not match or size is None:
        raise UserError(f"an axis is written NAME=LOW:HIGH:SIZE, as mu=0:1:64, not {text!r}")
    low, high = (_options.number(match[end], f"axis {match['name']}") for end in ("low", "high"))
    return Axis(match["name"], low, high, size, Placement(placement))


def assigned(
    model: Model, assignments: Sequence[str], axes: Sequence[str]
) -> tuple[Model, dict[str, Any], dict[str, str]]:
    """The model with its choices, parameters that are numbers, and those that are formulas."""
    fixed: dict[str, Any] = {}
    formulas: dict[str, str] = {}
    for assignment in assignments:
        name, value = _options.assigned(assignment)
        if name in axes:
            raise UserError(f"{name} is an axis: it cannot be given by -p too")
        if name in model.choices:
            model = model.variant(**{name: str(value)})
        elif isinstance(value, tuple):
            formulas[name] = assignment.partition("=")[2]  # a quotient: a table has no colours
        else:
            fixed[name] = value
    for name, value in [*fixed.items()]:
        try:
            fixed[name] = float(value)
        except ValueError:
            formulas[name] = fixed.pop(name)
    known = {*model.Params._fields, *model.labels.values()}  # type: ignore[attr-defined]
    for name in (*fixed, *formulas):
        if name not in known:
            raise UserError(unknown(f"parameter of model {model.name}", name, known))
    return model, fixed, formulas


def write(answer: Answer, files: Files) -> None:
    """The files asked for."""
    from montecarlo_brdf.files import write_bytes, write_text
    from montecarlo_brdf.report import pictures
    from montecarlo_brdf.table.written import csv, exr, header, npz
    from montecarlo_brdf.table.written.finished import Number

    number = Number(files.number)
    makers = {
        ".npz": lambda path: npz.write(answer.finished),
        ".csv": lambda path: csv.write(answer.finished),
        ".exr": lambda path: exr.write(answer.finished, number),
        ".h": lambda path: header.write(answer.finished, identifier(files.name or path.stem),
                                        number, answer.fit),
    }  # fmt: skip
    for path in files.exports:
        write_bytes(path, makers[path.suffix](path))
    if files.export_json:
        write_text(files.export_json, answer.report.to_json())
    if files.plot:
        write_bytes(files.plot, pictures.drawn(answer.report, pictures.kind_of(files.plot)))


def identifier(text: str) -> str:
    """A name that C takes."""
    made = IDENTIFIER.sub("_", text)
    return made if made[:1].isalpha() else f"table_{made}"


def _typed() -> str:
    """The command line."""
    root = click.get_current_context().find_root()
    return shlex.join(["brdf-check", *(root.obj or [])])


def _deliver(answer: Answer, form: str, policy: Policy | None, quiet: bool) -> int:
    """Print the report; the exit code."""
    from montecarlo_brdf.cli import _terminal
    from montecarlo_brdf.judge.finding import Verdict
    from montecarlo_brdf.report import formats
    from montecarlo_brdf.report import table as report

    told, colour = answer.report, _terminal.colour()
    if form != _options.TEXT:
        click.echo(formats.render(told, form), file=_terminal.stdout(), nl=False)
    elif quiet:
        _terminal.tell(report.summary(told, colour))
    else:
        _terminal.tell(report.render(told, _terminal.width(), colour))
        for quantity, text in answer.fitted().items():
            _terminal.tell(f"{quantity} = {text}")
    undecided = told.verdict == Verdict.INCONCLUSIVE
    return policy.code if policy and undecided else told.exit_code
