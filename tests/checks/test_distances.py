"""The mean of (1 - pdf/density)+: the share of the draws that a pdf does not account for."""

from __future__ import annotations

from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _density
from montecarlo_brdf.checks.pdf import OF_SEVERAL
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import LEVEL
from montecarlo_brdf.statistics import Estimate

TESTS = Path(__file__).parents[1]
PLAN = Plan(samples=1 << 14)  # of the first look


def case(name: str) -> Case:
    model = mb.load(str(TESTS / f"{name}.py"))
    return Case(model, model.parameters(), (45.0,), free=tuple(model.domain))


def deficit(case: Case, theta: float = 45.0, seed: int = 0) -> Estimate:
    return _density.lacking(case, theta, PLAN._replace(seed=seed))[0].estimate


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    "name", ["rare_lobe_by_u0", "azimuth_in_slices", "azimuth_folded", "both_from_one_number"]
)
def test_rare_lobes_seams_and_directions_drawn_twice_are_no_fault_of_a_pdf(
    name: str, seed: int
) -> None:
    """Of 2^14 draws 0.7 are expected within a step of a fold of the azimuth, where the difference
    counts as up to 1: more than 9 have a probability below 1e-8. Fewer than 5: decided."""
    e = deficit(case(f"honest/{name}"), seed=seed)
    assert e.mean <= 9 / PLAN.samples
    assert e.half_width(LEVEL / 2.0) + 5 / PLAN.samples < OF_SEVERAL


def test_a_sampler_that_clamps_is_wrong_at_an_end_only() -> None:
    mine = case("mutants/sampler_clamps_alpha")
    assert deficit(mine).mean < 1e-6
    low, *_, high = parameters.at_extremes(mine)
    assert deficit(*low).mean > 0.1
    assert deficit(*high).mean < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_it_is_the_distance_in_total_variation(seed: int) -> None:
    """Draws in 98 % of the azimuth lack 2 %; u^1.02 for u is off by 0.02 exp(-1) to first order."""
    e = deficit(case("mutants/azimuth_98_percent"), seed=seed)
    assert abs(e.mean - 0.02) < 1e-6
    e = deficit(case("mutants/warp_2_percent_off"), seed=seed)
    assert abs(e.mean - 0.02 / 2.718281828) < e.half_width(1e-6) + 2e-4  # the second order


def test_one_pair_of_numbers_or_several_no_share_is_negative() -> None:
    wrong = deficit(case("mutants/uniform_pdf_cosine_sampler"))
    assert wrong.mean == pytest.approx(0.25, abs=0.01) and min(wrong.replicates) >= 0.0


def test_a_rare_lobe_chosen_by_the_third_number_is_noticed() -> None:
    model = mb.load("0.0015 lambert + 0.9985 ggx")
    assert _density.chooses(Case(model, model.parameters(), (45.0,)), 45.0)
    plain = mb.load("ggx")
    assert not _density.chooses(Case(plain, plain.parameters(), (45.0,)), 45.0)
