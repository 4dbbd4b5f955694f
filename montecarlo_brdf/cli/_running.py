"""What `run` does once its options are known."""
from __future__ import annotations

import gc
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options, _project
from montecarlo_brdf.cli._jobs import Job, from_options
from montecarlo_brdf.cli._progress import progress
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Finding, Report, Result, versions
from montecarlo_brdf.report import baseline
from montecarlo_brdf.report.read import read_report
from montecarlo_brdf.verify.common import Deadline

INTERRUPTED = 130
#: options that stand above a project's file if they are given -> the field of Job
ABOVE = {k: k for k in ("samples", "points", "tolerance", "effort")}
#: options that only make sense with --model
LOCAL = {
    "assignments": "-p",
    "names": "--check",
    "theta_o": "--theta-o",
    "phi_o": "--phi-o",
    "against": "--against",
}


def run_all(options: dict[str, Any], given: Sequence[str]) -> int:
    """Run the checks of every model asked for and deliver one report; the exit code.

    given: the options that were given, not left at their defaults.
    """
    _options.check_outputs(options["form"], options["export_json"])
    versions()  # imports what a report needs while no thread imports anything, and not after Ctrl-C
    _options.import_format(options["form"])
    earlier = read_report(options["baseline"]) if options["baseline"] else None
    seed = _options.seed_of(options["seed"])
    if options["spec"]:
        jobs = from_options(options, seed)
    else:
        project = _asked_project(options, seed, given)
        jobs = project.jobs
        options["max_time"] = options["max_time"] or project.max_time
        options["inconclusive"] = options["inconclusive"] or project.inconclusive
    report = gather(jobs, options)
    if report.measured["interrupted"]:
        gc.disable()  # with a compiler in memory a collection takes long, and the end is near
    code = _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )
    if report.measured["interrupted"]:
        return INTERRUPTED
    return code if earlier is None else _difference(report, earlier)


def _difference(report: Report, earlier: dict[str, Any]) -> int:
    """Tell on stderr what changed; the exit code counts only what got worse."""
    found = baseline.changes(report.to_dict(), earlier)
    for change in found:
        click.echo(str(change), err=True)
    worse = sum(change.kind in baseline.KINDS[:2] for change in found)
    click.echo(f"baseline: {worse} worse, {len(found) - worse} other changes", err=True)
    code = baseline.exit_code(found)
    policy = report.settings.get("inconclusive")
    return {"pass": 0, "fail": 1}.get(str(policy), code) if code == 3 else code


def _asked_project(options: dict[str, Any], seed: int, given: Sequence[str]) -> _project.Project:
    """The project of --config, or of the folder one stands in."""
    path = options["config"] or _project.find(Path())
    if path is None:
        raise UserError(
            f"give --model, or a {_project.FILE} with [[models]] in this folder or one above it"
        )
    local = [flag for name, flag in LOCAL.items() if name in given]
    if local:
        raise UserError(f"{', '.join(local)} needs --model: {path} says what to check of which")
    overrides = {field: options[name] for name, field in ABOVE.items() if name in given}
    return _project.read(path, {**overrides, **({"seed": seed} if "seed" in given else {})})


def gather(jobs: Sequence[Job], options: dict[str, Any]) -> Report:
    """One report over all jobs, also when it is interrupted."""
    limit = options["max_time"]
    if limit is not None and not limit > 0.0:
        raise UserError(f"max-time must be a positive number of seconds, not {limit}")
    deadline = Deadline(math.inf if limit is None else limit)
    reports: list[Report] = []
    try:
        with progress("run") as update:
            for k, job in enumerate(jobs):
                share = lambda done, k=k: update((k + done) / len(jobs))  # noqa: E731
                rest = {"threads": options["threads"], "deadline": deadline, "progress": share}
                reports.append(job.run(**rest))
                if reports[-1].measured["interrupted"]:
                    break
    except KeyboardInterrupt:  # between two runs
        reports.append(_not_begun(jobs[len(reports)]))
    if reports[-1].measured["interrupted"]:
        reports += [_not_begun(job) for job in jobs[len(reports) :]]
    return merged(reports)


def _not_begun(job: Job) -> Report:
    """What an interruption leaves of a job."""
    finding = Finding("run", {}, "inconclusive", note="not begun: interrupted")
    result = Result(job.model.name, {}, "run", [finding])
    return Report("run", {}, [result], {"seconds": 0.0, "interrupted": True})


def merged(reports: list[Report]) -> Report:
    """One report of several; the settings are those of the first."""
    measured = {
        "seconds": sum(r.measured["seconds"] for r in reports),
        "interrupted": any(r.measured["interrupted"] for r in reports),
    }
    results = [result for r in reports for result in r.results]
    return Report(reports[0].command, reports[0].settings, results, measured)
