"""The formats of a report: `--format NAME` prints one, `--export FILE` takes it from the suffix.

Each is a module of its name beside this one, with `render(report)`.
"""

from __future__ import annotations

import importlib

from montecarlo_brdf.judge.finding import Report

#: name -> suffix of its files; none for what is only for a terminal
SUFFIXES = {"csv": ".csv", "github": "", "html": ".html", "json": ".json", "junit": ".xml"}
SUFFIXES |= {"markdown": ".md", "sarif": ".sarif"}


def suffixes() -> dict[str, str]:
    """{".xml": "junit", ...}"""
    return {suffix: name for name, suffix in SUFFIXES.items() if suffix}


def render(report: Report, name: str) -> str:
    """A report in the format `name`."""
    return str(importlib.import_module(f"{__package__}.{name}").render(report))
