"""A shader as the namespace of a model file: its translation is kept by the content of all that it
was made of, and made in a process of its own."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import sys
import types
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.compile import cache
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.files import know_input
from montecarlo_brdf.foreign import wheel
from montecarlo_brdf.foreign.complaint import Complaint

#: how files of shaders end
SUFFIXES = (".glsl", ".frag", ".comp", ".vert", ".fs", ".hlsl", ".hlsli", ".slang", ".brdf")
#: the name under which a module has its own text
TEXT = "__translation__"
PATIENCE = 180.0  # seconds for everything
CALLING = "calling "  # what a process says before it runs code that may end it


class Translation(NamedTuple):
    """The text of a model file in double precision, and in the shader's own if that is single."""

    double: str
    single: str
    found: list[str]  # which functions of the shader were taken without being named


#: hears what was found in a shader, as a sentence
listeners: list[Callable[[str], None]] = []


def is_shader(spec: str) -> bool:
    """Whether a model is asked for by the path of a shader."""
    return spec.endswith(SUFFIXES)


def module(path: Path, text: str) -> types.ModuleType:
    """The module that a translation's text makes."""
    made = types.ModuleType(path.stem)
    made.__file__ = f"{path} (translated)"
    vars(made)[TEXT] = text
    exec(compile(text, made.__file__, "exec"), vars(made))  # noqa: S102
    return made


def translated(path: Path, said: Sequence[tuple[str, str]] = ()) -> Translation:
    """The translation of a shader. said: statements that stand elsewhere, with their places.

    Raises ModelError with one sentence.
    """
    known = answered("translate", path, said)
    return Translation(known["double"], known["single"], known["found"])


def answered(
    worker: str, path: Path, said: Sequence[tuple[str, str]], *more: str
) -> dict[str, Any]:
    """What a module of this folder, run in a process of its own, makes of a file and of what is
    said of it: kept until that, any file that was read, or `more` changes."""
    name = _name(path, repr((said, *more)))
    kept = cache.read(name)
    known: dict[str, Any] | None = json.loads(kept) if kept else None
    if known is None or not _is_current(known["files"]):
        known = _asked(worker, path, said)
        cache.write(name, json.dumps(known).encode())
    for file in known["files"]:
        know_input(Path(file))
    for sentence in known["found"]:
        for hear in listeners:
            hear(f"{path}: {sentence}")
    return known


def _name(path: Path, said: str) -> str:
    """What a translation is kept under."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ModelError(f"cannot read {path}: {error.strerror or error}") from error
    place = f"{path.resolve()} {said} {wheel.release()}"
    parts = (place.encode(), content, _translator())
    whole = hashlib.blake2b(digest_size=16)
    for part in parts:
        whole.update(len(part).to_bytes(8, "little") + part)
    return f"shader-{whole.hexdigest()}"


@functools.cache
def _translator() -> bytes:
    """Which state of our own files this is; to read them all would cost more than the rest."""
    with os.scandir(Path(__file__).parent) as files:
        known = sorted((f.name, f.stat().st_size, f.stat().st_mtime_ns) for f in files)
    return repr([one for one in known if one[0].endswith(".py")]).encode()


def _is_current(files: dict[str, str]) -> bool:
    """Whether all files are as they were read."""
    try:
        found = {p: hashlib.sha256(Path(p).read_bytes()).hexdigest() for p in files}
    except OSError:
        return False
    return found == files


def _asked(worker: str, path: Path, said: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """The answer of a process of its own."""
    if worker == "translate" and wheel.folder() is None:
        needed = f"it needs the package {wheel.PACKAGE}: pip install '{wheel.EXTRA}'"
        raise ModelError(Complaint(needed).told(str(path)))
    import subprocess  # slow to import, and seldom needed

    command = [sys.executable, "-m", f"montecarlo_brdf.foreign.{worker}"]
    request = json.dumps({"path": str(path), "said": said})
    try:
        done = subprocess.run(
            command, input=request, capture_output=True, timeout=PATIENCE, encoding="utf-8"
        )
    except subprocess.TimeoutExpired:
        raise ModelError(f"{path}: its compiler did not return within {PATIENCE:g} s") from None
    lines = done.stdout.splitlines()
    answer = json.loads(lines[-1]) if lines and lines[-1].startswith("{") else None
    if answer is None:
        calling = [x for x in lines if x.startswith(CALLING)]
        what = f"its {calling[-1].removeprefix(CALLING)}" if calling else "its compiler"
        raise ModelError(f"{path}: {_ended(what, done.returncode, done.stderr)}")
    if "error" in answer:
        raise ModelError(answer["error"])
    return dict(answer)


def _ended(what: str, code: int, told: str) -> str:
    """In words, how a process ended that gave no answer."""
    if code < 0:
        import signal

        with contextlib.suppress(ValueError):
            name, _, where = what.partition(" at ")
            return f"{name} crashed with {signal.Signals(-code).name}{where and f' at {where}'}"
    last = told.strip().splitlines()[-1:] or [f"exit code {code}"]
    return f"its translation failed: {last[0][:200]}"
