"""brdf-check merge"""
from __future__ import annotations

from pathlib import Path

import click

from montecarlo_brdf.cli import _options

EPILOG = """\b
Examples:
  brdf-check merge part1.json part2.json part3.json --export-json whole.json
  brdf-check merge part1.json part2.json part3.json --export report.html --quiet
"""


@click.command("merge", epilog=EPILOG, short_help="One report of the parts that --shard made.")
@click.argument("reports", nargs=-1, required=True, type=_options.FILE)
@_options.output_options
def command(reports: tuple[Path, ...], output: _options.Output) -> int:
    """One report of several that were exported as JSON: of all parts of a sweep (--shard) the same
    results as of the whole, of others one after another. The exit code is that of the whole."""
    from montecarlo_brdf.files import know_input
    from montecarlo_brdf.report.json import read_report
    from montecarlo_brdf.sweep.shards import joined

    for path in reports:
        know_input(path)
    read = {str(path): read_report(path) for path in reports}
    output.check()
    return _options.deliver(joined(read), output)
