"""Parameter sets that are looked at."""

from __future__ import annotations

from pathlib import Path

import montecarlo_brdf as mb
from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case

CORNER = Path(__file__).parents[1] / "mutants" / "brushed_in_one_corner.py"


def test_all_parameters_are_also_asked_at_their_ends_together() -> None:
    model = mb.load(str(CORNER))
    case = Case(model, model.parameters(), (45.0,), free=tuple(model.domain))
    *_, lowest, highest = parameters.extremes(case)
    assert tuple(lowest) == (0.0, 0.0) and tuple(highest) == (1.0, 1.0)
