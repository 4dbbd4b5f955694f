"""What stdout is, and what it is given: text in columns, with or without colour."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Sequence

import click

from montecarlo_brdf.report.columns import Column, Row, table
from montecarlo_brdf.report.text import PLAIN_WIDTH


def width() -> int:
    """Characters of a line: of the terminal, or what a page has room for."""
    known = sys.stdout is not None and sys.stdout.isatty()
    return shutil.get_terminal_size((PLAIN_WIDTH, 24)).columns if known else PLAIN_WIDTH


def colour() -> bool:
    """Whether stdout gets colours: as https://no-color.org and https://force-color.org say."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown"):
        return False
    forced = os.environ.get("FORCE_COLOR")
    return bool(forced) or (sys.stdout is not None and sys.stdout.isatty())


def tell(text: str) -> None:
    """Print text that may have colours."""
    click.echo(text, nl=not text.endswith("\n"), color=colour())


def tell_table(columns: Sequence[Column], rows: Sequence[Row]) -> None:
    """Print a table."""
    tell("\n".join(table(columns, rows, width(), colour())))
