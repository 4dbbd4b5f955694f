"""One question per file. A check is any module here with a NAME, a QUESTION and `claims(case)`."""
from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType

#: checks that come first because others only make sense once they hold
FIRST = ("positivity", "furnace", "energy", "reciprocity")


def names() -> list[str]:
    """Names of all checks, found by scanning this folder."""
    found = []
    for info in pkgutil.iter_modules(__path__):
        module = importlib.import_module(f"{__name__}.{info.name}")
        if hasattr(module, "QUESTION"):
            found.append(module.NAME)
    return sorted(found, key=lambda n: (FIRST.index(n) if n in FIRST else len(FIRST), n))


def find(name: str) -> ModuleType:
    """The module of a check."""
    return importlib.import_module(f"{__name__}.{name}")
