"""brdf-check bench"""
from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli._values import Whole

EPILOG = """\b
Examples:
  brdf-check bench
  brdf-check bench --workload W3,W4 --rounds 21 --plot time.png
  brdf-check bench --method brdf-check,dblquad --export-json bench.json --markdown bench.md
"""


@click.command("bench", epilog=EPILOG, short_help="Run time against error, peers side by side.")
@click.option("--workload", default="all", show_default=True, metavar="NAMES",
              help="all, or some of W1 to W7: Lambert, Oren-Nayar, GGX 0.3/60, 0.05/80, 0.01/85, "
              "Phong 1e5/75, GGX 0.001/89. [--workload W3]")  # fmt: skip
@click.option("--method", default="all", show_default=True, metavar="NAMES",
              help="all that are installed, or some by name. "
              "[--method brdf-check,dblquad]")  # fmt: skip
@click.option("--rounds", type=Whole(), default="11", show_default=True,
              help="How often all methods are timed in turn. [--rounds 21]")  # fmt: skip
@click.option("--rates", is_flag=True, help="Also time per sample and growth of cost.")
@click.option("--export-json", type=click.Path(path_type=Path), metavar="FILE",
              help="Write all timings. [--export-json bench.json]")  # fmt: skip
@click.option("--markdown", "tables", type=click.Path(path_type=Path), metavar="FILE",
              help="Write the tables. [--markdown bench.md]")  # fmt: skip
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE",
              help="Error against time, log-log, as PNG, SVG or PDF. "
              "[--plot time.png]")  # fmt: skip
def command(**options: Any) -> int:
    """How long does an error of 1e-3, 1e-6, 1e-9 take, with us and with what one could use instead?

    Peers that are not installed are left out: pip install 'montecarlo-brdf[bench]' brings them.
    """
    import json

    from montecarlo_brdf.bench import measure, throughput
    from montecarlo_brdf.bench.workloads import WORKLOADS
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.files import check_writable, write_bytes, write_text
    from montecarlo_brdf.judge.finding import versions
    from montecarlo_brdf.report.bench_markdown import markdown

    paths = [options[k] for k in ("export_json", "tables", "plot")]
    for path in filter(None, paths):
        check_writable(path)
    names = _chosen("method", options["method"], list(measure.METHODS))
    works = _chosen("workload", options["workload"], [w.name for w in WORKLOADS])
    rounds = max(3, options["rounds"])
    with progress("bench") as update:
        results = measure.bench(names, works, rounds, update)
    shown = ", ".join(f"{k} {v}" for k, v in versions().items())
    data = {"schema": 1, "command": "bench", "machine": throughput.processor(), "versions": shown}
    data |= {"rounds": rounds, "results": results}
    if options["rates"]:
        data |= {"rates": throughput.rates(rounds), "growth": throughput.growth(rounds)}
    click.echo(markdown(data), nl=False)
    if options["export_json"]:
        write_text(options["export_json"], json.dumps(data, indent=1) + "\n")
    if options["tables"]:
        write_text(options["tables"], markdown(data))
    if options["plot"]:
        from montecarlo_brdf.report.bench_plots import bench_figure
        from montecarlo_brdf.report.pictures import encoded, kind_of

        write_bytes(options["plot"], encoded(bench_figure(data), kind_of(options["plot"])))
    return 0


def _chosen(kind: str, text: str, offered: list[str]) -> list[str]:
    from montecarlo_brdf.errors import UserError, unknown

    if text == "all":
        return offered
    for name in text.split(","):
        if name not in offered:
            raise UserError(unknown(kind, name, ("all", *offered)))
    return text.split(",")
