"""What a sweep costs besides the work: processor time against the number of tasks, on a Dask
cluster of two worker processes on this machine.

Processor time of the process that asks, of the scheduler (with the processes that watch over the
workers) and of the workers, for tasks that do nothing but answer as a furnace test does; a task a
request, and as the engine groups them. Then 2,000 tasks that last 0.2 s each: what it all cost,
as a share of the work.

Run: python scripts/scale.py (half an hour on two busy cores; writes scripts/results/scale.json and
docs/figures/scale.png), or with the names of PARTS to measure these anew, or with --draw to draw
again what was measured.
"""
from __future__ import annotations

import contextlib
import functools
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from environment import describe

SCRIPTS = Path(__file__).parent
RECORD = SCRIPTS / "results" / "scale.json"
FIGURE = SCRIPTS.parent / "docs" / "figures" / "scale.png"
LASTING, COUNT = 0.2, 2000  # seconds of a task, and how many
#: part -> (tasks, seconds of each, whether each is a request)
PARTS = {
    "single": [(n, 0.0, True) for n in (100, 300, 1000)],
    "grouped": [(n, 0.0, False) for n in (100, 1000, 10_000, 100_000)],
    "lasting": [(COUNT, LASTING, False)],
}
CLUSTER = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0",
                      silence_logs=50) as cluster:
        workers = [w.process.pid for w in cluster.workers.values()]
        print(cluster.scheduler_address.removeprefix("tcp://"), *workers, flush=True)
        sys.stdin.read()
"""


def idle(asked: str, sent: Mapping[str, bytes], threads: int | None) -> str:
    """What a worker answers that only waits, for as long as tasks say."""
    from montecarlo_brdf.sweep import task as tasks

    answers = []
    for one in tasks.read(asked):
        seconds = float(one.terms["seconds"])
        time.sleep(seconds)
        answers.append({**typical(), "seconds": seconds})
    return json.dumps({"identity": tasks.identity(), "answers": answers})


@functools.cache
def typical() -> dict[str, Any]:
    """The answer to a furnace test of one angle."""
    from montecarlo_brdf import furnace, load

    report = furnace(load("lambert"), theta_o_deg=60.0, samples=1 << 10)
    return {"settings": report.settings, "results": report.to_dict()["results"], "times": [0.0]}


@contextlib.contextmanager
def cluster() -> Iterator[tuple[str, dict[str, list[int]]]]:
    """Its address, and the processes of the scheduler and of the workers."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "local_cluster.py"
        script.write_text(CLUSTER, encoding="utf-8")
        path = os.pathsep.join([str(SCRIPTS), str(SCRIPTS.parent)])
        begun = subprocess.Popen(
            [sys.executable, str(script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True, env={**os.environ, "PYTHONPATH": path},
        )  # fmt: skip
        assert begun.stdin and begun.stdout
        address, *workers = begun.stdout.readline().split()
        yield address, {"scheduler": [begun.pid], "workers": [*map(int, workers)]}
        begun.stdin.close()
        begun.wait()


def spent(processes: Mapping[str, list[int]]) -> dict[str, float]:
    """Processor seconds so far, by who spent them."""
    import psutil

    found = {"client": time.process_time()}
    for who, pids in processes.items():
        times = [psutil.Process(pid).cpu_times() for pid in pids]
        found[who] = sum(t.user + t.system for t in times)
    return found


def measured(count: int, seconds: float, single: bool) -> dict[str, Any]:
    """What some tasks cost. single: a task a request."""
    from scale import idle as perform  # by name, as workers import it

    from montecarlo_brdf.judge.finding import Command
    from montecarlo_brdf.sweep import engine, pools, task
    from montecarlo_brdf.sweep.journal import Journal
    from montecarlo_brdf.sweep.task import Task
    from montecarlo_brdf.sweep.texts import Texts
    from montecarlo_brdf.verify.supervision import Deadline

    engine.MOST = 1 if single else MOST
    with cluster() as (address, processes), tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "answers.jsonl"
        with pools.pool(f"{pools.DASK}{address}", None) as pool:

            def ask(n: int, about: str) -> None:
                terms = {"seconds": seconds, "about": about}
                todo = [Task(Command.FURNACE, "lambert", "lambert", {"k": k}, terms)
                        for k in range(n)]  # fmt: skip
                journal = Journal(path, task.identity())
                engine.Engine(pool, Texts(), journal, perform).ask(todo, Deadline())
                journal.close()

            ask(4, "warm")  # imports
            before, began = spent(processes), time.perf_counter()
            ask(count, "measured")
            after, wall = spent(processes), time.perf_counter() - began
        began_reading = time.process_time()
        assert len(Journal(path, task.identity()).answers) == count + 4
        reading = time.process_time() - began_reading
    row = {"tasks": count, "seconds_of_a_task": seconds, "single": single, "wall": wall,
           "reading": reading, **{who: after[who] - before[who] for who in after}}  # fmt: skip
    print({k: round(v, 3) if isinstance(v, float) else v for k, v in row.items()}, flush=True)
    return row


def draw(parts: Mapping[str, Any]) -> None:
    """Processor seconds against tasks."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.4, 3.6), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True, sharex=True)
    titles = {"single": "a task a request", "grouped": "as the engine groups them"}
    styles = {
        "client": ("process that asks", "#D55E00", "o"), "scheduler": ("scheduler", "#0072B2", "s"),
        "workers": ("two workers", "#009E73", "^"),
    }  # fmt: skip
    for axes, (part, title) in zip(panels, titles.items(), strict=True):
        rows = parts[part]
        for who, (name, colour, marker) in styles.items():
            axes.loglog([r["tasks"] for r in rows], [r[who] for r in rows], color=colour,
                        marker=marker, markersize=5, label=name)  # fmt: skip
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("tasks that do nothing")
        axes.grid(alpha=0.25, which="both")
    panels[0].set_ylabel("processor time (s)")
    panels[0].legend(fontsize=8)
    figure.savefig(FIGURE, dpi=150)


MOST = 0


def main() -> None:
    """Measure and draw."""
    global MOST
    from montecarlo_brdf.sweep import engine

    MOST = engine.MOST
    asked = [] if "--draw" in sys.argv[1:] else sys.argv[1:] or [*PARTS]
    found = {part: [measured(*one) for one in PARTS[part]] for part in asked}
    data = json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {"parts": {}}
    if found:
        data = {**describe(), "parts": {**data["parts"], **found}}
        RECORD.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    for row in data["parts"].get("lasting", []):
        cost = sum(row[who] for who in ("client", "scheduler", "workers"))
        share = cost / (row["tasks"] * row["seconds_of_a_task"])
        print(f"{COUNT} tasks of {LASTING} s: {cost:.1f} s beside the work, {share:.1%} of it")
    if data["parts"].keys() == PARTS.keys():
        draw(data["parts"])


if __name__ == "__main__":
    main()
