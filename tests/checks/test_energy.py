"""Where energy is looked for."""

from __future__ import annotations

from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import energy

MUTANTS = Path(__file__).parents[1] / "mutants"


def verdicts(name: str, *names: str) -> dict[str, str]:
    """What some checks say of a mutant."""
    report = mb.run(mb.load(str(MUTANTS / f"{name}.py")), names=names)
    return {r.check: str(r.verdict) for r in report.results}


def test_energy_is_asked_where_the_sampler_does_not_draw() -> None:
    model = mb.load(str(MUTANTS / "diffuse_never_drawn.py"))
    case = Case(model, model.parameters(), (45.0,), free=tuple(model.domain))
    assert next(iter(energy.claims(case))).where["blend"] == 1.0


def test_f_is_not_refuted_by_a_sampler_that_contradicts_its_pdf() -> None:
    """The mean of f cos/pdf is 7 where pdf is that wrong, and f reflects less than 1."""
    assert verdicts("pdf_of_neither_normals", "energy") == {"energy": "pass"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pdf_clamps_widths", "pdf_of_neither_normals"])
def test_what_contradicts_its_pdf_is_refuted_as_that_alone(name: str) -> None:
    assert verdicts(name, "energy", "pdf") == {"energy": "pass", "pdf": "fail"}
