"""brdf-check plot"""
from __future__ import annotations

from pathlib import Path

import click


@click.command(
    "plot",
    epilog="\b\nExample:\n  brdf-check plot report.json -o albedo.png",
    short_help="Draw a report again without computing again.",
)
@click.argument("report", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), required=True, metavar="FILE",
              help="PNG, SVG or PDF. [-o albedo.png]")  # fmt: skip
def command(report: Path, output: Path) -> int:
    """Draw the picture of an exported report."""
    from montecarlo_brdf.files import check_writable, write_bytes
    from montecarlo_brdf.report.json import read_report
    from montecarlo_brdf.report.pictures import drawn, kind_of

    check_writable(output)
    write_bytes(output, drawn(read_report(report), kind_of(output)))
    return 0
