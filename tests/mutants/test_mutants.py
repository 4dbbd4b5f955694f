"""Every known-bad BRDF is refuted by the check meant for it; no honest one ever fails.

The models are files as users write them. A mutant's docstring names the check: "caught by: energy",
and what was done to it: "cause: missing 1/pi". The whole corpus takes a quarter of an hour of
processor time, so the suite asks one mutant of each check and the quick honest
models; `python -m pytest -m slow tests/mutants` asks the others.
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
CAUSES = 1
#: honest models that took more than 5 s (but both_from_one_number, which found a poor generator)
LONG = {
    "azimuth_folded", "dark_beyond_60_degrees", "f_only_ggx_sharp", "mixture_by_one_number",
    "narrow_ring", "rejection_by_hash", "retro_needle",
    "anisotropic_ggx", "beckmann_ndf", "beckmann_v_cavity", "black", "concentric_disk",
    "delta_on_diffuse", "forward_phase", "sampler_with_weights", "textbook_ggx_narrow",
    "f_only_ggx", "ggx_same_as", "huge_exponent", "mirrored_numbers", "one_of_two_by_u2",
    "oren_nayar_by_angles", "phong_u_reaches_0", "piecewise_sampler", "rejection_sampler",
    "retro_lobe", "retro_lobe_f_only", "zero_in_regions",
    "kinked_toon", "no_sampler", "rounded_below_zero",
    "azimuth_in_slices", "grating", "rare_lobe_by_u0", "table_of_cells", "two_needles",
    "values_of_1e160", "values_of_1e_minus_200",
}  # fmt: skip


def _told(path: Path, what: str) -> str:
    """What a docstring says of the mutant, "" where it does not."""
    found = re.findall(rf"^{what}: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return str(found[0]) if found else ""


def meant(path: Path) -> str:
    """The check that a mutant's docstring names."""
    return _told(path, "caught by")


def _quick() -> set[Path]:
    """The first mutant of each of the first causes of each check."""
    causes: dict[str, set[str]] = {}
    quick = set()
    for path in MUTANTS:
        known = causes.setdefault(meant(path), set())
        if len(known) < CAUSES and _told(path, "cause") not in known:
            known.add(_told(path, "cause"))
            quick.add(path)
    return quick


def _marked(paths: list[Path], quick: set[Path]) -> list[object]:
    slow = pytest.mark.slow
    return [pytest.param(p, id=p.stem, marks=() if p in quick else slow) for p in paths]


@pytest.mark.parametrize("path", _marked(MUTANTS, _quick()))
def test_mutant_is_refuted(path: Path) -> None:
    report = montecarlo_brdf.run(montecarlo_brdf.load(str(path)), names=[meant(path)])
    assert "fail" in [f.verdict for r in report.results for f in r.findings]


@pytest.mark.parametrize("path", _marked(HONEST, {p for p in HONEST if p.stem not in LONG}))
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
    assert {p.stem for p in MUTANTS if _told(p, "cause") not in known} == set()


def test_every_check_has_a_mutant() -> None:
    assert set(checks.names()) == {meant(p) for p in MUTANTS}
