"""brdf-check plot"""
from __future__ import annotations

from pathlib import Path

import click

from montecarlo_brdf.cli import _options


@click.command(
    "plot",
    epilog="\b\nExamples:\n  brdf-check plot report.json -o albedo.png\n"
    "  brdf-check plot time.json -o time.svg",
    short_help="Draw a report again without computing again.",
)
@click.argument("report", type=_options.FILE)
@click.option("-o", "--output", type=_options.FILE, required=True, metavar="FILE",
              help="PNG, SVG or PDF. [-o albedo.png]")  # fmt: skip
def command(report: Path, output: Path) -> int:
    """Draw the picture of an exported report, or of the data that bench exported."""
    from montecarlo_brdf.files import check_writable, know_input, write_bytes
    from montecarlo_brdf.report import bench
    from montecarlo_brdf.report.json import read_report
    from montecarlo_brdf.report.pictures import drawn, encoded, kind_of

    kind, data = kind_of(output), bench.read(report)
    earlier = None if data else read_report(report)
    know_input(report)
    check_writable(output)
    if data:
        content = encoded(bench.figure(data), kind)
    elif earlier:
        content = drawn(earlier, kind)
    write_bytes(output, content)
    return 0
