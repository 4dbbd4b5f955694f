"""The cause of a wrong model is named where its repair mends everything; of others none is.

What is named over the whole corpus stands in scripts/causes.py; here are the kinds of repairs, and
what has to be silent. Models are asked as if something had failed: no check is run.
"""

from __future__ import annotations

import json
import runpy
from pathlib import Path

import pytest

from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.diagnosis.cause import Examined
from montecarlo_brdf.diagnosis.repair import Repair
from montecarlo_brdf.loading import load

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
#: wrong model -> words of its cause
NAMED = {
    "ggx_missing_pi": "1/pi is missing: f is 3.14159 times GGX, correlated masking (alpha)",
    "nan_at_grazing": "exactly where the smaller cosine < 1e-05 (towards grazing)",
    "ggx_pdf_swapped": "pdf is the density of the draws with wo and wi swapped",
    "mix_lobes_swapped": "sample draws them 0.4 : 0.6, pdf weighs them 0.6 : 0.4",
    "weight_not_divided_by_pdf": "the weight is f cos: it is not divided by the pdf",
    "albedo_squared_inside": "albedo^2 stands where albedo is meant",
    "lambert_cosine_in_f": "a cosine of one direction alone: cos_i is included",
}
MORE = {
    "ggx_vndf_missing_jacobian": "wo.h is included",
    "ggx_sampler_alpha_squared": "sample draws GGX normals, alpha = alpha^2",
    "phong_folded": "folded up, not rejected",
    "rejection_not_accounted": "pdf knows nothing of the rejected draws",
    "samples_not_unit": "not of unit length",
    "oren_nayar_degrees": "oren_nayar with sigma in degrees",
    "weights_beyond_1": "weights that add up beyond 1",
}


def repair(path: Path) -> Repair | None:
    """The cheapest repair that mends all that is seen to fail."""
    model = load(str(path))
    case = Case(model, model.parameters(), (), free=searched(model, {}))
    return Examined(case, []).chosen()


@pytest.mark.parametrize(
    "name", [*NAMED, *(pytest.param(n, marks=pytest.mark.slow) for n in MORE)]
)
def test_the_cause_is_named(name: str) -> None:
    found = repair(TESTS / "mutants" / f"{name}.py")
    assert found is not None and {**NAMED, **MORE}[name] in found.sentence


#: f does not depend on alpha, but A / alpha is pi
TEMPTING = """
from typing import NamedTuple
class Params(NamedTuple):
    alpha: float = 0.4962
domain = {"alpha": (0.1, 1.0)}
def f(wo, wi, p):
    return 0.4962 * (1.0 + 0.1 * wo[2] * wi[2])
"""
#: pdf lacks 1/pi, and f is not reciprocal
TWICE = """
import math
from typing import NamedTuple
class Params(NamedTuple):
    albedo: float = 0.6
domain = {"albedo": (0.0, 1.0)}
def f(wo, wi, p):
    return p.albedo / math.pi * (1.0 + 0.3 * wo[0] * wi[1])
def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])
def pdf(wo, wi, p):
    return wi[2]
"""


@pytest.mark.parametrize("source", [TEMPTING, TWICE], ids=["tempting", "twice"])
def test_no_cause_is_named(source: str, tmp_path: Path) -> None:
    """Of a number near pi times a parameter, and of two mistakes at once."""
    path = tmp_path / "wrong.py"
    path.write_text(source, encoding="utf-8")
    assert repair(path) is None


def test_the_page_of_causes_is_that_of_its_results() -> None:
    """No mutant is told a false cause; if the page is old: python scripts/causes.py"""
    script = runpy.run_path(str(ROOT / "scripts" / "causes.py"))
    rows = json.loads(script["RESULTS"].read_text(encoding="utf-8"))
    assert script["page"](rows) == script["PAGE"].read_text(encoding="utf-8")
    assert "- 0 of 189 mutants are told a false one" in script["page"](rows)
    told = {k.split("/")[1]: r.get("cause", "") for k, r in rows.items()}
    assert all(told[name].startswith(read["told"]) for name, read in script["READ"].items())
