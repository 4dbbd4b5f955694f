"""brdf-check doctor"""

from __future__ import annotations

import importlib.util
import platform
import sys

import click

#: what is not always installed, and what it serves
EXTRAS = {
    "slangpy": "shaders as models", "OpenEXR": "reading and writing .exr",
    "colour": "spectra and illuminants in scenes",
    "ml_dtypes": "bfloat16 in stress", "mpmath": "exact arithmetic in stress",
}  # fmt: skip


@click.command(
    "doctor", epilog="\b\nExample:\n  brdf-check doctor", short_help="What this installation has."
)
def command() -> int:
    """Versions, processor, threads, the cache folder and whether it can be written, extras: what a
    report of a bug should say."""
    from montecarlo_brdf.cli._terminal import tell

    for name, value in facts().items():
        tell(f"{name:16} {value}")
    return 0


def facts() -> dict[str, str]:
    """All that results or times may depend on, by name."""
    from montecarlo_brdf.compile import cache, native
    from montecarlo_brdf.judge.finding import versions
    from montecarlo_brdf.verify.question import all_threads

    fault = cache.fault()
    return {
        **versions(),
        "executable": sys.executable,
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "processor": str(native.target()[1]),
        "threads": str(all_threads()),
        "cache": f"{cache.directory()} ({f'cannot be written: {fault}' if fault else 'writable'})",
        **{name: f"{_found(name)} ({purpose})" for name, purpose in EXTRAS.items()},
    }


def _found(name: str) -> str:
    return "found" if importlib.util.find_spec(name) else "not installed"
