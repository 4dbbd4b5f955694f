"""The wheel that carries the compilers: where its libraries lie; it is never imported."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from montecarlo_brdf.foreign.complaint import Complaint

PACKAGE = "slangpy"
EXTRA = "montecarlo-brdf[shaders]"
SUFFIXES = (".so", ".dylib", ".dll")


def folder() -> Path | None:
    """Where the wheel is installed, None if it is not."""
    spec = importlib.util.find_spec(PACKAGE)
    return Path(spec.origin).parent if spec and spec.origin else None


def release() -> str:
    """Which release of it is installed, by the name of its compiler's file."""
    found = folder()
    names = sorted(p.name for p in found.iterdir() if "slang-" in p.name) if found else []
    return " ".join(names)


def library(name: str) -> Path:
    """A library whose name without `lib` begins so. Raises Complaint without the wheel."""
    place = folder()
    if place is None:
        raise Complaint(f"it needs the package {PACKAGE}: pip install '{EXTRA}'")
    for path in sorted(place.iterdir()):
        fits = path.name.removeprefix("lib").startswith(name)
        if fits and any(suffix in path.name for suffix in SUFFIXES):
            return path
    raise Complaint(f"the package {PACKAGE} that is installed has no library {name}*")
