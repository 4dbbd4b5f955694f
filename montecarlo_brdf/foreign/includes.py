"""`#include` resolved as an engine's build would: each file once, with #line for the compiler.

One that is not found becomes an #error, which says so if it does not stand in a branch that no
macro takes.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from montecarlo_brdf.foreign.complaint import Complaint

DIRECTIVE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">].*$', re.M)
#: how deep files may include one another
DEEPEST = 64


class Includes:
    """Reads files, and remembers which."""

    def __init__(self, folders: list[Path], shown: Callable[[Path], str]) -> None:
        self.folders, self._shown = folders, shown
        self.read: dict[Path, bytes] = {}

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
            return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
        except UnicodeDecodeError:
            return content.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")

    def resolved(self, text: str, path: Path, depth: int = 0) -> str:
        """A file's text with all that it includes."""
        if depth > DEEPEST:
            raise Complaint(f"{path} includes itself")

        def replaced(match: re.Match[str]) -> str:
            found = self.find(match[2], path)
            if found is None:
                return f"#error no file {match[2]} to include"
            line = text.count("\n", 0, match.start()) + 1
            if found.resolve() in self.read:
                return ""
            inside = self.resolved(self.text(found), found, depth + 1)
            back = f'#line {line + 1} "{self._shown(path)}"'
            return f'#line 1 "{self._shown(found)}"\n{inside}\n{back}'

        return DIRECTIVE.sub(replaced, text)

    def find(self, name: str, path: Path) -> Path | None:
        """A file beside the one that names it, or in one of the folders."""
        for folder in (path.parent, *self.folders):
            if (folder / name).is_file():
                return folder / name
        return None
