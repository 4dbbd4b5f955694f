"""brdf-check run"""
from __future__ import annotations

import functools
import gc
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from montecarlo_brdf.cli import _options, _sweep
from montecarlo_brdf.cli._options import TEXT, Read, finite, listed, models_of
from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.judge import finding
from montecarlo_brdf.judge.finding import (
    EXIT_CODES,
    Command,
    Finding,
    Policy,
    Report,
    Result,
    Verdict,
)

if TYPE_CHECKING:
    from montecarlo_brdf.cli._requests import Broken, Project, Request, Terms
    from montecarlo_brdf.verify.supervision import Deadline

INTERRUPTED = 130
COVERAGE = "coverage"  # the check that tells which lines were not run
#: options that stand above a project's file if they are given
ABOVE = {"samples", "points", "tolerance", "seed", "effort"}
#: options that only make sense with --model
LOCAL = {"assignments": "-p", "named": "--check"}
LOCAL |= {"theta_o": "--theta-o", "phi_o": "--phi-o", "against": "--against"}

EPILOG = """\b
Examples:
  brdf-check run --model ggx
  brdf-check run --model my_brdf.py -p alpha=0.05:1:log5 --check energy,reciprocity
  brdf-check run --model my_ggx.py --against ggx --max-time 10
  brdf-check run --model my_brdf.py --watch
  brdf-check run --model all
  brdf-check run --model 'brdfs/*.py' --executor processes:8 --results answers.jsonl
  brdf-check run                      (all that brdf-check.toml names)
"""


@click.command("run", epilog=EPILOG, short_help="Every check of one, several or all models.")
@_options.model()
@_options.parameters()
@click.option("--config", type=_options.FILE, metavar="FILE",
              help="Without --model: what to check, instead of the nearest brdf-check.toml or "
              "[tool.brdf-check] of a pyproject.toml. [--config ci/brdf-check.toml]")  # fmt: skip
@click.option("--check", "named", type=Read(listed), default=["all"], show_default=True,
              multiple=True, shell_complete=_options.one_of(_options.check_names), metavar="NAMES",
              help="Which checks, separated by commas or given again. [--check energy,pdf]")
@_options.theta_o(default="0,45,80",
                  help="Angles of the viewer in [0, 90) for checks that look at some. "
                  "[--theta-o 0:85:6]")  # fmt: skip
@_options.phi_o()
@click.option("--against", metavar="MODEL",
              help="A model that it must equal in values, its parameters named as in this one. "
              "[--against ggx  --against 'ggx_anisotropic(alpha_x=ax, alpha_y=ay)']")
@click.option("--max-time", type=float, metavar="SECONDS",
              help="Begin no claim after this; the rest is inconclusive. [--max-time 60]")
@click.option("--effort", type=finite("in (0, 1]"), default=1.0, show_default=True,
              help="Share of the pairs, places and nodes that checks look at. [--effort 0.1]")
@click.option("--require-coverage", is_flag=True,
              help="Lines of a model that no check ran leave the verdict inconclusive.")
@click.option("--baseline", type=_options.FILE, metavar="REPORT.json",
              help="Tell what changed since an earlier report; exit with 0 if nothing got worse. "
              "[--baseline main.json]")  # fmt: skip
@_options.watch()
@_sweep.options
@functools.partial(_options.sampling_options, allowed=_options.tolerances)
@_options.output_options
@_options.plot(help="How near every finding came to its tolerance, as PNG, SVG or PDF. "
               "[--plot run.png]")  # fmt: skip
def command(
    spec: str | None, assignments: tuple[str, ...], config: Path | None,
    named: Sequence[str | list[str]], theta_o: list[float], phi_o: float, against: str | None,
    max_time: float | None, effort: float, require_coverage: bool, baseline: Path | None,
    watch: bool, sampling: _options.Sampling, output: _options.Output, sweep: _sweep.Sweep,
) -> int:  # fmt: skip
    """All checks, or those named, with the worst finding of each, its likely cause and a command
    that reproduces it. Parameters without -p are searched over their range for the worst case.
    Without --model: the models and cases of the project's brdf-check.toml
    (brdf-check docs ci)."""
    from montecarlo_brdf.cli._requests import Project, Terms
    from montecarlo_brdf.files import know_input
    from montecarlo_brdf.report.json import read_report
    from montecarlo_brdf.verify.supervision import Deadline

    finding.versions()  # imports what a report needs: no thread does yet, nor Ctrl-C
    _options.import_format(output)
    earlier = read_report(baseline) if baseline else None
    if baseline:
        know_input(baseline)
    if spec and config:
        raise UserError("give --model or --config, not both: the file says what to check")
    if max_time is not None and not max_time > 0.0:
        raise UserError(f"max-time must be a positive number of seconds, not {max_time}")
    _sweep.refuse(sweep, watch=watch)
    names = _options.together(named)
    keywords = sampling.keywords()
    threads = keywords.pop("threads")
    keywords |= {**tolerated(keywords.pop("tolerance")), "effort": effort}

    def answer(show: Callable[[Report], None]) -> int:
        if spec:
            terms = Terms(names, theta_o, phi_o, against, **keywords)
            project = Project(asked_models(models_of(spec), assignments, terms), None, None)
        else:
            project = asked_project(config, keywords)
        policy = output.inconclusive or project.inconclusive
        output.check()
        limit = max_time or project.max_time or math.inf
        if sweep.wanted:
            report = spread(project.requests, sweep, threads, Deadline(limit))
        else:
            report = gather(project.requests, threads, Deadline(limit), output.form == TEXT)
        report = covered(report) if require_coverage else report
        show(report)
        return finish(report, output._replace(inconclusive=policy), earlier)

    return _options.answered(answer, watch)


def tolerated(given: Mapping[str, float] | None) -> dict[str, Any]:
    """Fields of Terms: what is allowed of values, and of single checks."""
    named = {name: value for name, value in (given or {}).items() if name}
    return {"tolerance": (given or {}).get(""), "tolerances": named}


def asked_models(
    specs: Sequence[str], assignments: Sequence[str], terms: Terms
) -> list[Request | Broken]:
    """A request for each model."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli import _requests

    found: list[Request | Broken] = []
    for spec in specs:
        try:
            found.append(_requests.request(loading.load(spec), assignments, terms))
        except ModelError as error:
            found.append(_requests.Broken(spec, error))
    return _requests.unless_all_broken(found)


def asked_project(config: Path | None, options: Mapping[str, object]) -> Project:
    """The project of --config, or of the folder one stands in."""
    from montecarlo_brdf.cli import _requests

    path = config or _requests.find(Path())
    if path is None:
        file = f"a {_requests.FILE} with [[models]] in this folder or one above it"
        raise UserError(f"give --model, or {file}")
    given = given_options()
    local = [flag for name, flag in LOCAL.items() if name in given]
    if local:
        raise UserError(f"{', '.join(local)} needs --model: {path} says what to check of which")
    above = {k: v for k, v in options.items() if k in given & ABOVE}
    if "tolerance" in above:
        above["tolerances"] = options["tolerances"]
    return _requests.read(path, above)


def given_options() -> set[str]:
    """The options of the current command that were given, not left at their defaults."""
    context = click.get_current_context()
    default = (click.core.ParameterSource.DEFAULT, click.core.ParameterSource.DEFAULT_MAP, None)
    return {name for name in context.params if context.get_parameter_source(name) not in default}


def gather(
    requests: Sequence[Request | Broken], threads: int | None, deadline: Deadline,
    results: bool = False,
) -> Report:  # fmt: skip
    """One report over all requests, also when it is interrupted. results: show them on a terminal
    as they are decided."""
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.verify.question import failed, merged, part_of

    reports: list[Report] = []
    try:
        with progress("run", results) as update:
            for k, one in enumerate(requests):
                part = part_of(update, k, len(requests))
                try:
                    reports.append(one.run(deadline, threads, part, update.hear))
                except ModelError as error:
                    if len(requests) == 1:
                        raise
                    reports.append(failed(Command.RUN, one.title(), error))
                if reports[-1].measured["interrupted"]:
                    break
    except KeyboardInterrupt:  # between two runs
        reports.append(_not_begun(requests[len(reports)]))
    if reports[-1].measured["interrupted"]:
        reports += [_not_begun(one) for one in requests[len(reports) :]]
    return merged(reports)


def spread(
    requests: Sequence[Request | Broken], sweep: _sweep.Sweep, threads: int | None, limit: Deadline
) -> Report:
    """The same by tasks that workers answer."""
    from montecarlo_brdf.sweep.texts import Texts

    texts = Texts()
    items = [*_sweep.of_requests(requests, texts)]
    return _sweep.swept(Command.RUN, items, texts, sweep, threads, limit)


def covered(report: Report) -> Report:
    """The report, inconclusive where it tells of lines that no check ran."""

    def strict(result: Result) -> Result:
        told = [replace(f, verdict=Verdict.INCONCLUSIVE) if f.verdict == Verdict.KNOWN else f
                for f in result.findings]  # fmt: skip
        return replace(result, findings=told) if result.check == COVERAGE else result

    return replace(report, results=[strict(result) for result in report.results])


def _not_begun(request: Request | Broken) -> Report:
    """What an interruption leaves of a request."""
    told = Finding("run", {}, Verdict.INCONCLUSIVE, note="not begun: interrupted")
    result = Result(request.title(), {}, "run", [told])
    return Report(Command.RUN, {}, [result], {"seconds": 0.0, "interrupted": True})


def finish(report: Report, output: _options.Output, earlier: Report | None) -> int:
    """Deliver the report; the exit code, which with a baseline counts what got worse."""
    if report.measured["interrupted"]:
        gc.disable()  # with a compiler in memory a collection takes long, and the end is near
        _options.deliver(report, output)
        return INTERRUPTED
    code = _options.deliver(report, output)
    return code if earlier is None else _difference(report, earlier, output.inconclusive)


def _difference(report: Report, earlier: Report, policy: Policy | None) -> int:
    """Tell on stderr what changed; the exit code counts only what got worse."""
    from montecarlo_brdf.report import baseline

    found = baseline.changes(report, earlier)
    for change in found:
        click.echo(str(change), err=True)
    worse = sum(change.kind in baseline.KINDS[:2] for change in found)
    click.echo(f"baseline: {worse} worse, {len(found) - worse} other changes", err=True)
    code = baseline.exit_code(found)
    return policy.code if policy and code == EXIT_CODES[Verdict.INCONCLUSIVE] else code
