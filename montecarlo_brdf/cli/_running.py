"""What `run` does once its options are known."""
from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf import loading, verify
from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._progress import progress
from montecarlo_brdf.cli._values import number, numbers, parameter_sets
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.report.findings import Report

INTERRUPTED = 130


def run_all(options: dict[str, Any]) -> int:
    """Run the checks of every model asked for and deliver one report; the exit code."""
    _options.check_outputs(options["form"], options["export_json"])
    report = gather(options)
    code = _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )
    return INTERRUPTED if report.measured.get("interrupted") else code


def gather(options: dict[str, Any]) -> Report:
    """One report over all models."""
    specs = models_of(options["spec"])
    seed = _options.seed_of(options["seed"])
    limit = options["max_time"]
    if limit is not None and not limit > 0.0:
        raise UserError(f"max-time must be a positive number of seconds, not {limit}")
    deadline = verify.Deadline(math.inf if limit is None else limit)
    reports: list[Report] = []
    with progress("run") as update:
        for k, spec in enumerate(specs):
            reports.append(
                _one(spec, options, seed, deadline, lambda done, k=k: update((k + done) / len(specs)))
            )
            if reports[-1].measured.get("interrupted"):
                break
    return merged(reports)


def _one(spec: str, options: dict[str, Any], seed: int, deadline: Any, update: Any) -> Report:
    model = loading.load(spec)
    assignments = options["assignments"]
    names = options["names"]
    return verify.run(
        model,
        parameter_sets(model, assignments) if assignments else None,
        names=None if names == "all" else names.split(","),
        theta_o_deg=numbers(options["theta_o"], "theta-o"),
        phi_o_deg=number(options["phi_o"], "phi-o"),
        fixed=[a.partition("=")[0] for a in assignments],
        against=loading.load(options["against"]) if options["against"] else None,
        points=options["points"],
        samples=verify.RUN_SAMPLES if options["samples"] is None else options["samples"],
        seed=seed,
        threads=options["threads"],
        tolerance=options["tolerance"],
        deadline=deadline,
        progress=update,
    )


def models_of(spec: str) -> list[str]:
    """'all', or names separated by commas."""
    if spec == "all":
        return loading.names()
    return [one.strip() for one in spec.split(",")]


def merged(reports: list[Report]) -> Report:
    """One report of several; settings are the same in all."""
    measured = {
        "seconds": sum(r.measured["seconds"] for r in reports),
        "interrupted": any(r.measured.get("interrupted") for r in reports),
    }
    results = [result for r in reports for result in r.results]
    return Report(reports[0].command, reports[0].settings, results, measured)
