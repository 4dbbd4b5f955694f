"""brdf-check show"""

from __future__ import annotations

import click

from montecarlo_brdf.cli._options import model_names


@click.command(
    "show", epilog="\b\nExample:\n  brdf-check show lambert", short_help="All about a model."
)
@click.argument("spec", metavar="MODEL", shell_complete=model_names)
def command(spec: str) -> int:
    """Formula, units, source, parameters, sampling, what the model claims and what it disclaims."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._catalogue import page
    from montecarlo_brdf.cli._terminal import colour, tell
    from montecarlo_brdf.report.columns import Style, painted

    model = loading.load(spec)
    tell("\n".join([painted(model.name, Style.BOLD, colour()), *page(model)]))
    return 0
