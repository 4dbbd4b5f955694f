"""What commands take: values as people type them (lists, ranges, powers of two, colours), options
that several commands share, as records, and what happens to a finished report."""
from __future__ import annotations

import contextlib
import functools
import inspect
import io
import itertools
import math
import os
import secrets
import shlex
import tokenize
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import click
from click.shell_completion import CompletionItem

from montecarlo_brdf.errors import OutputError, UserError, unknown
from montecarlo_brdf.files import check_writable, write_bytes, write_text
from montecarlo_brdf.judge.finding import Finding, Policy, Report, Verdict
from montecarlo_brdf.model import Model
from montecarlo_brdf.report import formats

MOST_VALUES = 10_000
MOST_SOURCE = 200_000  # bytes of a model's file that reports keep
#: suffixes of files that are no reports
OTHERS = (".py", ".toml", ".png", ".svg", ".pdf", ".npy", ".exr", ".hdr")
MOST_DIGITS = 400  # of a number: more than any double has
TEXT, JSON = "text", "json"
FORMATS = (TEXT, *formats.SUFFIXES)
Command = Callable[..., int]
Option = Callable[[Command], Command]


def shipped(name: str) -> Path:
    """A folder of examples or pages: within the package, or beside it in a clone."""
    package = Path(__file__).parent.parent
    inside = package / name
    return inside if inside.is_dir() else package.parent / name


def number(text: str, what: str) -> float:
    """A finite number, or a UserError."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise UserError(f"{what} must be a finite number, not {text!r}")
    return value


def whole(text: str) -> int | None:
    """The whole number that plain decimal digits stand for, or None."""
    return int(text) if text.isascii() and text.isdigit() and len(text) <= MOST_DIGITS else None


def numbers(text: str, what: str) -> list[float]:
    """'0,30,60' or 'first:last:count' or 'first:last:logcount', in any combination."""
    found: list[float] = []
    for part in text.split(","):
        found += _range(part.strip(), what) if ":" in part else [number(part.strip(), what)]
    return found


def _range(text: str, what: str) -> list[float]:
    first, _, rest = text.partition(":")
    last, _, count_text = rest.partition(":")
    logarithmic = count_text.startswith("log")
    n = whole(count_text.removeprefix("log"))
    if n is None or not 2 <= n <= MOST_VALUES:
        raise UserError(
            f"{what} range {text!r} must be first:last:count or first:last:logcount "
            f"with a count from 2 to {MOST_VALUES}"
        )
    a, b = number(first, what), number(last, what)
    if logarithmic and not (a > 0.0 and b > 0.0):
        raise UserError(f"{what} range {text!r} needs positive ends to be logarithmic")
    steps = [k / (n - 1) for k in range(n)]
    if logarithmic:
        return [a * (b / a) ** t for t in steps]
    return [a + (b - a) * t for t in steps]


def whole_number(text: str, what: str) -> int:
    """A whole number, also written 2^20, 1e6 or 1_000_000."""
    found = _whole_of(text.replace("_", ""))
    if found is None:
        raise ValueError(f"{text!r} is not a whole number (write 65536, 2^16 or 1e6)")
    return found


def _whole_of(text: str) -> int | None:
    base, _, power = text.partition("^")
    if power:
        b, p = whole(base), whole(power)
        return b**p if b is not None and p is not None and b < 1 << 64 and p <= 64 else None
    try:
        value = float(text)
    except ValueError:
        return None
    exact = whole(text.removeprefix("-"))
    if exact is not None:
        return -exact if text.startswith("-") else exact
    return int(value) if value.is_integer() else None


def read_seed(text: str, what: str) -> int:
    """A seed, drawn and told if it is 'random', or a UserError."""
    if text == "random":
        drawn = secrets.randbits(32)
        click.echo(f"seed {drawn}", err=True)
        return drawn
    found = whole(text)
    if found is None or found >= 1 << 64:
        allowed = "a whole number from 0 to 2^64 - 1, or random"
        raise UserError(f"{what} must be {allowed}, not {text!r}")
    return found


def listed(text: str, what: str) -> str | list[str]:
    """'all', or names separated by commas; whether they exist is checked where they are used."""
    return text if text == "all" else [name.strip() for name in text.split(",")]


def together(parts: Sequence[str | list[str]]) -> tuple[str, ...] | None:
    """The names of an option that was given several times, each once; None for 'all' alone."""
    names = [n for part in parts for n in ([part] if isinstance(part, str) else part)]
    return None if names == ["all"] else tuple(dict.fromkeys(names))


class Read(click.ParamType):  # type: ignore[type-arg]  # generic only from click 8.4 on
    """What a function makes of a text; its range is checked where it is used.

    The function gets the option's name for a UserError; the sentence of a ValueError is a usage
    error of the option.
    """

    def __init__(self, function: Callable[[str, str], Any], name: str = "text") -> None:
        self._function, self.name = function, name

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The value."""
        what = max(param.opts, key=len).lstrip("-") if param else ""
        try:
            return self._function(value, what) if isinstance(value, str) else value
        except ValueError as error:
            self.fail(str(error), param, ctx)


WHOLE = Read(whole_number, "number")


def file_name(text: str, what: str) -> Path:
    """A path; of nothing there is none."""
    if not text.strip():
        raise ValueError("the name of a file is needed, not ''")
    return Path(text)


class FileName(Read):
    """The name of a file, which a shell completes."""

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Leave it to the shell."""
        return [CompletionItem(incomplete, type="file")]


FILE = FileName(file_name, "file")


def finite(allowed: str = "that is finite") -> Read:
    """A finite number in a range that is told."""

    def read(text: str, what: str) -> float:
        try:
            return number(text, what)
        except UserError:
            raise ValueError(f"{text!r} is not a number {allowed}") from None

    return Read(read, "number")


def read_tolerances(text: str, what: str) -> dict[str, float]:
    """{"": 1e-3, "reciprocity": 1e-4} of '1e-3,reciprocity=1e-4'."""
    found: dict[str, float] = {}
    for part in text.split(","):
        name, equals, value = part.rpartition("=")
        try:
            found[name.strip()] = number(value.strip(), what)
        except UserError:
            raise ValueError(f"{value!r} is not a number in [0, 1)") from None
        if equals and not name.strip():
            raise ValueError(f"{part!r} names no check")
    return found


def parameter_sets(model: Model, assignments: Sequence[str]) -> list[Any]:
    """All combinations of -p name=value: lists and ranges make cases, a/b/c makes a colour."""
    listed = axes(assignments, lambda name: model)
    rows: Iterable[tuple[Any, ...]] = itertools.product(*listed.values())
    return [model.parameters(**dict(zip(listed, row, strict=True))) for row in rows]


def axes(assignments: Sequence[str], owner: Callable[[str], Model]) -> dict[str, list[Any]]:
    """The values of every name assigned; `owner` says which model a name belongs to."""
    found: dict[str, list[Any]] = {}
    values: Sequence[Value]
    for assignment in assignments:
        name, text = _parted(assignment)
        values = text.split(",") if name in owner(name).choices else values_of(name, text)
        if name in found:
            raise UserError(f"-p {name} is given twice: write -p {name}=a,b for both values")
        found[name] = [*values]
    count = math.prod(map(len, found.values()))
    if count > MOST_VALUES:
        raise UserError(f"{count} parameter sets are more than the {MOST_VALUES} allowed")
    return found


Value = str | float | tuple[str, ...]


def values_of(name: str, text: str) -> list[Value]:
    """Values as the model will check them: it knows what is allowed and says so."""
    found: list[Value] = []
    for part in map(str.strip, text.split(",")):
        found += _range(part, name) if ":" in part else [_value(part)]
    return found


def assigned(assignment: str) -> tuple[str, Value]:
    """name=value with a single value."""
    name, text = _parted(assignment)
    return name, _value(text)


def _parted(assignment: str) -> tuple[str, str]:
    name, equals, text = assignment.partition("=")
    if not equals or not text:
        raise UserError(f"-p takes name=value, not {assignment!r}")
    return name.strip(), text


def _value(text: str) -> Value:
    return tuple(text.split("/")) if "/" in text else text


def models_of(spec: str) -> list[str]:
    """'all', or names, patterns of files and folders, separated by commas."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._specs import expanded

    found = listed(spec, "model")
    if isinstance(found, str):
        return loading.names()
    return [one for name in found for one in expanded(name)]


def model_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[str]:
    """Completion of --model."""
    from montecarlo_brdf.loading import names

    return [n for n in names() if n.startswith(incomplete)]


Complete = Callable[[click.Context, click.Parameter, str], list[str]]


def one_of(names: Callable[[], Iterable[str]]) -> Complete:
    """Completion of a name, and of the last of several with commas."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[str]:
        before, comma, last = incomplete.rpartition(",")
        return [f"{before}{comma}{name}" for name in names() if name.startswith(last)]

    return complete


def check_names() -> list[str]:
    """For --check."""
    from montecarlo_brdf import checks

    return ["all", *checks.names()]


def point_sets() -> list[str]:
    """For --points."""
    from montecarlo_brdf.sampling.points import SETS

    return [str(name) for name in SETS]


def sampler_names() -> list[str]:
    """For --sampler."""
    from montecarlo_brdf.estimate.samplers import SAMPLERS

    return ["all", *map(str, SAMPLERS)]


def parameter_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[str]:
    """Completion of -p: the parameters and choices of the model, once it is known."""
    from montecarlo_brdf import loading

    name, equals, value = incomplete.partition("=")
    try:
        model = loading.load(str(ctx.params.get("spec") or ctx.params.get("model")))
    except UserError:
        return []
    if equals:
        options = model.choices.get(name, {})
        return [f"{name}={option}" for option in options if option.startswith(value)]
    fields = (model.labels.get(n, n) for n in model.Params._fields)
    return [f"{n}=" for n in (*fields, *model.choices) if n.startswith(name)]


#: options that several commands have, some with a help of their own
model = partial(
    click.option, "--model", "spec", metavar="MODEL", shell_complete=model_names,
    help="A built-in model, my_brdf.py, my_brdf.py:name, a shader, or a measured "
    "merl:my.binary. [--model lambert]",
)  # fmt: skip
parameters = partial(
    click.option, "-p", "--param", "assignments", multiple=True, metavar="NAME=VALUE",
    shell_complete=parameter_names,
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
    click.option, "--threads", type=WHOLE,
    help="Threads; results do not depend on it. [--threads 1]  [default: all]",
)  # fmt: skip
tolerance = partial(
    click.option, "--tolerance", type=finite("in [0, 1)"),
    help="Allowed deviation: relative from a reference [default: 1e-4], absolute from a bound "
    "[default: 1e-5]. [--tolerance 1e-3]",
)  # fmt: skip
#: the same for a command that asks several checks: {check: tolerance}, of all under ""
tolerances = partial(
    tolerance, type=Read(read_tolerances, "number"), metavar="NUMBER|CHECK=NUMBER",
    help="Allowed deviation of values: relative from a reference [default: 1e-4], absolute from a "
    "bound [default: 1e-5]. Of a single check by name, as laws (reciprocity, isotropy, positivity) "
    "keep theirs. [--tolerance 1e-3,reciprocity=1e-4]",
)  # fmt: skip
#: what the catalogue is printed as
plain_format = partial(
    click.option, "--format", "form", type=click.Choice((TEXT, JSON)), default=TEXT,
    show_default=True, help="What stdout gets. [--format json]",
)  # fmt: skip
plot = partial(click.option, "--plot", type=FILE, metavar="FILE")


watch = partial(
    click.option, "--watch", is_flag=True,
    help="Go on: run again when the model's file changes, or what it imports or includes, and tell "
    "what changed first; Ctrl-C ends with the last exit code.",
)  # fmt: skip


#: gathers a report, shows it to a function, delivers it; the exit code
Answer = Callable[[Callable[[Report], None]], int]


def answered(answer: Answer, watch: bool) -> int:
    """The exit code of an answer, or with --watch of the last."""
    if not watch:
        return answer(lambda report: None)
    from montecarlo_brdf.cli._watch import watched

    return watched(answer)


class Sampling(NamedTuple):
    """How to sample, as verify's questions take it."""

    points: str
    samples: int | None
    seed: int
    threads: int | None
    tolerance: Any  # float | None, or those of checks

    def keywords(self) -> dict[str, Any]:
        """The arguments of a question; samples that were not given are left to it."""
        return {k: v for k, v in self._asdict().items() if k != "samples" or v is not None}


def sampling_options(command: Command, allowed: Callable[[], Option] = tolerance) -> Command:
    """--points, --samples, --seed, --threads, --tolerance, as one argument `sampling`."""
    return gathered(command, "sampling", Sampling, [
        click.option("--points", default="sobol", show_default=True, metavar="SET",
                     shell_complete=one_of(point_sets),
                     help="Point set: sobol, independent, stratified or lattice. "
                     "[--points independent]"),
        click.option("--samples", type=WHOLE, default=None,
                     help="The most samples a claim may take; it stops sooner where it is decided. "
                     "[--samples 2^20]  [default: 2^22; run: 2^20]"),
        seed(),
        threads(),
        allowed(),
    ])  # fmt: skip


def output_options(command: Command) -> Command:
    """--format, --export, --export-json, --inconclusive, --verbose, and the command's --plot if it
    has one, as one argument `output`."""
    return gathered(command, "output", Output, [
        click.option("--format", "form", default=TEXT, show_default=True, metavar="FORM",
                     shell_complete=one_of(lambda: FORMATS),
                     help=f"What stdout gets: {', '.join(FORMATS)}. [--format junit]"),
        click.option("--export", "exports", type=FILE, metavar="FILE",
                     multiple=True,
                     help="Write the report in the format of the suffix: .html, .json, "
                     ".xml (JUnit), .md, .csv, .sarif; may be given more than once. "
                     "[--export junit.xml]"),
        click.option("--export-json", type=FILE, metavar="FILE",
                     help="Write the whole report. [--export-json report.json]"),
        click.option("--inconclusive", type=click.Choice([p.value for p in Policy]), default=None,
                     callback=lambda _, __, word: word and Policy(word),
                     help="Count inconclusive as pass (exit 0) or fail (exit 1), not as exit 3."),
        click.option("-v", "--verbose", is_flag=True,
                     help="Show every estimator of every finding."),
        click.option("-q", "--quiet", is_flag=True,
                     help="Print the verdict alone, and no progress."),
    ])  # fmt: skip


def gathered(
    command: Command, name: str, record: Callable[..., Any], options: list[Option]
) -> Command:
    """Some options as one argument of the command: a record with a field for each."""

    @functools.wraps(command)
    def call(**values: Any) -> int:
        fields = {k: values.pop(k) for k in inspect.signature(record).parameters if k in values}
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
    quiet: bool = False
    plot: Path | None = None

    def check(self) -> None:
        """Complain about outputs before hours of work, not after."""
        if self.form not in FORMATS:
            raise UserError(unknown("format", self.form, FORMATS))
        for path in filter(None, (self.export_json, self.plot, *self._files())):
            check_writable(path)
        if self.export_json:
            check_suffix(self.export_json, "json")
        if self.plot:
            from montecarlo_brdf.report.pictures import kind_of

            kind_of(self.plot)

    def draws(self) -> bool:
        """Whether a picture will be drawn of the report, now or later."""
        return bool(self.plot or {"json", "html"} & {self.form, *self._files().values()})

    def _files(self) -> dict[Path, str]:
        """What to write besides pictures: file -> format."""
        found = {path: format_of(path) for path in self.exports}
        return {**found, **({self.export_json: "json"} if self.export_json else {})}


def format_of(path: Path) -> str:
    """The format that a suffix stands for."""
    known = formats.suffixes()
    if path.suffix not in known:
        raise UserError(unknown(f"format for {path}: suffix", path.suffix, known))
    return known[path.suffix]


def check_suffix(path: Path, form: str) -> None:
    """Raise UserError if a name says that the file is of another format."""
    ours = formats.SUFFIXES[form]
    if path.suffix.lower() in {*formats.suffixes(), *OTHERS} - {ours}:
        raise UserError(f"cannot write {form} to {path}: the name must end in {ours}")


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
    wanted = {"html", "json"} & {output.form, *output._files().values()}
    if wanted and (files := sources(report)):
        report.measured["sources"] = files
    if "html" in {output.form, *output._files().values()}:
        report.measured["repeat"] = repeated()
    for path, form in output._files().items():
        write_text(path, formats.render(report, form))
    from montecarlo_brdf.cli import _terminal

    if output.form != TEXT:
        click.echo(formats.render(report, output.form), file=_terminal.stdout(), nl=False)
    else:
        from montecarlo_brdf.report import text

        colour = _terminal.colour()
        if output.quiet:
            _terminal.tell(text.summary(report, colour))
        else:
            _terminal.tell(text.render(report, output.verbose, _terminal.width(), colour))
    if output.form == "github":
        _summarise(report)
    for sentence in dict.fromkeys(f.note for f in errors(report)):
        click.echo(f"Error: {sentence}", err=True)
    undecided = report.verdict == Verdict.INCONCLUSIVE
    return policy.code if policy and undecided else report.exit_code


def repeated() -> str:
    """The command line that was typed."""
    return shlex.join(["brdf-check", *(click.get_current_context().find_root().obj or [])])


def sources(report: Report) -> dict[str, str]:
    """The files of the user's models, for pages that show them."""
    files = dict.fromkeys(r.source["file"] for r in report.results if r.source)
    found = {}
    for name in files:
        with contextlib.suppress(OSError):
            found[name] = _decoded(Path(name).read_bytes()[:MOST_SOURCE])
    return found


def _decoded(content: bytes) -> str:
    """A source by the encoding that it declares, as Python reads it; what is none is replaced."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(content).readline)
    except SyntaxError:
        encoding = "utf-8"
    return content.decode(encoding, errors="replace")


def errors(report: Report) -> list[Finding]:
    """Findings of models that could not be run."""
    return [f for r in report.results for f in r.findings if f.verdict == Verdict.ERROR]


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
