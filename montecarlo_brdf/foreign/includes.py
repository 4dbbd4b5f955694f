"""`#include` resolved as an engine's build would, with #line for the compiler.

One that is not found becomes an #error, which says so if it does not stand in a branch that no
macro takes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.conditions import Conditions

INCLUDE = re.compile(r'[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]+)"|<([^>\n]+)>)')
ONCE = re.compile(r"[ \t]*#[ \t]*pragma[ \t]+once\b")
#: a line with those that continue it
LINE = re.compile(r"(?:[^\n]*\\\n)*[^\n]*\n?")
QUOTING = (".js", ".ts")
#: what a name may go without: `<common>` is a file of three.js; a first `/` is an engine's root
ENDS = ("", ".glsl", ".glsl.js", ".glsl.ts")
#: how deep files may include one another, and how much text may come of it
DEEPEST, LARGEST = 64, 1 << 26


class Includes:
    """Reads files, and remembers which."""

    def __init__(self, folders: list[Path], shown: Callable[[Path], str]) -> None:
        self.folders, self._shown = folders, shown
        self.read: dict[Path, bytes] = {}
        self._conditions = Conditions({})
        self._once: set[Path] = set()
        self._size = 0

    def text(self, path: Path) -> str:
        """A file's text, and from now on one of those that were read."""
        try:
            content = path.read_bytes()
        except OSError as error:
            raise Complaint(f"cannot read {path}: {error.strerror}", placed=True) from error
        self.read[path.resolve()] = content
        if b"\0" in content:
            raise Complaint(f"{path} is no text: it has null bytes", placed=True)
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("latin-1")
        text = text.replace("\r\n", "\n").replace("\r", "\n")
        return quoted(text) if path.suffix in QUOTING else text

    def defined(self, macros: Mapping[str, str]) -> None:
        """Macros that a compiler or an engine would define before the shader."""
        self._conditions.macros |= macros

    def resolved(self, text: str, path: Path, depth: int = 0) -> str:
        """A file's text with all that it includes; nothing if its guard leaves nothing of it."""
        lines, live = [], False
        for number, line in enumerated(text):
            own = self._conditions.heed(line)
            live = live or (self._conditions.live and not own and bool(line.strip()))
            if self._conditions.live and ONCE.match(line):
                self._once.add(path.resolve())
            lines.append(self._line(line, number, path, depth))
        return "".join(lines) if live or not depth else ""

    def _line(self, line: str, number: int, path: Path, depth: int) -> str:
        match = INCLUDE.match(line)
        if not match or not self._conditions.live:
            return "\n" if match else line
        name = match[1] or match[2]
        found = self.find(name, path)
        if found is None:
            return f"#error no file {name} to include\n"
        if found.resolve() in self._once:
            return "\n"
        inside = self._whole(found, depth)
        if not inside:
            return "\n"
        back = f'#line {number + 1} "{self._shown(path)}"\n'
        return f'#line 1 "{self._shown(found)}"\n{inside}\n{back}'

    def _whole(self, path: Path, depth: int) -> str:
        if depth >= DEEPEST:
            raise Complaint(f"{path} includes itself", placed=True)
        inside = self.resolved(self.text(path), path, depth + 1)
        self._size += len(inside)
        if self._size > LARGEST:
            raise Complaint("what it includes is too large")
        return inside

    def find(self, name: str, path: Path) -> Path | None:
        """A file beside the one that names it, or in one of the folders."""
        for folder in (path.parent, *self.folders):
            for end in ENDS:
                for found in (folder / f"{name}{end}", folder / f"{name.lstrip('/')}{end}"):
                    if found.is_file():
                        return found
        return None


def quoted(text: str) -> str:
    """What stands between back-ticks, in its lines: shaders within JavaScript."""
    parts = text.split("`")
    return "".join(p if k % 2 else "\n" * p.count("\n") for k, p in enumerate(parts))


def enumerated(text: str) -> Iterator[tuple[int, str]]:
    """The lines of a text with their numbers; a directive over several of them is one."""
    number = 1
    for match in LINE.finditer(text):
        if match[0]:
            yield number, match[0]
        number += match[0].count("\n")
