"""brdf-check schema"""

from __future__ import annotations

import json

import click


@click.command(
    "schema",
    epilog="\b\nExample:\n  brdf-check schema > report.schema.json",
    short_help="The JSON schema of reports.",
)
def command() -> int:
    """What stands in the JSON of --format json and --export report.json, as JSON schema (draft
    2020-12)."""
    from montecarlo_brdf.cli._terminal import tell
    from montecarlo_brdf.report.schema import REPORT

    tell(json.dumps(REPORT, indent=1))
    return 0
