"""Where energy is looked for."""

from __future__ import annotations

from pathlib import Path

import montecarlo_brdf as mb
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import energy

MUTANTS = Path(__file__).parents[1] / "mutants"


def test_energy_is_asked_where_the_sampler_does_not_draw() -> None:
    model = mb.load(str(MUTANTS / "diffuse_never_drawn.py"))
    case = Case(model, model.parameters(), (45.0,), free=tuple(model.domain))
    assert next(iter(energy.claims(case))).where["blend"] == 1.0
