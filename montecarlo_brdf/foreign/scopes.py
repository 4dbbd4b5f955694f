"""What of a shader's text is code, and what of the code stands outside of functions."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable

BRACE = re.compile(r"([{}])")
NOT_CODE = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)


def bare(text: str) -> str:
    """The text with blanks for comments, every character at its place."""
    return NOT_CODE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


@functools.lru_cache(maxsize=1)  # it is asked of every parameter
def depths(text: str) -> list[int]:
    """How many braces are open at each character."""
    found, depth = list[int](), 0
    for part in BRACE.split(text):
        depth -= part == "}"
        found += [depth] * len(part)
        depth += part == "{"
    return found


def rewritten(
    text: str, pattern: re.Pattern[str], change: Callable[[re.Match[str]], str]
) -> str:
    """The text with matches outside of functions and structs changed, and its lines kept."""
    known = depths(text)

    def changed(match: re.Match[str]) -> str:
        if known[match.start()]:
            return match[0]
        new = change(match)
        return new + "\n" * (match[0].count("\n") - new.count("\n"))

    return pattern.sub(changed, text)


def is_set(name: str, statements: str) -> bool:
    """Whether statements assign to a variable, or to a part of it."""
    return bool(re.search(rf"\b{name}\b[\w.\[\]]*\s*=[^=]", statements))
