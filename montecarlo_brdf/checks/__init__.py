"""One question per file: each module without `_` before its name is a check, with NAME (that of its
file), QUESTION, PROPERTY and `claims(case)`; the others hold what several of them need."""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from montecarlo_brdf.model import Model

#: checks that come first because others only make sense once they hold
FIRST = ("positivity", "furnace", "energy", "reciprocity")


def names() -> list[str]:
    """Names of all checks, found by scanning this folder; nothing is imported."""
    files = (info.name for info in pkgutil.iter_modules(__path__))
    others = sorted(name for name in files if not name.startswith("_") and name not in FIRST)
    return [*FIRST, *others]


def asked(model: Model) -> list[str]:
    """Names of the checks that a model is asked where nobody chooses: not those that `applies`
    says have nothing to look at."""
    return [n for n in names() if not hasattr(find(n), "applies") or find(n).applies(model)]


def find(name: str) -> ModuleType:
    """The module of a check."""
    return importlib.import_module(f"{__name__}.{name}")
