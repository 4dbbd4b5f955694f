"""The site of the manual: sphinx-build -W docs build/site, after pip install '.[docs]'."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]

import manual  # noqa: E402

from montecarlo_brdf import __version__  # noqa: E402

if TYPE_CHECKING:
    from sphinx.application import Sphinx

project = "montecarlo_brdf"
author = "the authors of montecarlo_brdf"
html_show_copyright = False
release = __version__
extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = ["conf.py"]

html_theme = "furo"
html_title = f"brdf-check {__version__}"
html_static_path: list[str] = []
html_copy_source = False

myst_heading_anchors = 3
smartquotes = False  # "--" is an option
nitpicky = True
#: in signatures: aliases, types of the standard library, and parts of records that pages describe
OTHERS = r"\w+|(collections|pathlib|montecarlo_brdf\.(model|scene))\..*"
nitpick_ignore_regex = [("py:class", OTHERS)]

autodoc_member_order = "bysource"

#: a link to what is not on the site shows its name; one called after its file shows the title
REWRITTEN = (
    (re.compile(r"\[[^]]+\]\(\.\./([^)]+)\)"), r"`\1`"),
    (re.compile(r"\[(\w+\.md)\]\(\1\)"), r"[](\1)"),
)


def setup(app: Sphinx) -> None:
    """Fill in what is made from the code."""
    app.connect("source-read", _filled)


def _filled(app: Sphinx, name: str, source: list[str]) -> None:
    source[0] = manual.filled(source[0])
    for pattern, replacement in REWRITTEN:
        source[0] = pattern.sub(replacement, source[0])
