"""The files that models are made of: found here, laid down there.

Which they are is seen by loading the model: its own, what it includes, and what is opened beside or
below these meanwhile.
"""
from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from montecarlo_brdf import files, loading, mixture, reading
from montecarlo_brdf.counterpart import SPEC
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.measured import merl
from montecarlo_brdf.sweep.task import File, mark

SMALL = 1 << 16  # bytes; larger files are not kept in memory, nor sent where they may be known


class Texts:
    """The content of all files, by its hash."""

    def __init__(self) -> None:
        self._kept: dict[str, bytes] = {}
        self._large: dict[str, Path] = {}

    def add(self, path: Path) -> str:
        """The hash of a file's content, which is remembered, or where to find it."""
        content = path.read_bytes()
        found = hash_of(content)
        if len(content) <= SMALL:
            self._kept[found] = content
        else:
            self._large[found] = path
        return found

    def of(self, hashes: Iterable[str], large: bool = False) -> dict[str, bytes]:
        """The contents for some hashes; of large files only if they are asked for."""
        return {h: self._content(h) for h in hashes if large or h in self._kept}

    def _content(self, found: str) -> bytes:
        if found in self._kept:
            return self._kept[found]
        path = self._large[found]
        content = path.read_bytes()
        if hash_of(content) != found:
            raise UserError(f"{path} was changed while its model was checked: begin again")
        return content


def hash_of(content: bytes) -> str:
    """Of the content of a file."""
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def files_of(specs: Sequence[str], texts: Texts) -> tuple[list[str], tuple[File, ...]]:
    """Some models, as `load` takes them, with marks in place of paths, and the files of all."""
    typed = [path for spec in specs for path in _paths(spec)]
    if not typed:
        return [*specs], ()
    own = dict.fromkeys(Path(os.path.realpath(path)) for path in typed)
    found = dict.fromkeys([*own, *sorted(_read(specs, {path.parent for path in own}))])
    root = Path(os.path.commonpath([path.parent for path in found]))
    names = {Path(os.path.realpath(path)): path for path in typed}
    made = tuple(
        File(path.relative_to(root).as_posix(), texts.add(path), names.get(path, str(path)),
             _shown(path))
        for path in found
    )  # fmt: skip
    order = sorted(range(len(own)), key=lambda k: -len(made[k].named))  # b/a/x.py holds a/x.py
    marked = []
    for spec in specs:
        for k in order:
            spec = spec.replace(made[k].named, mark(k))
        marked.append(spec)
    return marked, made


def _read(specs: Sequence[str], near: set[Path]) -> set[Path]:
    """What is read when models are loaded that nobody has loaded before."""
    opened: dict[Path, None] = {}
    reading.forget_modules(_Below(near))
    before = files.inputs()
    files.forget_inputs()
    try:
        with reading.opened(lambda path: opened.setdefault(path)):
            for spec in specs:
                loading.load(_name(spec))
        known = files.inputs()
    finally:
        for path in before:
            files.know_input(path)
    beside = {path.parent for path in known} | near
    found = known | {path for path in opened if beside & {*path.parents}}
    return {path for path in found if path.is_file()}


class _Below:
    """All files in or below some folders."""

    def __init__(self, folders: set[Path]) -> None:
        self._folders = folders

    def __contains__(self, path: object) -> bool:
        return isinstance(path, Path) and bool(self._folders & {*path.parents})


def _name(spec: str) -> str:
    """A model without the names that its parameters get in a comparison."""
    match = SPEC.fullmatch(spec.strip())
    return match["name"].strip() if match else spec


def _paths(spec: str) -> list[str]:
    """The paths in a model as it is typed."""
    spec = _name(spec)
    mixed = None if os.path.exists(spec) else mixture.parts(spec)
    found = []
    for name in [name for _, name in mixed] if mixed else [spec]:
        path, _, member = name.removeprefix(merl.MARK).partition(".py:")
        path = f"{path}.py" if member else path
        if loading.is_path(name) and os.path.isfile(path):
            found.append(path)
    return found


def _shown(path: Path) -> str:
    below = os.path.relpath(path)
    return str(path) if below.startswith("..") else below.replace(os.sep, "/")


class Folder:
    """Where a process keeps the files that it was sent."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="brdf-check-")  # goes with the process
        self.root = Path(os.path.realpath(self._folder.name))
        self._known: dict[str, Path] = {}

    def lacks(self, made: Iterable[File], sent: Mapping[str, bytes]) -> list[str]:
        """The hashes of contents that were never sent."""
        for content_hash, content in sent.items():
            if content_hash not in self._known:
                path = self.root / content_hash
                path.write_bytes(content)
                self._known[content_hash] = path
        return [file.content for file in made if file.content not in self._known]

    def laid(self, made: Sequence[File]) -> list[Path]:
        """The files of a model as it expects them, in a folder of their own."""
        whole = "\n".join(f"{file.place} {file.content}" for file in made)
        folder = self.root / f"model-{hash_of(whole.encode())}"
        paths = [folder / file.place for file in made]
        for file, path in zip(made, paths, strict=True):
            if not path.exists():
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(self._known[file.content].read_bytes())
        return paths
