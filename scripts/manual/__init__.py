"""Parts of the manual that are made from the code, each time that the site is built.

A page of docs/ says `<!-- made: NAME -->` where such a part belongs: PARTS has who makes it. What
is made is Markdown, and nothing of it is kept that could grow old.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from manual import api, catalogue, commands, schema

PARTS: dict[str, Callable[[], str]] = {
    "api": api.made,
    "commands": commands.made,
    "models": catalogue.made,
    "schema": schema.made,
}
MARK = re.compile(r"<!-- made: (\w+) -->")


def filled(text: str) -> str:
    """A page with its made parts; KeyError for a part that nobody makes."""
    return MARK.sub(lambda found: PARTS[found[1]](), text)
