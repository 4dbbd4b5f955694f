"""One format per file: any module here with SUFFIX and `render(report)` is one.

`--format NAME` prints it, `--export FILE` takes the suffix as the name. Each is a pure function of
the report.
"""
from __future__ import annotations

import functools
import importlib
import pkgutil
from types import ModuleType

from montecarlo_brdf.judge.finding import Report


def names() -> list[str]:
    """All formats, found by scanning this folder."""
    return sorted(m.name for m in pkgutil.iter_modules(__path__))


def render(report: Report, name: str) -> str:
    """A report in the format `name`."""
    return str(_module(name).render(report))


@functools.cache
def suffixes() -> dict[str, str]:
    """{".xml": "junit", ...}"""
    return {_module(name).SUFFIX: name for name in names() if _module(name).SUFFIX}


def _module(name: str) -> ModuleType:
    return importlib.import_module(f"{__name__}.{name}")
