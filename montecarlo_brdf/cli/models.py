"""brdf-check models"""

from __future__ import annotations

import click


@click.command(
    "models", epilog="\b\nExample:\n  brdf-check models", short_help="What models there are."
)
def command() -> int:
    """All built-in models: one line each, parameters with their ranges, reference, disclaimers."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli import _catalogue
    from montecarlo_brdf.cli._terminal import colour, tell, width
    from montecarlo_brdf.report.columns import table

    rows = [_catalogue.row(loading.load(name)) for name in loading.names()]
    tell("\n".join(table(_catalogue.COLUMNS, rows, width(), colour())))
    return 0
