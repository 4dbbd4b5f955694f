"""Model files as users write them: what is loaded and what is told."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import montecarlo_brdf as mb

HELPER = """
import math
from dataclasses import dataclass


@dataclass
class Light:
    x: float = 1.0


def f(wo, wi, p):
    return 0.5 / math.pi
"""
MISSPELT = """
import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albdo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi
"""


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "my_brdf.py"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_a_file_with_a_dataclass_is_loaded(tmp_path: Path) -> None:
    before = set(sys.modules)
    assert mb.load(written(tmp_path, HELPER)).f is not None
    assert "my_brdf" not in set(sys.modules) - before


def test_a_domain_of_no_parameter_is_told(tmp_path: Path) -> None:
    with pytest.raises(mb.ModelError, match="did you mean 'albedo'"):
        mb.load(written(tmp_path, MISSPELT))


def package(folder: Path, value: str) -> str:
    """A model within a package within a package, which imports in both ways."""
    inner = folder / "materials" / "metals"
    inner.mkdir(parents=True)
    for one in (inner.parent, inner):
        (one / "__init__.py").touch()
    (inner.parent / "util.py").write_text(f"VALUE = {value}\n", encoding="utf-8")
    text = "from ..util import VALUE\nfrom materials.util import VALUE as SAME\n"
    text += "def f(wo, wi, p):\n    return VALUE + SAME\n"
    (inner / "gold.py").write_text(text, encoding="utf-8")
    return str(inner / "gold.py")


def test_a_file_in_a_package_imports_its_neighbours(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", sys.path[:])
    one, two = package(tmp_path / "a", "0.1"), package(tmp_path / "b", "0.2")
    up = (0.0, 0.0, 1.0)
    assert mb.load(one).f(up, up, ()) == 0.2
    assert mb.load(two).f(up, up, ()) == 0.4  # another project's package of the same name
    assert mb.furnace(mb.load(one), theta_o_deg=0.0, sampler="cosine").verdict == "pass"


def test_models_of_two_folders_import_each_their_own_namesake(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", sys.path[:])
    for name, value in (("a", 0.1), ("b", 0.2)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "common.py").write_text(f"K = {value}\n")
        model = "from common import K\n\n\ndef f(wo, wi, p):\n    return K\n"
        (tmp_path / name / "m.py").write_text(model)
    values = [mb.load(str(tmp_path / name / "m.py")).f(0, 0, 0) for name in "aba"]
    assert values == [0.1, 0.2, 0.1]
