"""The furnace test of a model: directional albedo against angle."""
from __future__ import annotations

import contextlib
import functools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import furnace as check
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.plan import Progress, check_theta
from montecarlo_brdf.estimate.samplers import SAMPLERS, samplers_of
from montecarlo_brdf.files import check_writable, write_text
from montecarlo_brdf.judge.finding import Command, Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify import failure
from montecarlo_brdf.verify.question import (
    SAMPLES,
    Heard,
    Question,
    Sets,
    Settings,
    answered,
    chosen,
    parameter_sets,
)

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0)


def furnace(
    model: Model, p: Sets = None, theta_o_deg: Sequence[float] | float = ANGLES, *,
    phi_o_deg: float = 0.0, sampler: str | Sequence[str] = "all", points: str = "sobol",
    samples: int = SAMPLES, seed: int = 0, threads: int | None = None,
    tolerance: float | None = None, target_error: float | None = None, method: str | None = None,
    progress: Progress | None = None, curve: bool = False, sums: PartialSums | None = None,
    heard: Heard | None = None,
) -> Report:  # fmt: skip
    """White furnace test: A(wo) equals its reference and is at most 1, at every angle.

    model: from `load`. p: a parameter set of `model.parameters`, a list of them, or None for the
    defaults. theta_o_deg, phi_o_deg: the viewer's polar angles, one or several, in [0, 90), and
    azimuth, in degrees. sampler: "all" or some of "uniform", "cosine", "own".
    points: "sobol", "independent", "stratified" or "lattice". samples: the most that a claim may
    take, 1 to 2^40; it stops sooner where it is decided. seed: 0 to 2^64 - 1. threads: 1 to 1024,
    None for all processors; no result depends on it. tolerance: in [0, 1), relative for A, absolute
    for A <= 1; None for 1e-4 and 1e-5. target_error: relative; A is sampled until its 99 % interval
    is as narrow. method: "auto" takes the sampler and points that fit the model best, "given" those
    given; None for "auto" with a target. progress: is called with the fraction done. curve: add the
    reference at every degree, for pictures. sums: `partial_sums(file)`, where billions of samples
    survive an interruption. heard: is called with a Result of what was found so far and whether
    that is all of it, after each finding.

    Returns a Report with one Result per parameter set. Raises UserError for a bad value, ModelError
    if the model does not run, TooSlow if it does not return.
    """
    angles: Any = theta_o_deg if isinstance(theta_o_deg, (list, tuple)) else [theta_o_deg]
    thetas = [check_theta(a) for a in angles]
    samplers = _samplers(model, sampler)
    settings = Settings.of(points, samples, seed, threads, tolerance, target_error, method, sums)
    only = None if sampler == "all" else samplers
    cases = [
        Case(model.of(one), one, thetas, phi_o_deg, only, tolerance, seed=seed)
        for one in parameter_sets(model, p)
    ]
    questions = [Question("furnace", case, check.claims) for case in cases]
    count = 2 * len(thetas) * len(cases[0].sets) if cases else 1
    told = {"theta_o_deg": thetas, "phi_o_deg": phi_o_deg, "sampler": samplers}
    told |= {"tolerance": tolerance, **settings.told()}
    report = answered(Command.FURNACE, told, questions, settings.plan, count, progress, heard)
    if not curve:
        return report
    drawn = []
    for c in cases:
        with failure.of_case(c):
            drawn.append(check.curves(c.model, c.p, max(thetas), phi_o_deg))
    results = [replace(r, curves=c) for r, c in zip(report.results, drawn, strict=True)]
    return replace(report, results=results)


def _samplers(model: Model, asked: str | Sequence[str]) -> list[str]:
    """The samplers asked for, if the model offers them."""
    offered = samplers_of(model)
    if "own" in ([asked] if isinstance(asked, str) else asked) and "own" not in offered:
        raise UserError(f"model {model.name} has no sample and pdf, so no sampler of its own")
    return chosen("sampler", asked, offered, SAMPLERS)


@contextlib.contextmanager
def partial_sums(path: str | Path | None) -> Iterator[PartialSums | None]:
    """The partial sums of a run that may be interrupted and taken up again.

    path: their file, written from time to time and at the end, also when the run ends by an error
    or Ctrl-C, whole or not at all; None for none. Raises UserError if there is a file that holds
    anything else, OutputError if it cannot be written.
    """
    if path is None:
        yield None
        return
    from montecarlo_brdf.estimate.partial_sums import PartialSums

    path = Path(path)
    check_writable(path)
    try:
        content = path.read_text(encoding="utf-8") if path.exists() else ""
        sums = PartialSums(functools.partial(write_text, path), content)
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    except (UnicodeDecodeError, UserError) as error:
        raise UserError(f"cannot resume from {path}: {error}") from error
    try:
        yield sums
    finally:
        sums.write()
