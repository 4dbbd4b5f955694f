"""Measuring: every method's time and true error, then all that reach the target side by side.

Machines are shared and their clocks vary: only ratios of times taken in turns within one run are
comparable, so the chosen settings are timed round after round and the ratio is taken per round.
Seconds are of the processor, not of the clock on the wall: other programs do not count.
"""
from __future__ import annotations

import contextlib
import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from bench import peers
from bench.workloads import Workload
from montecarlo_brdf.estimate.estimators import directional_albedo

OURS = "brdf-check"
TARGETS = (1e-3, 1e-6, 1e-9)
SEEDS = 6
PATIENCE = 0.2  # seconds that one run may take; greater efforts are left out
LONG_ENOUGH = 2e-3  # seconds that are timed at once


class Timing(NamedTuple):
    """One setting of one method on one workload."""

    method: str
    setting: str
    seconds: float
    error: float  # root mean square over seeds, relative to the truth


def ours(work: Workload) -> peers.Runs:
    """Our adaptive estimate through the public API, 16 replicates: N is not known beforehand."""
    model, p = work.model, work.p
    for target in TARGETS:

        def run(seed: int, target: float = target) -> float:
            found: float = directional_albedo(
                model, p, work.theta_o_deg, target_error=target, seed=seed
            ).mean
            return found

        yield f"target {target:g}", run


METHODS: dict[str, Callable[[Workload], peers.Runs]] = {OURS: ours, **peers.PEERS}


def sweep(work: Workload, names: Sequence[str]) -> Iterator[tuple[Timing, peers.Run]]:
    """Time and error of every setting of every method that is installed."""
    for name in names:
        with _left_out(name, work):
            theirs = name == "mitsuba llvm" and work.model_name == "ggx"
            truth = separable(work) if theirs else work.truth()
            for setting, run in METHODS[name](work):
                timing = _timed(name, setting, run, truth)
                yield timing, run
                if timing.seconds > PATIENCE:
                    break


@contextlib.contextmanager
def _left_out(name: str, work: Workload) -> Iterator[None]:
    """Say which peer is not measured, and why; cubepy gives up with a warning."""
    try:
        yield
    except (ImportError, RuntimeWarning) as reason:
        print(f"{work.name}: {name} left out: {reason}", file=sys.stderr)


def separable(work: Workload) -> float:
    """Mitsuba's own truth: its masking is separable, so it is not measured against ours."""
    from montecarlo_brdf import references
    from montecarlo_brdf.vectors import from_degrees

    values = {**work.parameters, "distribution": "ggx", "masking": "separable"}
    mu = from_degrees(work.theta_o_deg)[2]
    found = references.albedo("cook_torrance", mu, **values, fresnel="one")
    assert found is not None
    return found.value


def _timed(name: str, setting: str, run: peers.Run, truth: float) -> Timing:
    run(0)  # compiles
    errors, best = [], math.inf
    for seed in range(1, SEEDS + 1):
        started = time.process_time()
        value = run(seed)
        best = min(best, time.process_time() - started)
        errors.append((value / truth - 1.0) ** 2)
        if best > PATIENCE:
            break
    return Timing(name, setting, best, math.sqrt(math.fsum(errors) / len(errors)))


def fastest(found: Sequence[tuple[Timing, peers.Run]], target: float) -> dict[str, Any]:
    """Per method its fastest setting whose true error meets the target.

    For peers that take a tolerance also what they need when asked for the target, as we are.
    """
    chosen: dict[str, tuple[Timing, peers.Run]] = {}
    for timing, run in found:
        name = timing.method
        if name == OURS and timing.setting != f"target {target:g}":
            continue
        if timing.error > target:
            continue
        if name not in chosen or timing.seconds < chosen[name][0].seconds:
            chosen[name] = (timing, run)
        if timing.setting in (f"epsrel {target:g}", f"rtol {target:g}"):
            chosen[f"{name}, asked"] = (timing, run)
    return chosen


def interleaved(chosen: dict[str, Any], rounds: int) -> dict[str, list[float]]:
    """Seconds of each method in each round, all methods in turn."""
    repeats = {n: max(1, math.ceil(LONG_ENOUGH / t.seconds)) for n, (t, _) in chosen.items()}
    seconds: dict[str, list[float]] = {n: [] for n in chosen}
    for k in range(rounds):
        for name, (_, run) in chosen.items():
            started = time.process_time()
            for i in range(repeats[name]):
                run(1 + k * repeats[name] + i)
            seconds[name].append((time.process_time() - started) / repeats[name])
    return seconds


def compare(work: Workload, names: Sequence[str], rounds: int) -> dict[str, Any]:
    """All about one workload as plain data."""
    found = list(sweep(work, names))
    targets = {}
    for target in TARGETS:
        chosen = fastest(found, target)
        targets[f"{target:g}"] = _ratios(chosen, interleaved(chosen, rounds))
    return {
        "workload": work.name,
        "title": work.title,
        "truth": work.truth(),
        "timings": [t._asdict() for t, _ in found],
        "targets": targets,
    }


def _ratios(chosen: dict[str, Any], seconds: dict[str, list[float]]) -> list[dict[str, Any]]:
    rows = []
    for name, times in seconds.items():
        row = {"method": name, "setting": chosen[name][0].setting, "seconds": quartiles(times)}
        if OURS in seconds:
            ratios = [a / b for a, b in zip(times, seconds[OURS], strict=True)]
            row["ratio"] = quartiles(ratios)
        rows.append(row)
    return sorted(rows, key=lambda r: r["seconds"][1])


def quartiles(values: Sequence[float]) -> tuple[float, float, float]:
    """(lower quartile, median, upper quartile)."""
    ranked = sorted(values)
    low, middle, high = (ranked[round(q * (len(ranked) - 1))] for q in (0.25, 0.5, 0.75))
    return low, middle, high
