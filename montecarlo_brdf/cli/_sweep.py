"""--executor, --shard, --results: the requests of a command as tasks for workers of any kind, and
the report that their answers make."""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.report.json import diagnosis_of, result_of
from montecarlo_brdf.verify.question import INTERRUPTED, failed, merged, shown_parameters

if TYPE_CHECKING:
    from montecarlo_brdf.cli._requests import Broken, Request
    from montecarlo_brdf.model import Model
    from montecarlo_brdf.sweep.shards import Shard
    from montecarlo_brdf.sweep.task import Task
    from montecarlo_brdf.sweep.texts import Texts
    from montecarlo_brdf.verify.supervision import Deadline



class Sweep(NamedTuple):
    """Who is asked, which part, and where answers are kept."""

    executor: str | None
    shard: Shard | None
    results: Path | None

    @property
    def wanted(self) -> bool:
        """Whether anything was said of it: else a command asks as it always did."""
        return any(one is not None for one in self)


def options(command: _options.Command) -> _options.Command:
    """--executor, --shard, --results, as one argument `sweep`."""
    return _options.gathered(command, "sweep", Sweep, [
        click.option("--executor", metavar="WORKERS", default=None,
                     help="Who answers, a parameter set at a time: threads, processes, "
                     "processes:COUNT or dask://HOST:PORT. [--executor processes:8]"),
        click.option("--shard", type=_options.Read(_shard), metavar="I/N", default=None,
                     help="Only this part of the parameter sets; brdf-check merge makes one report "
                     "of all parts. [--shard 1/3]"),
        click.option("--results", type=_options.FILE, metavar="FILE", default=None,
                     help="Add every answer to FILE at once, and go on from what it holds. "
                     "[--results answers.jsonl]"),
    ])  # fmt: skip


def _shard(text: str, what: str) -> Shard:
    from montecarlo_brdf.sweep.shards import shard

    return shard(text)


def of_requests(requests: Sequence[Request | Broken], texts: Texts) -> Iterator[Task | Report]:
    """A task for each parameter set of each request of `run`."""
    from montecarlo_brdf.cli._requests import Broken
    from montecarlo_brdf.sweep.task import Task
    from montecarlo_brdf.sweep.texts import files_of

    for request in requests:
        if isinstance(request, Broken):
            yield failed(Command.RUN, request.name, request.error)
            continue
        against = request.terms.against
        specs, files = files_of([request.model.name, *([against] if against else [])], texts)
        terms = {**request.terms._asdict(), "fixed": [*request.fixed]}
        terms["tolerances"] = dict(request.terms.tolerances)
        terms["against"] = specs[1] if against else None
        for one in request.single():
            params = _plain(one.model, one.p[0]) if one.p else None
            yield Task(Command.RUN, specs[0], one.model.name, params, terms, files)


def of_sets(
    command: Command, model: Model, sets: Sequence[Any], terms: dict[str, Any], texts: Texts
) -> Iterator[Task]:
    """A task for each parameter set of one model. terms: the rest of what the question takes."""
    from montecarlo_brdf.sweep.task import Task
    from montecarlo_brdf.sweep.texts import files_of

    (spec,), files = files_of([model.name], texts)
    for p in sets:
        yield Task(command, spec, model.name, _plain(model, p), terms, files)


def _plain(model: Model, p: Any) -> dict[str, Any]:
    return shown_parameters(model.of(p), p)


def swept(
    command: Command, items: Sequence[Task | Report], texts: Texts, sweep: Sweep,
    threads: int | None, limit: Deadline,
) -> Report:  # fmt: skip
    """The report of a sweep, or of its part; what is not answered in time is inconclusive."""
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.sweep import pools, shards, task
    from montecarlo_brdf.sweep.engine import Engine
    from montecarlo_brdf.sweep.journal import Journal

    part = sweep.shard or shards.Shard()
    mine = {place: items[place] for place in part.places(len(items))}
    if not mine:
        raise UserError(f"there are {len(items)} parameter sets: part {part} has none")
    todo = [one for one in mine.values() if not isinstance(one, Report)]
    journal = Journal(sweep.results, task.identity())
    why, interrupted = "--max-time was over", False
    try:
        with (
            progress(f"{command} of {len(mine)}") as update,
            pools.pool(sweep.executor or pools.THREADS, threads) as pool,
        ):
            Engine(pool, texts, journal).ask(todo, limit, update)
    except KeyboardInterrupt:
        why, interrupted = "interrupted", True
    finally:
        journal.close()
    reports = {place: _report(command, one, journal.answers, why) for place, one in mine.items()}
    report = merged([*reports.values()])
    report.measured[INTERRUPTED] = interrupted
    if sweep.shard:
        keys = [repr(one.results) if isinstance(one, Report) else one.key for one in items]
        counts = {place: len(report.results) for place, report in reports.items()}
        report.measured[shards.NOTE] = shards.note(part, keys, counts)
    return report


def _report(
    command: Command, one: Task | Report, answers: dict[str, dict[str, Any]], why: str
) -> Report:
    if isinstance(one, Report):
        return one
    answer = answers.get(one.key)
    if answer is None:
        told = Finding(command, {}, Verdict.INCONCLUSIVE, note=f"not answered: {why}")
        results = [Result(one.name, one.params or {}, command, [told])]
        return Report(command, {}, results, {"seconds": 0.0, INTERRUPTED: False})
    measured = {"seconds": answer["seconds"], "seconds_of_results": answer["times"]}
    results = [result_of(result) for result in answer["results"]]
    found = [diagnosis_of(d, results) for d in answer.get("diagnosis", [])]
    measured[INTERRUPTED] = False
    return Report(command, answer["settings"], results, measured, diagnosis=found)


def refuse(sweep: Sweep, **others: object) -> None:
    """Raises UserError if a sweep is asked for together with something that knows none."""
    for name, value in others.items():
        if sweep.wanted and value:
            flags = [f"--{field}" for field, said in sweep._asdict().items() if said is not None]
            raise UserError(f"give --{name} or {flags[0]}, not both")


