"""brdf-check identities"""

from __future__ import annotations

from typing import Any

import click

from montecarlo_brdf.cli import _options


@click.command(
    "identities",
    epilog="\b\nExamples:\n  brdf-check identities\n"
    "  brdf-check identities --points independent --tolerance 1e-3",
    short_help="Integrals over the hemisphere that everything rests on.",
)
@_options.sampling_options
@_options.output_options
def command(**options: Any) -> int:
    """Solid angle, projected hemisphere, powers of the cosine, Lambert under a light that is not
    constant: each estimated, with its exact value and a verdict."""
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.verify.common import SAMPLES
    from montecarlo_brdf.verify.identities import identities

    _options.check_outputs(options["form"], options["export_json"])
    with progress("identities") as update:
        report = identities(
            points=options["points"],
            samples=SAMPLES if options["samples"] is None else options["samples"],
            seed=_options.seed_of(options["seed"]),
            threads=options["threads"],
            tolerance=options["tolerance"],
            progress=update,
        )
    return _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )
