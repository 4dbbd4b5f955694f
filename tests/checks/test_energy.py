"""Where energy is looked for."""

from __future__ import annotations

from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import energy

MUTANTS = Path(__file__).parents[1] / "mutants"


def test_energy_is_asked_where_the_sampler_does_not_draw() -> None:
    model = mb.load(str(MUTANTS / "diffuse_never_drawn.py"))
    case = Case(model, model.parameters(), (45.0,), free=tuple(model.domain))
    assert next(iter(energy.claims(case))).where["blend"] == 1.0


@pytest.mark.parametrize(
    "name",
    ["pdf_of_neither_normals", pytest.param("pdf_clamps_widths", marks=pytest.mark.slow)],
)
def test_f_is_not_refuted_by_a_sampler_that_contradicts_its_pdf(name: str) -> None:
    """f cos/pdf has the mean 54 and 7 where pdf is that wrong, and f reflects less than 1."""
    model = mb.load(str(MUTANTS / f"{name}.py"))
    found = {r.check: str(r.verdict) for r in mb.run(model, names=["energy", "pdf"]).results}
    assert found == {"energy": "pass", "pdf": "fail"}
