"""brdf-check examples"""

from __future__ import annotations

from pathlib import Path

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check examples
  brdf-check examples --copy examples
  brdf-check radiance examples/cook_torrance.toml
"""


@click.command("examples", epilog=EPILOG, short_help="Scenes to begin with.")
@click.option("--copy", "folder", type=_options.FILE, metavar="FOLDER",
              help="Copy them into a folder; what is there is left alone. "
              "[--copy examples]")  # fmt: skip
def command(folder: Path | None) -> int:
    """The scenes that the help texts name: lists them, or copies them to where you are."""
    from montecarlo_brdf.cli._terminal import tell
    from montecarlo_brdf.files import write_bytes

    found = sorted(_options.shipped("examples").glob("*.*"))
    if folder is None:
        tell("\n".join(f"{path.name:24} {_said(path)}" for path in found))
        return 0
    there = [path.name for path in found if (folder / path.name).exists()]
    if there:
        raise UserError(f"{folder} has {', '.join(there)} already: copy to another folder")
    folder.mkdir(parents=True, exist_ok=True)
    for path in found:
        write_bytes(folder / path.name, path.read_bytes())
    tell(f"copied {len(found)} files to {folder}")
    return 0


def _said(path: Path) -> str:
    """The first comment of a file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return next((line.lstrip("# ") for line in lines if line.startswith("#")), "")
