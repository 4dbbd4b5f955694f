"""Error against processor time: which of our methods reaches which error how fast."""
from __future__ import annotations

import functools
import itertools
import math
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.plan import Progress, check_theta
from montecarlo_brdf.estimate.samplers import charts_of, samplers_of
from montecarlo_brdf.judge.finding import versions
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import SETS
from montecarlo_brdf.statistics import Estimate
from montecarlo_brdf.verify.converge import reference_of
from montecarlo_brdf.verify.question import shown_parameters

TARGETS = (1e-2, 1e-3, 1e-4, 1e-6)
SIZES = tuple(1 << k for k in range(8, 25))  # 16 replicates: as far as there are lattices


class Timing(NamedTuple):
    """What one number of samples gave with one method."""

    method: str
    target: float | None  # the relative error that "auto" was asked for
    samples: int
    error: float  # root mean square over seeds, relative to the known value
    seconds: float  # of the processor, lowest over seeds: other load disturbs that least


def bench(
    model: Model, p: Any, theta_o_deg: float = 60.0, *, phi_o_deg: float = 0.0,
    method: str | Sequence[str] = "all", seconds: float = 0.05, seeds: int = 8,
    progress: Progress = lambda done: None,
) -> dict[str, Any]:  # fmt: skip
    """Times and true errors of estimates of A(wo), and the fastest for each target, as plain data.

    p: a parameter set; of a colour the first channel counts. theta_o_deg, phi_o_deg: the viewer's
    direction in degrees, theta in [0, 90). method: "all", or some by their names, samplers or point
    sets. seconds: the most that one estimate may take. seeds: how many estimates make one error.
    progress: is called with the fraction done. Raises UserError for a bad value and where A is 0 or
    not finite, ModelError if the model does not run.
    """
    case = Case(model.of(p), p, [check_theta(theta_o_deg)], phi_o_deg)
    chosen = _chosen(case.model, {method} if isinstance(method, str) else {*method})
    if not (0.0 < seconds < math.inf and seeds > 0):
        raise UserError(f"seconds and seeds must be above 0, not {seconds:g} and {seeds}")
    probe.check(case.model, p)
    truth = reference_of(case)
    if not math.isfinite(truth.value):
        raise UserError(f"model {model.name} has no finite albedo here: no relative error")
    floor = max(truth.error / abs(truth.value), 2.0**-50)
    timings: list[Timing] = []
    for i, (name, choice) in enumerate(chosen.items()):
        for timing in _climb(case, name, choice, truth.value, seconds, seeds):
            timings.append(timing)
            if choice and timing.error < 2.0 * floor:  # no smaller one could be seen
                break
        progress((i + 1) / len(chosen))
    return {
        "schema": 1, "command": "bench", "versions": versions(),
        "model": model.name, "params": shown_parameters(case.model, case.one),
        "where": case.where(theta_o_deg=case.theta_o_deg[0]), "seconds": seconds, "seeds": seeds,
        "reference": {**truth._asdict(), "relative_error": floor}, "methods": list(chosen),
        "timings": [t._asdict() for t in timings],
        "targets": {f"{t:g}": reached(timings, t) for t in TARGETS if t > floor},
    }  # fmt: skip


def _chosen(model: Model, words: set[str]) -> dict[str, dict[str, str]]:
    """What `directional_albedo` takes for each method meant; "auto" finds its own."""
    samplers = (*charts_of(model), *samplers_of(model))
    pairs = {f"{s} x {q}": {"sampler": s, "points": q} for s in samplers for q in SETS}
    parts, offered = ("all", "auto", *samplers, *SETS), {"auto": {}, **pairs}
    for word in sorted(words - {*parts, *offered}):
        raise UserError(unknown(f"method for model {model.name}", word, parts))
    return {n: c for n, c in offered.items() if words & {"all", n, *c.values()}}


def _climb(
    case: Case, name: str, choice: dict[str, str], truth: float, seconds: float, seeds: int
) -> Iterator[Timing]:
    """More and more samples while all estimates are finite and done in time."""
    albedo = functools.partial(directional_albedo, case.model, case.one, *case.theta_o_deg)
    key, values = ("samples", SIZES) if choice else ("target_error", TARGETS)
    for value in values:
        run = functools.partial(albedo, phi_o_deg=case.phi_o_deg, **choice, **{key: value})
        run(seed=0)  # compiles
        clocked = (_clocked(run, seed) for seed in range(1, seeds + 1))
        done = list(itertools.takewhile(lambda one: one[0] <= seconds, clocked))
        error = math.hypot(*(e.mean / truth - 1.0 for _, e in done)) / math.sqrt(seeds)
        if len(done) < seeds or not math.isfinite(error):
            return
        took, samples = min((t, e.samples) for t, e in done)
        yield Timing(name, None if choice else value, samples, error, took)


def _clocked(run: Callable[..., Estimate], seed: int) -> tuple[float, Estimate]:
    started = time.process_time()
    found = run(seed=seed)
    return time.process_time() - started, found


def reached(timings: Sequence[Timing], target: float) -> list[dict[str, Any]]:
    """Fastest first: of each method the fewest samples that meet the target, as all more do.

    "auto" counts as asked for this target: it has to know by itself when to stop.
    """
    found = []
    for name in dict.fromkeys(t.method for t in timings):
        own = [t for t in timings if t.method == name and t.target in (None, target)]
        found += [*itertools.takewhile(lambda t: t.error <= target, reversed(own))][-1:]
    return [t._asdict() for t in sorted(found, key=lambda t: t.seconds)]
