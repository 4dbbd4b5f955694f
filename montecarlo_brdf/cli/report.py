"""brdf-check report"""

from __future__ import annotations

from pathlib import Path

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check report report.json -o report.html
  brdf-check report furnace.json run.json -o report.html
  brdf-check report report.json -o report.md
"""


@click.command("report", epilog=EPILOG, short_help="Exported reports as a page, or as others.")
@click.argument("reports", nargs=-1, required=True, type=_options.FILE)
@click.option("-o", "--output", type=_options.FILE, required=True, metavar="FILE",
              help="A page, .html, of several reports too; of one also .md, .xml, .csv, .sarif. "
              "[-o report.html]")  # fmt: skip
def command(reports: tuple[Path, ...], output: Path) -> int:
    """Write exported JSON reports in another format, without computing again."""
    from montecarlo_brdf.files import check_writable, know_input, write_text
    from montecarlo_brdf.report import bench, formats, html
    from montecarlo_brdf.report.json import read_report

    form = _options.format_of(output)
    measured = bench.read(reports[0]) if (form, len(reports)) == ("html", 1) else None
    read = [] if measured else [read_report(path) for path in reports]
    for path in reports:
        know_input(path)
    check_writable(output)
    if len(read) > 1 and form != "html":
        raise UserError(f"several reports make one .html page, not {output}")
    try:
        if measured:
            content = bench.page(measured)
        else:
            content = html.page(read) if form == "html" else formats.render(read[0], form)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        sentence = f"the reports cannot be shown: {type(error).__name__} {error}"
        raise UserError(sentence) from error
    write_text(output, content)
    return 0
