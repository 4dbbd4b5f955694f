"""The line of a TOML file on which a key stands; tomllib does not tell."""

from __future__ import annotations

import re
from collections.abc import Mapping

HEADER = re.compile(r"^\s*(\[\[?)\s*([\w.\-\"' ]+?)\s*\]\]?\s*(#.*)?$")


KEY = re.compile(r"^\s*([\w.\-\"']+)\s*=")


Path_ = tuple[str | int, ...]


def line_of(text: str, path: Path_) -> int | None:
    """The line of a key or table: that of the longest part of `path` that stands in the text."""
    best, at = 0, None
    here: Path_ = ()
    counts: dict[str, int] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        if header := HEADER.match(line):
            name = header.group(2)
            here = tuple(_names(name))
            if header.group(1) == "[[":
                counts[name] = counts.get(name, -1) + 1
                here = (*here, counts[name])
            found = here
        elif key := KEY.match(line):
            found = (*here, *_names(key.group(1)))
        else:
            continue
        shared = _shared(_flat(found, counts), path)
        if shared > best and shared in (len(found), len(path)):
            best, at = shared, number
    return at


def _names(dotted: str) -> list[str]:
    return [part.strip(" \"'") for part in dotted.split(".")]


def _flat(found: Path_, counts: Mapping[str, int]) -> Path_:
    """A table below an array of tables belongs to its latest element."""
    name = str(found[0])
    if name in counts and (len(found) < 2 or not isinstance(found[1], int)):
        return (name, counts[name], *found[1:])
    return found


def _shared(a: Path_, b: Path_) -> int:
    n = 0
    while n < min(len(a), len(b)) and a[n] == b[n]:
        n += 1
    return n
