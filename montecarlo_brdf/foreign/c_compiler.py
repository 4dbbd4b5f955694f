"""The C compilers that a machine has: LLVM's code of a text where one of them gives it, else a
shared library."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from montecarlo_brdf.compile import native
from montecarlo_brdf.compile.compiler import LIBC
from montecarlo_brdf.foreign import messages
from montecarlo_brdf.foreign.complaint import Complaint

PACKAGE, EXTRA = "ziglang", "montecarlo-brdf[native]"
PATIENCE = 60.0  # seconds
#: to LLVM's code as a kernel wants it: to be inlined, and vectorised there
CODE = """-O1 -g0 -fno-math-errno -fno-slp-vectorize -fno-vectorize -ffp-contract=fast
          -fno-sanitize=all -fno-stack-protector -emit-llvm -c""".split()  # noqa: SIM905
#: C of 1989 took a name that nobody declared for a function that returns int
DECLARING = ["-Werror=implicit-function-declaration"]
LIBRARY = "-O3 -fno-math-errno -ffp-contract=fast -shared -fPIC".split()  # noqa: SIM905
#: what ties a function to one processor, which would keep it from being inlined
TIED = re.compile(r'"(?:target-cpu|target-features|tune-cpu|probe-stack)"="[^"]*"')
WRITTEN = re.compile(r"\bstore [^\n]*@([\w.$]+)")
DECLARED = re.compile(r"^declare [^\n@]*@([\w.$]+)\(", re.M)


class Made(NamedTuple):
    """What a compiler made: LLVM's text, or a library, and the files that it read."""

    code: str
    library: bytes
    files: list[Path]


def made(program: str, path: Path, folders: list[Path], plus: bool) -> Made:
    """The program by the first compiler that is there. Raises Complaint with what it says."""
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / ("program.cpp" if plus else "program.c")
        file.write_text(program, encoding="utf-8")
        include = [x for folder in (path.parent, *folders) for x in ("-I", str(folder))]
        include += [] if plus else DECLARING
        for command in clangs(plus):
            out = _run([*command, *CODE, *include, str(file)], file.with_suffix(".bc"), path)
            code = plain(out.read_bytes())
            if not code:
                break
            if written := WRITTEN.search(code):
                raise Complaint(f"the variable {written[1]} is written, and calls run side by side")
            if {x for x in DECLARED.findall(code) if not x.startswith("llvm.")} <= LIBC:
                return Made(code, b"", _read([*command, *include, str(file)]))
            break
        for command in others(plus):
            line = [*command, *LIBRARY, *include, str(file), "-lm"]
            out = _run(line, file.with_suffix(".so"), path)
            return Made("", out.read_bytes(), _read([*command, *include, str(file)]))
    name = "C++" if plus else "C"
    raise Complaint(f"it needs a {name} compiler: install one, or pip install '{EXTRA}'")


def clangs(plus: bool) -> Iterator[list[str]]:
    """Compilers that give LLVM's code."""
    if found := shutil.which("clang++" if plus else "clang"):
        yield [found]
    if importlib.util.find_spec(PACKAGE):
        yield [sys.executable, "-m", PACKAGE, "c++" if plus else "cc"]


def others(plus: bool) -> Iterator[list[str]]:
    """Compilers that do not."""
    for name in ("c++", "g++") if plus else ("cc", "gcc"):
        if found := shutil.which(name):
            yield [found]
    yield from clangs(plus)


def _run(command: list[str], out: Path, path: Path) -> Path:
    """Compile; the names of files tell a compiler what to make."""
    done = _asked([*command, "-o", str(out)])
    if done.returncode or not out.is_file():
        raise messages.complaint(done.stderr.replace(str(out.parent), str(path.parent)))
    return out


def _asked(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, capture_output=True, timeout=PATIENCE, encoding="utf-8", errors="replace"
    )


def _read(command: list[str]) -> list[Path]:
    """The author's own files that a program includes, as the compiler tells them."""
    words = _asked([*command, "-MM"]).stdout.replace("\\\n", " ").split()
    return [Path(word) for word in words[2:]]  # after the object and the program


def plain(bitcode: bytes) -> str:
    """LLVM's text for any processor; nothing if it is of a release that cannot be read here."""
    try:
        lines = str(native.parsed(bitcode)).splitlines()
    except RuntimeError:
        return ""
    kept = [x for x in lines if not x.startswith(("target ", "source_filename"))]
    return TIED.sub("", "\n".join(kept)) + "\n"
