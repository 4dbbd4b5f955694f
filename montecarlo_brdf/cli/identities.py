"""brdf-check identities"""

from __future__ import annotations

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
@_options.plot(help="How near every finding came to its tolerance, as PNG, SVG or PDF. "
               "[--plot identities.png]")  # fmt: skip
def command(sampling: _options.Sampling, output: _options.Output) -> int:
    """Solid angle, projected hemisphere, powers of the cosine, Lambert under a light that is not
    constant: each estimated, with its exact value and a verdict."""
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.verify.identities import identities

    output.check()
    with progress("identities") as update:
        report = identities(progress=update, **sampling.keywords())
    return _options.deliver(report, output)
