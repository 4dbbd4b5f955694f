"""brdf-check models"""

from __future__ import annotations

import json

import click

from montecarlo_brdf.cli import _options

EPILOG = """\b
Examples:
  brdf-check models
  brdf-check models --format json
"""


@click.command("models", epilog=EPILOG, short_help="What models there are.")
@_options.plain_format()
def command(form: str) -> int:
    """All built-in models: what each is, its parameters, reference and disclaimers. Ranges and
    choices of one: brdf-check show MODEL."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli import _catalogue
    from montecarlo_brdf.cli._terminal import colour, tell, width
    from montecarlo_brdf.report.columns import table

    models = [loading.load(name) for name in loading.names()]
    if form == _options.JSON:
        tell(json.dumps([_catalogue.data(model) for model in models], indent=1))
    else:
        rows = [_catalogue.row(model) for model in models]
        tell("\n".join(table(_catalogue.COLUMNS, rows, width(), colour())))
    return 0
