"""brdf-check doctor"""

from __future__ import annotations

import importlib.util
import platform
import sys

import click

#: what is not always installed, and what it serves
EXTRAS = {
    "slangpy": "shaders as models", "watchfiles": "telling --watch of changes",
    "distributed": "sweeps on a Dask cluster",
    "OpenEXR": "reading and writing .exr",
    "colour": "spectra and illuminants in scenes",
    "ml_dtypes": "bfloat16 in stress", "mpmath": "exact arithmetic in stress",
}  # fmt: skip


@click.command(
    "doctor", epilog="\b\nExample:\n  brdf-check doctor", short_help="What this installation has."
)
def command() -> int:
    """Versions, processor, threads, the folders of the cache, how full they are and how often
    something was found there, extras: what a report of a bug should say."""
    from montecarlo_brdf.cli._terminal import tell

    for name, value in facts().items():
        tell(f"{name:16} {value}")
    return 0


def facts() -> dict[str, str]:
    """All that results or times may depend on, by name."""
    from montecarlo_brdf.compile import native
    from montecarlo_brdf.judge.finding import versions
    from montecarlo_brdf.verify.question import all_threads

    return {
        **versions(),
        "executable": sys.executable,
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "processor": str(native.target()[1]),
        "threads": str(all_threads()),
        **_cache(),
        **{name: f"{_found(name)} ({purpose})" for name, purpose in EXTRAS.items()},
    }


def _cache() -> dict[str, str]:
    """The folders of the cache, how full they are, and what it was good for."""
    from montecarlo_brdf.compile import folders

    fault, written = folders.fault(), folders.directory()
    told = {}
    for k, folder in enumerate(folders.folders()):
        above = f"cannot be written: {fault}" if fault else "writable"
        state = above if folder == written else "only read"
        files = folders.stored(folder)
        most = f" of {_megabytes(folders.limit())}" if folder == written else ""
        size = f"{_megabytes(sum(file.size for file in files))}{most} in {len(files)} files"
        told[f"cache {k + 1}" if k else "cache"] = f"{folder} ({state}), {size}"
    asked, found = folders.uses()
    return told | {"cache uses": f"{found} found, {asked - found} not, of the last {asked}"}


def _megabytes(size: int) -> str:
    return f"{size / (1 << 20):.1f} MB"


def _found(name: str) -> str:
    return "found" if importlib.util.find_spec(name) else "not installed"
