"""Exactly one question per file of checks/, and nothing is imported to know their names."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from montecarlo_brdf import checks
from montecarlo_brdf.model import Property

FILES = sorted(p.stem for p in Path(str(checks.__file__)).parent.glob("[!_]*.py"))


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_a_question(name: str) -> None:
    module = checks.find(name)
    assert name == module.NAME and module.QUESTION.endswith("?")
    assert isinstance(module.PROPERTY, Property) and callable(module.claims)
    assert "cannot see" in (module.__doc__ or "")


def test_names_are_those_of_the_files_the_first_in_their_order() -> None:
    assert sorted(checks.names()) == FILES
    assert tuple(checks.names()[: len(checks.FIRST)]) == checks.FIRST


def test_other_files_ask_nothing() -> None:
    folder = Path(str(checks.__file__)).parent
    assert not [p.name for p in folder.glob("_*.py") if "\nQUESTION = " in p.read_text("utf-8")]


def test_names_import_no_check() -> None:
    command = "import sys; from montecarlo_brdf import checks; checks.names(); print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", command], capture_output=True, encoding="utf-8", check=True
    ).stdout.split()
    assert not [m for m in loaded if m.startswith("montecarlo_brdf.checks.")]
