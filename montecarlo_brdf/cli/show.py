"""brdf-check show"""

from __future__ import annotations

import json

import click

from montecarlo_brdf.cli import _options

EPILOG = """\b
Examples:
  brdf-check show lambert
  brdf-check show ggx --format json
"""


@click.command("show", epilog=EPILOG, short_help="All about a model.")
@click.argument("spec", metavar="MODEL", shell_complete=_options.model_names)
@_options.plain_format()
def command(spec: str, form: str) -> int:
    """Formula, units, source, parameters, sampling, what the model claims and what it disclaims."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli import _catalogue
    from montecarlo_brdf.cli._terminal import colour, tell
    from montecarlo_brdf.foreign import translation
    from montecarlo_brdf.report.columns import Style, painted

    model = loading.load(spec)
    if form == _options.JSON:
        tell(json.dumps(_catalogue.data(model), indent=1))
    else:
        name = painted(model.name, Style.BOLD, colour())
        text = model.namespace.get(translation.TEXT)  # what a shader became
        became = ["", "in Python:", "", text] if text else []
        tell("\n".join([name, *_catalogue.page(model), *became]))
    return 0
