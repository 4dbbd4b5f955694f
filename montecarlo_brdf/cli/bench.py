"""brdf-check bench"""
from __future__ import annotations

import json
from pathlib import Path

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._options import finite, parameter_sets
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check bench --model ggx -p alpha=0.05 --theta-o 80
  brdf-check bench --model my_brdf.py --quick --plot time.png
  brdf-check bench --model my_brdf.py --method "auto,own,cosine x sobol" --export time.json
  brdf-check bench --model my_brdf.py --quick --export time.html
"""


@click.command("bench", epilog=EPILOG, short_help="Error against run time, method by method.")
@_options.model(required=True)
@_options.parameters()
@_options.theta_o(type=finite("in [0, 90)"), default="60",
                  help="Polar angle of the viewer in degrees, in [0, 90). [--theta-o 80]")
@_options.phi_o()
@click.option("--method", default="all", show_default=True, metavar="NAMES",
              help="all, or some: auto, a sampler, a point set, 'own x sobol'. [--method auto,own]")
@click.option("--seconds", type=finite("above 0"), default="0.05", show_default=True,
              help="The most processor time of one estimate. [--seconds 1]")
@click.option("--quick", is_flag=True, help="A tenth of the time, and 4 seeds instead of 8.")
@click.option("--json", "as_json", is_flag=True, help="Print the data as JSON, not as tables.")
@click.option("--export", "exports", type=_options.FILE, metavar="FILE", multiple=True,
              help="Write the data, .json, or a page, .html; may be given more than once. "
              "[--export time.json]")
@_options.plot(help="Error against time, log-log, as PNG, SVG or PDF. [--plot time.png]")
def command(
    spec: str,
    assignments: tuple[str, ...],
    theta_o: float,
    phi_o: float,
    method: str,
    seconds: float,
    quick: bool,
    as_json: bool,
    exports: tuple[Path, ...],
    plot: Path | None,
) -> int:  # fmt: skip
    """Which method reaches an error of 1e-2, 1e-3, 1e-4, 1e-6 in which time?

    A method is a sampler or chart with a point set, shown with the fewest samples that suffice, or
    auto, as in --target-error, which has to find all by itself. Errors are true ones, against the
    model's reference, else a quadrature or a precise estimate of its f; of a colour the first
    channel counts. There is no verdict.
    """
    from montecarlo_brdf import files, loading
    from montecarlo_brdf.cli._terminal import progress, tell, width
    from montecarlo_brdf.report import bench as report
    from montecarlo_brdf.report import formats
    from montecarlo_brdf.report.pictures import encoded, kind_of
    from montecarlo_brdf.verify import failure
    from montecarlo_brdf.verify.bench import bench

    model = loading.load(spec)
    for path in (*exports, *filter(None, [plot])):
        files.check_writable(path)
    for path in exports:
        if path.suffix != formats.SUFFIXES["html"]:
            _options.check_suffix(path, "json")
    kind = kind_of(plot) if plot else ""
    sets = parameter_sets(model, assignments)
    if len(sets) > 1:
        raise UserError(f"bench takes one parameter set, not {len(sets)}: one value for each -p")
    most, seeds = (0.1 * seconds, 4) if quick else (seconds, 8)
    asked = failure.located(model, lambda: sets, [theta_o])
    with progress(f"bench {model.name}") as update, asked:
        data = bench(model, sets[0], theta_o, phi_o_deg=phi_o, method=method.split(","),
                     seconds=most, seeds=seeds, progress=update)  # fmt: skip
    text = json.dumps(data, indent=1, allow_nan=False) + "\n"
    tell(text if as_json else report.table(data, width()))
    for path in exports:
        page = path.suffix == formats.SUFFIXES["html"]
        files.write_text(path, report.page(data, _options.repeated()) if page else text)
    if plot:
        files.write_bytes(plot, encoded(report.figure(data), kind))
    return 0
