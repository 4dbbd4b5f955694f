"""Every known-bad BRDF is refuted by the check meant for it; no honest one ever fails.

The models are files as users write them. A mutant's docstring names the check: "caught by: energy".
All checks of all of them: scripts/detection_matrix.py, docs/detection_matrix.md.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import montecarlo_brdf
from montecarlo_brdf import checks

TESTS = Path(__file__).parents[1]
MUTANTS = sorted(p for p in (TESTS / "mutants").glob("*.py") if not p.stem.startswith("test_"))
HONEST = sorted((TESTS / "honest").glob("*.py"))
#: honest models are asked everything, at fewer angles: it is about their kinds, not about angles
ANGLES = (0.0, 70.0)


def meant(path: Path) -> str:
    """The check that a mutant's docstring names."""
    return re.findall(r"^caught by: (\w+)$", path.read_text(encoding="utf-8"), re.MULTILINE)[0]


@pytest.mark.parametrize("path", MUTANTS, ids=lambda p: p.stem)
def test_mutant_is_refuted(path: Path) -> None:
    report = montecarlo_brdf.run(montecarlo_brdf.load(str(path)), names=[meant(path)])
    assert "fail" in [f.verdict for r in report.results for f in r.findings]


@pytest.mark.parametrize("path", HONEST, ids=lambda p: p.stem)
def test_honest_model_never_fails(path: Path) -> None:
    report = montecarlo_brdf.run(montecarlo_brdf.load(str(path)), theta_o_deg=ANGLES)
    refuted = [(r.check, f) for r in report.results for f in r.findings if f.verdict == "fail"]
    assert refuted == []


def test_corpus_is_large() -> None:
    assert len(MUTANTS) >= 55
    assert len(HONEST) >= 12


def test_every_mutant_says_what_was_done_to_it() -> None:
    """By a cause that scripts/detection_matrix.py looks for in the hints, or "none"."""
    known = {"none", *tomllib.loads((TESTS / "mutants" / "causes.toml").read_text("utf-8"))}
    said = re.compile(r"^cause: (.+)$", re.MULTILINE)
    causes = {p.stem: said.findall(p.read_text(encoding="utf-8")) for p in MUTANTS}
    assert {name for name, found in causes.items() if not known.issuperset(found or [""])} == set()


def test_every_check_has_a_mutant() -> None:
    blind = {"radiance"}  # `pdf` and `sampling` come first wherever it speaks up
    assert set(checks.names()) - blind == {meant(p) for p in MUTANTS}
