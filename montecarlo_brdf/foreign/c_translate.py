"""A file of C to what a model is made of: the process in which compilers and foreign code run.

`python -m montecarlo_brdf.foreign.c_translate` answers like `translate`. Before it calls a function
of the author's it says so: if that ends the process, one knows which did, and where.
"""

from __future__ import annotations

import base64
import ctypes
import hashlib
import os
import random
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.foreign import c_compiler, c_model, c_program, c_text, entry, translate
from montecarlo_brdf.foreign.automatic import OFFER
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import Description, Statement, described, statements
from montecarlo_brdf.foreign.translate import CALLING, COMPILING, within
from montecarlo_brdf.foreign.translation import CALLING as SAYING

PLUS = (".cc", ".cpp", ".cxx")
LIBRARY = "library "  # how the name of a function in a library is handed on
PLACES = 64
CONTRACT = "double {0}(const double *wo, const double *wi, const double *p)"


class Source(NamedTuple):
    """A file and what is said of it; `name`: of a function, if the file is a library."""

    path: Path
    said: Description
    text: str
    name: str = ""


def opened(path: Path, more: list[Statement]) -> Source:
    """A file, read and described. Raises Complaint."""
    if more and more[0].text.startswith(LIBRARY):
        return _library(path, more[0].text.removeprefix(LIBRARY))
    text = _text(path)
    if not text.strip():
        raise Complaint("it is empty")
    said = described([*statements(text, str(path)), *more])
    if not said.f:
        raise Complaint(f"no f is named; {OFFER}")
    sources = [f'#line 1 "{one}"\n{_text(path.parent / one)}\n' for one in said.sources]
    return Source(path, said, "".join([*sources, f'#line 1 "{path}"\n', text]))


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise Complaint(f"cannot read {path}: {error.strerror}", placed=True) from error


def _library(path: Path, name: str) -> Source:
    """A function of a library, whose parameters it names itself."""
    try:
        library = c_model.opened(str(path.resolve()))
        getattr(library, name)
    except OSError as error:
        raise Complaint(f"it cannot be opened: {error}") from None
    except AttributeError:
        raise Complaint(f"it has no function {name}: {CONTRACT.format(name)}") from None
    told = ""
    if hasattr(library, f"{name}_params"):
        told = (ctypes.c_char_p.in_dll(library, f"{name}_params").value or b"").decode()
    parameters = [x.strip() for x in told.split(";") if x.strip()]
    said = described(Statement(f"param {x}", f"{path}, {name}_params") for x in parameters)
    said.f = name
    if hasattr(library, f"{name}_pdf") and hasattr(library, f"{name}_sample"):
        said.pdf, said.sample = f"{name}_pdf", f"{name}_sample"
    return Source(path, said, "", name)


def answer(source: Source) -> dict[str, Any]:
    """The model's text, the code that it calls, and the files that these were made of."""
    said, path = source.said, source.path
    found = entry.entries(said)
    inputs = entry.end(said.parameters)
    made = c_compiler.Made("", b"", [])
    symbols = {one.name: one.expression for one in found}
    if not source.name:
        content = hashlib.sha256(source.text.encode()).hexdigest()
        program = c_program.source(source.text, str(path), said, found, content)
        folders = [path.parent / folder for folder in said.folders]
        with within(COMPILING, f"{path}: its compiler did not return within {COMPILING:g} s"):
            made = c_compiler.made(program, path, folders, path.suffix in PLUS)
        symbols = {one.name: c_program.symbol(one.name, content) for one in found}
    known = {
        "text": c_text.text(path.name, said, found, bool(made.code)), "code": made.code,
        "library": base64.b64encode(made.library).decode(), "inputs": inputs, "symbols": symbols,
        "found": [], "files": _hashes([path, *made.files]),
    }  # fmt: skip
    with within(CALLING, f"{path}: its functions did not return within {CALLING:g} s"):
        _try(known, source)
    return known


def _hashes(paths: list[Path]) -> dict[str, str]:
    return {str(p): hashlib.sha256(p.read_bytes()).hexdigest() for p in paths if p.is_file()}


def _try(known: dict[str, Any], source: Source) -> None:
    """Call every function at places of any kind, at the defaults."""
    calls, chosen = c_model.calls(known, source.path), random.Random(1)
    parameters = [v for p in source.said.parameters for v in p.fields().values()]
    for name, call in calls.items():
        try:
            call.find()
        except (OSError, AttributeError) as error:
            raise Complaint(_missing(str(error))) from None
        for _ in range(PLACES):
            first, second = _direction(chosen), _direction(chosen)
            if call.draws:
                second = tuple(chosen.random() for _ in range(3))
            key, letter = name.removeprefix("CALL_"), "u" if call.draws else "wi"
            where = f"wo = {_shown(first)}, {letter} = {_shown(second)}"
            os.write(1, f"{SAYING}{key} at {where}\n".encode())
            call(0.0, (*first, *second, *parameters))


def _missing(told: str) -> str:
    """What a library lacks, as its loader says it."""
    _, found, name = told.partition("undefined symbol: ")
    return f"{name.split()[0]} is called and nowhere defined" if found else told


def _direction(chosen: random.Random) -> tuple[float, ...]:
    x, y = chosen.uniform(-0.7, 0.7), chosen.uniform(-0.7, 0.7)
    return x, y, float((1.0 - x * x - y * y) ** 0.5)


def _shown(vector: tuple[float, ...]) -> str:
    return f"({', '.join(f'{x:.3g}' for x in vector)})"


if __name__ == "__main__":
    translate.main(opened, answer)
