"""brdf-check furnace"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import INTERRUPTED, _options, _sweep
from montecarlo_brdf.cli._options import TEXT, Read, finite, listed, models_of, parameter_sets
from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.judge.finding import Command, Report

EPILOG = """\b
Examples:
  brdf-check furnace --model lambert
  brdf-check furnace --model lambert_unnormalised -p c=0.5
  brdf-check furnace --model my_brdf.py --theta-o 0:85:18 --plot albedo.png
  brdf-check furnace --model lambert -p albedo=0.9/0.5/0.1 --format json
  brdf-check furnace --model all
  brdf-check furnace --model ggx -p alpha=0.05 --target-error 1e-6
  brdf-check furnace --model my_brdf.py --watch
"""


@click.command("furnace", epilog=EPILOG, short_help="White furnace test: albedo against angle.")
@_options.model(required=True)
@_options.parameters()
@_options.theta_o(default="0,15,30,45,60,75,85",
                  help="Polar angles of the viewer in [0, 90): a list, or first:last:count. "
                  "[--theta-o 0:85:18]")  # fmt: skip
@_options.phi_o()
@click.option("--sampler", type=Read(listed), default="all", show_default=True, metavar="NAMES",
              shell_complete=_options.one_of(_options.sampler_names),
              help="all, or some of uniform, cosine, own. [--sampler cosine,own]")  # fmt: skip
@click.option("--target-error", type=finite("in [1e-13, 1)"), default=None,
              help="Sample until the 99 % interval of A is as narrow, relative to A. "
              "[--target-error 1e-6]")  # fmt: skip
@click.option("--method", default=None, metavar="NAME",
              help="auto chooses chart or sampler and points for the model and tells why; given "
              "keeps --sampler and --points. [--method auto]  "
              "[default: auto with --target-error]")  # fmt: skip
@_options.sampling_options
@click.option("--resume", type=_options.FILE, default=None, metavar="FILE",
              help="Keep partial sums in FILE, every ten seconds and at Ctrl-C, and go on from "
              "them: for billions of samples. [--resume sums.json]")  # fmt: skip
@_options.watch()
@_sweep.options
@_options.output_options
@_options.plot(
    help="Albedo against angle with error bars and reference, as PNG, SVG or PDF. [--plot a.png]"
)
def command(
    spec: str, assignments: tuple[str, ...], theta_o: list[float], phi_o: float,
    sampler: str | list[str], target_error: float | None, method: str | None, resume: Path | None,
    watch: bool, sampling: _options.Sampling, output: _options.Output,
    sweep: _sweep.Sweep,
) -> int:  # fmt: skip
    """How much of a constant light 1 does the surface reflect, and is that what theory says?

    Two claims per angle: the albedo A equals its reference within the tolerance, and A <= 1. Each
    is estimated by every sampler that can be trusted for the case.
    """
    from montecarlo_brdf.verify.furnace import partial_sums

    if watch and resume:
        raise UserError("give --watch or --resume, not both: sums of an f before an edit are lost")

    _sweep.refuse(sweep, watch=watch, resume=resume)
    terms = dict(
        theta_o_deg=theta_o, phi_o_deg=phi_o, sampler=sampler, target_error=target_error,
        method=method, **sampling.keywords(),
    )  # fmt: skip

    def answer(show: Callable[[Report], None]) -> int:
        with partial_sums(resume) as sums:
            if sweep.wanted:
                report = spread(models_of(spec), assignments, output, sweep, **terms)
            else:
                report = gather(models_of(spec), assignments, output, sums=sums, **terms)
        show(report)
        code = _options.deliver(report, output)
        return INTERRUPTED if report.measured.get("interrupted") else code

    return _options.answered(answer, watch)


def gather(
    specs: Sequence[str], assignments: Sequence[str], output: _options.Output, **terms: Any
) -> Report:
    """One report over all models. terms: the rest of what `verify.furnace` takes."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.verify.furnace import furnace
    from montecarlo_brdf.verify.question import failed, merged, part_of

    models, reports = [loading.load(one) for one in specs], []
    output.check()
    with progress("furnace", output.form == TEXT) as update:
        for k, model in enumerate(models):
            part = part_of(update, k, len(models))
            sets = parameter_sets(model, assignments)
            try:
                report = furnace(
                    model, sets, progress=part, heard=update.hear, curve=output.draws(), **terms
                )
                reports.append(report)
            except ModelError as error:
                if len(models) == 1:
                    raise
                reports.append(failed(Command.FURNACE, model.name, error))
    return merged(reports)


def spread(
    specs: Sequence[str], assignments: Sequence[str], output: _options.Output,
    sweep: _sweep.Sweep, threads: int | None, **terms: Any,
) -> Report:  # fmt: skip
    """The same by tasks that workers answer."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.sweep.texts import Texts
    from montecarlo_brdf.verify.supervision import Deadline

    output.check()
    texts, items, terms = Texts(), list[Any](), {**terms, "curve": output.draws()}
    for spec in specs:
        model = loading.load(spec)
        sets = parameter_sets(model, assignments)
        items += _sweep.of_sets(Command.FURNACE, model, sets, terms, texts)
    return _sweep.swept(Command.FURNACE, items, texts, sweep, threads, Deadline())
