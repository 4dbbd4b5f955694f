"""Failures that users reported, as the files they would have written, each found by its command."""

from __future__ import annotations

from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.stability import specimens
from montecarlo_brdf.verify.stress import stress

FILES = sorted((Path(__file__).parents[1] / "specimens").glob("f*.py"))


def found_by(path: Path) -> tuple[str, str]:
    """The command that finds it, and its check or precision."""
    command, what = specimens.load(str(path)).namespace["found_by"]
    return command, what


def test_there_are_thirty() -> None:
    assert len(FILES) >= 30


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(p, id=p.stem, marks=pytest.mark.slow if k % 5 else ())  # a fifth: suite's time
        for k, p in enumerate(FILES)
    ],
)
def test_found(path: Path) -> None:
    model = specimens.load(str(path))
    command, what = found_by(path)
    if command == "stress":
        report = stress(model, precisions=[what], quick=True)
    else:
        report = mb.run(model, names=[what], samples=2**20)
    assert report.verdict == "fail"
