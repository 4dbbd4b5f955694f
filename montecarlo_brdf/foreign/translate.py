"""A shader's file to the text of a model file: the process in which foreign compilers run.

`python -m montecarlo_brdf.foreign.translate` reads a request as JSON and answers in JSON. A
compiler may crash, which ends this process alone, or never return, which the watch ends.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.foreign import (
    automatic,
    constants,
    explorer,
    glslang,
    language,
    members,
    trial,
)
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import (
    Description,
    Language,
    Statement,
    described,
    statements,
)
from montecarlo_brdf.foreign.includes import Includes
from montecarlo_brdf.foreign.language import shown
from montecarlo_brdf.foreign.model_text import Texts, Version
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.widen import widened

COMPILING, CALLING = 60.0, 2.0  # seconds


class Shader(NamedTuple):
    """A shader with all that it includes, and what is said of it."""

    path: Path
    text: str
    said: Description
    folders: list[Path]
    files: dict[Path, bytes]


def opened(path: Path, more: list[Statement] | None = None) -> Shader:
    """A shader's file, read and described; more: statements from elsewhere. Raises Complaint."""
    includes = Includes([path.parent], shown)
    text = includes.text(path)
    if not text.strip():
        raise Complaint("it is empty")
    said = described([*statements(text, str(path)), *(more or [])])
    includes.folders += [path.parent / folder for folder in said.folders]
    kind = language.language_of(path, said)
    includes.defined(language.macros(kind) | said.defines)
    if kind is Language.EXPLORER:
        said, text = explorer.described(text, path.name, said)
    sources = [_source(includes, path.parent / one) for one in said.sources]
    text = includes.resolved(text, path)
    if not said.f:
        automatic.bind(text, shown(path), said)
    whole = "".join([*sources, f'#line 1 "{shown(path)}"\n', text])
    return Shader(path, whole, said, includes.folders, includes.read)


def _source(includes: Includes, path: Path) -> str:
    text = includes.resolved(includes.text(path), path)
    return f'#line 1 "{shown(path)}"\n{text}\n'


def texts(shader: Shader, binaries: dict[str, bytes], optimise: bool = True) -> Texts:
    """The model file's texts from the SPIR-V of its entries: the same operations in double and in
    single precision. (What a compiler folds is folded in double, as most compilers do.)"""
    better: Callable[[bytes], bytes] = glslang.optimised if optimise else bytes
    literals = constants.literals(shader.text)
    binaries = {k: better(widened(b, literals)) for k, b in binaries.items()}
    said, name = shader.said, shader.path.name
    double = Version(said, name, binaries, Numerals(single=False))
    with within(CALLING, f"{shader.path}: its functions did not return within {CALLING:g} s"):
        text = double.text()
        space = trial.functions(text)
        trial.call(space)
        if double.coloured and trial.is_grey(space):
            double.coloured = False
            text = double.text()
    if said.precision == "double":
        return Texts(text, "")
    single = Version(said, name, binaries, Numerals(single=True))
    single.coloured = double.coloured
    return Texts(text, single.text())


def answer(shader: Shader) -> dict[str, Any]:
    """What the request's answer is: texts and the files that they were made of."""
    path = shader.path
    with within(COMPILING, f"{path}: its compiler did not return within {COMPILING:g} s"):
        binaries = dict(
            language.binaries(shader.text, path, shader.said, shader.folders, shader.files)
        )
    found = texts(shader, binaries)
    if language.language_of(path, shader.said) is not Language.EXPLORER:
        _refuse_unused(shader, found.double)
    files = {str(p): hashlib.sha256(content).hexdigest() for p, content in shader.files.items()}
    return {"double": found.double, "single": found.single, "found": shader.said.found,
            "files": files}  # fmt: skip


def _refuse_unused(shader: Shader, text: str) -> None:
    for one in shader.said.parameters:
        if not any(f"p.{members.field_name(k)}" in text for k in one.fields()):
            place = shader.said.places.get(f"param {one.name}", str(shader.path))
            raise Complaint(f"{place}: the parameter {one.name} is not used", placed=True)


@contextlib.contextmanager
def within(seconds: float, sentence: str) -> Iterator[None]:
    """End the process with a sentence if something takes longer."""

    def give_up() -> None:
        print(json.dumps({"error": sentence}), flush=True)
        os._exit(0)

    watch = threading.Timer(seconds, give_up)
    watch.daemon = True
    watch.start()
    try:
        yield
    finally:
        watch.cancel()


def _told(error: Complaint, shader: Shader | None, path: str) -> str:
    """The sentence, with the line of the key that it is about."""
    key = re.match(r"key (\w+)", str(error))
    place = shader.said.places.get(key[1]) if shader and key else None
    return f"{place}, {error}" if place else error.told(path)


def main(
    opened: Callable[[Path, list[Statement]], Any] = opened,
    answer: Callable[[Any], dict[str, Any]] = answer,
) -> None:
    """Answer the request on standard input: `opened` makes what `answer` is given."""
    request, shader = json.load(sys.stdin), None
    path, said = request["path"], [Statement(*one) for one in request["said"]]
    try:
        shader = opened(Path(path), said)
        told = answer(shader)
    except Complaint as error:
        told = {"error": _told(error, shader, path)}
    except RecursionError:
        told = {"error": f"{path}: it is nested too deeply"}
    print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main()
