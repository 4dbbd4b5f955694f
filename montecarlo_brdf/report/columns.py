"""Columns of text for a terminal of any width: a number is never torn.

What does not fit is tried in this order: words wrap within their column, the gaps shrink, and
columns leave the line one by one for lines below each row, those of the highest `fold` first.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import NamedTuple

GAPS = (2, 1)
LONGEST_WORD = 20  # in a column of words, longer ones are broken
INDENT = "    "
NO_BREAK = "\xa0"  # stands for a space at which a line must not end


class Style(StrEnum):
    """The codes of ECMA-48 that a terminal is sent."""

    NONE = ""
    BOLD = "1"
    DIM = "2"
    LOUD = "1;31"  # bold red
    GREEN = "32"
    YELLOW = "33"
    CYAN = "36"


class Column(NamedTuple):
    """A name and how the cells below it are set."""

    name: str
    fold: int = 0  # 0: never leaves the line
    right: bool = False
    words: bool = False  # may go on in the next line
    style: Callable[[str], Style] = lambda cell: Style.NONE


class _Bounds(NamedTuple):
    """The narrowest and the widest that a column can be."""

    least: int
    most: int


class _Layout(NamedTuple):
    shown: list[int]
    widths: list[int]
    gap: int


Row = Sequence[str]  # one cell per column


def table(
    columns: Sequence[Column], rows: Sequence[Row], width: int, colour: bool = False
) -> list[str]:
    """Lines of at most `width` characters, unless a single number is longer: names, then rows.
    A column without content is left out."""
    used = [k for k in range(len(columns)) if not rows or any(row[k] for row in rows)]
    columns, rows = [columns[k] for k in used], [[row[k] for k in used] for row in rows]
    layout = _layout(columns, rows, width)
    heads = [
        textwrap.wrap(columns[k].name, w, break_long_words=False) or [""]
        for k, w in zip(layout.shown, layout.widths, strict=True)
    ]
    height = max(map(len, heads))
    lines = _lines(columns, layout, [[""] * (height - len(h)) + h for h in heads], colour=False)
    folded = [k for k in range(len(columns)) if k not in layout.shown]
    for row in rows:
        lines += _lines(columns, layout, _cells(columns, layout, row), colour)
        lines += _below([(columns[k], row[k]) for k in folded], width)
    return [line.replace(NO_BREAK, " ").rstrip() for line in lines]


def painted(text: str, style: Style, colour: bool) -> str:
    """Text in a style, where there is colour."""
    return f"\x1b[{style}m{text}\x1b[0m" if colour and style and text else text


def _layout(columns: Sequence[Column], rows: Sequence[Row], width: int) -> _Layout:
    """What stands in the line, and how wide; the narrowest there is if nothing fits."""
    bounds = [_bounds(column, [row[k] for row in rows]) for k, column in enumerate(columns)]
    shown = list(range(len(columns)))
    while True:
        kept = [bounds[k] for k in shown]
        for gap in GAPS:
            room = width - gap * (len(shown) - 1)
            if sum(b.least for b in kept) <= room:
                return _Layout(shown, _shrunk(kept, room), gap)
        last = max(reversed(shown), key=lambda k: columns[k].fold)
        if not columns[last].fold:
            return _Layout(shown, [b.least for b in kept], GAPS[-1])
        shown.remove(last)


def _bounds(column: Column, cells: Sequence[str]) -> _Bounds:
    longest = max(map(len, cells), default=0)
    if column.words:
        longest = min(max((len(w) for c in cells for w in c.split(" ")), default=0), LONGEST_WORD)
    head = max(map(len, column.name.split(" ")))
    return _Bounds(max(head, longest), max(map(len, [column.name, *cells])))


def _shrunk(bounds: Sequence[_Bounds], room: int) -> list[int]:
    """The widest gives first, until all fit."""
    widths = [b.most for b in bounds]
    while sum(widths) > room:
        _, widest = max((w, k) for k, w in enumerate(widths) if w > bounds[k].least)
        widths[widest] -= 1
    return widths


def _cells(columns: Sequence[Column], layout: _Layout, row: Row) -> list[list[str]]:
    """The lines of every cell that is shown."""
    return [
        (textwrap.wrap(row[k], w, break_on_hyphens=False) or [""]) if columns[k].words else [row[k]]
        for k, w in zip(layout.shown, layout.widths, strict=True)
    ]


def _lines(
    columns: Sequence[Column], layout: _Layout, cells: list[list[str]], colour: bool
) -> list[str]:
    found = []
    for i in range(max(map(len, cells))):
        parts = []
        for k, width, lines in zip(layout.shown, layout.widths, cells, strict=True):
            text = lines[i] if i < len(lines) else ""
            space = " " * (width - len(text))
            if colour:
                text = painted(text, columns[k].style(text), colour)
            parts.append(space + text if columns[k].right else text + space)
        found.append((" " * layout.gap).join(parts))
    return found


def _below(cells: list[tuple[Column, str]], width: int) -> list[str]:
    """What left the line, each number beside its name."""
    items = [
        f"{column.name.replace(' ', NO_BREAK)}{NO_BREAK}"
        f"{cell if column.words else cell.replace(' ', NO_BREAK)}"
        for column, cell in cells
        if cell
    ]
    return textwrap.wrap("  ".join(items), width, initial_indent=INDENT, subsequent_indent=INDENT,
                         break_long_words=False, break_on_hyphens=False)  # fmt: skip
