"""The judge on synthetic estimates: what it calls pass, fail, inconclusive and known, and when."""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from scipy import stats

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge import mean as judging
from montecarlo_brdf.judge.claim import Kind, MeanClaim, Reference
from montecarlo_brdf.judge.decide import LEVEL, decide
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, worst
from montecarlo_brdf.judge.mean import (
    CONFIRMING_REPLICATES,
    FIRST_LOOK,
    GROWTH,
    LUCK,
    Opinion,
    judged,
    looks,
)
from montecarlo_brdf.statistics import Estimate, quantile

PLAN = Plan(samples=1 << 20)
Measure = Callable[[Plan], list[Measurement]]


def estimate(mean: float, stderr: float, plan: Plan) -> Estimate:
    means = (mean,) * plan.replicates
    return Estimate(mean, stderr, plan.samples, means, mean * mean, mean)


def steady(mean: float, stderr: float, unfit: str | None = None, name: str = "one") -> Measure:
    """An estimator that always says the same, with an error that falls as 1/sqrt(n)."""

    def measure(plan: Plan) -> list[Measurement]:
        error = stderr * math.sqrt(FIRST_LOOK / plan.samples)
        return [Measurement(name, estimate(mean, error, plan), unfit)]

    return measure


def both(*measures: Measure) -> Measure:
    return lambda plan: [m for measure in measures for m in measure(plan)]


def claim(measure: Measure, bound: str = "equal", expected: float | None = 1.0) -> MeanClaim:
    truth = None if expected is None else Reference(expected, 0.0, "closed form", "")
    return MeanClaim("A", {}, bound, truth, 1e-3, measure)


def test_inside_the_tolerance_passes_at_the_first_look() -> None:
    finding = decide(claim(steady(1.0, 1e-5)), PLAN)
    assert (finding.verdict, finding.samples) == ("pass", FIRST_LOOK)


def test_outside_the_tolerance_fails() -> None:
    for mean in (0.9, 1.1):
        assert decide(claim(steady(mean, 1e-5)), PLAN).verdict == "fail"


def test_a_bound_fails_only_above() -> None:
    assert decide(claim(steady(0.5, 1e-5), "at most"), PLAN).verdict == "pass"
    assert decide(claim(steady(1.1, 1e-5), "at most"), PLAN).verdict == "fail"


def test_a_deviation_within_the_tolerance_is_no_failure_however_significant() -> None:
    """A z-test against exactly 1 would refute this at 900 sigma."""
    assert decide(claim(steady(1.0 + 9e-4, 1e-6)), PLAN).verdict == "pass"


def test_an_error_bar_as_wide_as_the_tolerance_is_inconclusive() -> None:
    finding = decide(claim(steady(1.0, 10.0)), PLAN)
    assert (finding.verdict, finding.samples) == ("inconclusive", PLAN.samples)
    assert finding.note is not None and "--samples" in finding.note


def test_more_samples_decide() -> None:
    at_first = decide(claim(steady(1.0, 2.5e-4)), PLAN._replace(samples=FIRST_LOOK))
    in_the_end = decide(claim(steady(1.0, 2.5e-4)), PLAN)
    assert (at_first.verdict, in_the_end.verdict) == ("inconclusive", "pass")


@pytest.mark.parametrize("stderr", [2e-3, 1e-2])
def test_the_samples_that_an_open_claim_names_decide_it(stderr: float) -> None:
    """And are taken unasked where they are within reach."""
    vague = claim(steady(1.0, stderr))
    found = decide(vague, PLAN)
    assert found.verdict == "inconclusive"
    more = 1 << int((found.note or "").rpartition("--samples 2^")[2])
    assert decide(vague, PLAN._replace(samples=more)).verdict == "pass"
    reached = decide(vague, PLAN._replace(reach=GROWTH * more))
    assert reached.verdict == "pass" and more <= reached.samples * GROWTH
    assert decide(vague, PLAN._replace(reach=PLAN.samples)).samples == PLAN.samples


def test_what_no_samples_within_reach_decide_takes_none_of_them() -> None:
    far = claim(steady(1.0, 10.0))
    assert decide(far, PLAN._replace(reach=1 << 24)).samples == PLAN.samples
    alone = claim(steady(1.0, 2e-3), expected=None)  # nothing to be held against
    assert decide(alone, PLAN._replace(reach=1 << 24)).samples == PLAN.samples


def test_not_a_number_fails() -> None:
    finding = decide(claim(steady(math.nan, math.nan)), PLAN)
    assert finding.verdict == "fail"
    assert finding.hint is not None and "not finite" in finding.hint
    assert decide(claim(steady(math.nan, math.nan), "at most"), PLAN).verdict == "fail"


def test_a_failure_that_a_fresh_stream_does_not_see_is_inconclusive() -> None:
    def unlucky(plan: Plan) -> list[Measurement]:
        first_stream = plan.seed == PLAN.seed
        return [Measurement("one", estimate(1.1 if first_stream else 1.0, 1e-6, plan))]

    assert decide(claim(unlucky), PLAN).verdict == "inconclusive"


def test_of_two_that_refute_only_the_confirmed_one_is_shown() -> None:
    def measure(plan: Plan) -> list[Measurement]:
        lucky = Measurement("precise", estimate(1.1 if plan.seed == PLAN.seed else 1.0, 1e-7, plan))
        return [lucky, Measurement("sure", estimate(1.2, 1e-6, plan))]

    finding = decide(claim(measure), PLAN)
    assert (finding.verdict, finding.estimator) == ("fail", "sure")
    assert [e["verdict"] for e in finding.estimators] == ["inconclusive", "fail"]


def test_asking_last_does_not_revive_a_refutation_that_was_not_confirmed() -> None:
    def unlucky(plan: Plan) -> list[Measurement]:
        return [Measurement("one", estimate(1.1 if plan.seed == PLAN.seed else 1.0, 1e-6, plan))]

    def last(seed: int) -> Measurement:
        return Measurement("last", estimate(1.0, 1e-6, PLAN))

    finding = decide(replace(claim(unlucky), fallback=last), PLAN)
    assert (finding.verdict, finding.estimator) == ("pass", "last")


@pytest.mark.parametrize(("sure", "verdict"), [(True, "fail"), (False, "inconclusive")])
def test_what_is_asked_last_refutes_only_twice(sure: bool, verdict: str) -> None:
    def last(seed: int) -> Measurement:
        wrong = sure or seed == PLAN.seed
        return Measurement("last", estimate(1.1 if wrong else 1.0, 1e-6 if wrong else 1.0, PLAN))

    finding = decide(replace(claim(steady(1.0, 10.0)), fallback=last), PLAN)
    assert finding.verdict == verdict


@pytest.mark.parametrize("points", ["sobol", "lattice"])
def test_confirmation_uses_a_net_more_replicates_and_a_fresh_seed(points: str) -> None:
    plans: list[Plan] = []

    def measure(plan: Plan) -> list[Measurement]:
        plans.append(plan)
        return [Measurement("one", estimate(1.1, 1e-6, plan))]

    assert decide(claim(measure), PLAN._replace(points=points)).verdict == "fail"
    first, fresh = plans
    assert (first.points, fresh.points) == (points, "sobol")
    assert fresh.replicates == CONFIRMING_REPLICATES >= 64 > first.replicates
    assert fresh.seed != first.seed
    # as precise at least as the look: as many points in every one of its replicates
    assert fresh.samples // fresh.replicates >= first.samples // first.replicates


def test_a_disclaimed_property_is_known_with_its_reason() -> None:
    finding = decide(claim(steady(1.1, 1e-6)), PLAN, known="the paper never promised it")
    assert (finding.verdict, finding.note) == ("known", "the paper never promised it")
    assert decide(claim(steady(1.0, 1e-6)), PLAN, known="never promised").verdict == "pass"


def test_an_unfit_estimator_neither_passes_nor_fails() -> None:
    wrong = steady(5.0, 1e-9, unfit="a lobe that it hardly hits")
    finding = decide(claim(both(steady(1.0, 1e-5), wrong)), PLAN)
    assert finding.verdict == "pass"
    assert finding.estimators[1]["not_used"] == "a lobe that it hardly hits"
    alone = decide(claim(wrong), PLAN)
    assert (alone.verdict, alone.note) == ("inconclusive", "a lobe that it hardly hits")


def test_one_fit_estimator_that_refutes_is_enough() -> None:
    measure = both(steady(1.0, 1e-6, name="right"), steady(1.1, 1e-6, name="wrong"))
    finding = decide(claim(measure), PLAN)
    assert (finding.verdict, finding.estimator, finding.value) == ("fail", "wrong", 1.1)


def test_without_a_reference_estimators_are_held_against_each_other() -> None:
    agree = both(steady(0.7, 1e-6), steady(0.7, 1e-5))
    differ = both(steady(0.7, 1e-6), steady(0.8, 1e-5))
    assert decide(claim(agree, expected=None), PLAN).verdict == "pass"
    assert decide(claim(differ, expected=None), PLAN).verdict == "fail"


def quadrature(value: float) -> Reference:
    return Reference(value, 1e-9, "quadrature of the same f", "")


def test_a_quadrature_of_f_that_samples_of_f_refute_has_missed_something() -> None:
    agree = both(steady(0.7, 1e-6, name="own"), steady(0.7, 1e-5, name="cosine"))
    finding = decide(replace(claim(agree), expected=quadrature(0.5)), PLAN)
    assert (finding.verdict, finding.expected) == ("pass", None)
    # also where the model's own draws see it first
    late = both(steady(0.7, 1e-6, name="own"), steady(0.7, 2e-4, name="cosine"))
    assert decide(replace(claim(late), expected=quadrature(0.5)), PLAN).verdict == "pass"
    differ = both(steady(0.7, 1e-6, name="own"), steady(0.6, 1e-5, name="cosine"))
    assert decide(replace(claim(differ), expected=quadrature(0.5)), PLAN).verdict == "fail"


def test_a_quadrature_of_f_refutes_the_models_own_draws() -> None:
    own_wrong = both(steady(0.7, 1e-6, name="own"), steady(0.5, 1e-5, name="cosine"))
    finding = decide(replace(claim(own_wrong), expected=quadrature(0.5)), PLAN)
    assert (finding.verdict, finding.estimator) == ("fail", "own")
    known = replace(claim(steady(0.7, 1e-6, name="cosine")), expected=Reference(0.5, 0.0, "", ""))
    assert decide(known, PLAN).verdict == "fail"


@pytest.mark.parametrize(("value", "verdict"), [(0.7, "pass"), (0.8, "inconclusive")])
def test_one_estimator_alone_is_held_by_what_is_asked_last(value: float, verdict: str) -> None:
    def last(seed: int) -> Measurement:
        return Measurement("last", estimate(value, 1e-6, PLAN))

    alone = replace(claim(steady(0.7, 1e-6), expected=None), fallback=last)
    assert decide(alone, PLAN).verdict == verdict


def test_the_error_of_a_reference_counts() -> None:
    vague = MeanClaim("A", {}, "equal", Reference(1.0, 0.2, "", ""), 1e-3, steady(1.1, 1e-6))
    assert decide(vague, PLAN).verdict == "inconclusive"


def test_looks_grow_and_end_at_what_is_allowed() -> None:
    assert looks(1) == [1] and looks(FIRST_LOOK) == [FIRST_LOOK]
    sizes = looks(1 << 22)
    assert sizes[0] == FIRST_LOOK and sizes[-1] == 1 << 22
    assert all(b <= GROWTH * a for a, b in zip(sizes, sizes[1:], strict=False))


def test_all_looks_together_spend_less_than_the_level(monkeypatch: pytest.MonkeyPatch) -> None:
    spent: list[float] = []

    def spy(claim: MeanClaim, measurements: list[Measurement], level: float) -> list[Opinion]:
        spent.append(level)
        return judged(claim, measurements, level)

    monkeypatch.setattr(judging, "judged", spy)
    assert decide(claim(steady(1.0, 10.0)), PLAN).verdict == "inconclusive"
    assert len(spent) == len(looks(PLAN.samples)) > 3
    assert math.fsum(spent) < LEVEL


def test_the_margin_is_that_of_students_t() -> None:
    half = quantile(LEVEL / 2.0, 15) * 1e-5
    for share, verdict in ((0.999, "inconclusive"), (1.001, "pass")):
        m = steady(1.0 + 1e-3 - half * share, 1e-5)(PLAN._replace(samples=FIRST_LOOK))
        assert judged(claim(steady(1, 1)), m, LEVEL)[0].verdict == verdict
    for share, verdict in ((0.999, "inconclusive"), (1.001, "fail")):
        m = steady(1.0 + 1e-3 + half * share, 1e-5)(PLAN._replace(samples=FIRST_LOOK))
        assert judged(claim(steady(1, 1)), m, LEVEL)[0].verdict == verdict


def test_the_level_is_shared_by_the_estimators() -> None:
    m = steady(1.0, 1e-4)(PLAN)
    alone = judged(claim(steady(1, 1)), m, 1e-9)[0].half_width
    among_three = judged(claim(steady(1, 1)), m * 3, 3e-9)[0].half_width
    assert alone == among_three


def test_resolves_is_a_deviation_that_the_last_look_would_have_failed() -> None:
    wider = math.sqrt(stats.f.isf(LUCK, 15, 15))  # the spread of one run over that of another
    for error in (1e-6, 1e-5):
        finding = decide(claim(steady(1.0, error)), PLAN)
        assert finding.resolves is not None and finding.resolves > 1e-3
        spread = wider * error
        last = spread * math.sqrt(FIRST_LOOK / PLAN.samples)
        shifted = quantile(0.05, 15) * last  # what 5 % of all runs exceed
        for share, verdict in ((0.999, "fail"), (1.001, "inconclusive")):
            m = steady(1.0 + finding.resolves - share * shifted, spread)(PLAN)
            level = LEVEL * 2.0 ** -len(looks(PLAN.samples))
            assert judged(claim(steady(1, 1)), m, level)[0].verdict == verdict


@pytest.mark.parametrize(("kind", "by"), [(Kind.INDEPENDENT, "cosine"), (Kind.SAME_F, "own")])
def test_what_is_resolved_of_the_same_f_is_what_the_sampler_resolves(kind: Kind, by: str) -> None:
    """A deviation of the others would refute the quadrature, not the model."""
    found = {}
    for name, error in (("cosine", 1e-6), ("own", 1e-5)):
        found[name] = decide(claim(steady(1.0, error, name=name)), PLAN, level=5e-7).resolves
    measure = both(steady(1.0, 1e-6, name="cosine"), steady(1.0, 1e-5, name="own"))
    expected = Reference(1.0, 0.0, kind, "")
    finding = decide(replace(claim(measure), expected=expected), PLAN, level=1e-6)
    assert finding.resolves == found[by]


def report(*verdicts: str) -> Report:
    findings = [Finding("A", {}, v, level=1e-9) for v in verdicts]
    return Report(Command.FURNACE, {}, [Result("m", {}, "furnace", findings)])


@pytest.mark.parametrize(
    ("verdicts", "overall", "code"),
    [
        (("pass", "pass"), "pass", 0),
        (("pass", "known", "skipped"), "pass", 0),
        (("known",), "pass", 0),
        ((), "pass", 0),
        (("pass", "inconclusive"), "inconclusive", 3),
        (("inconclusive", "fail", "pass"), "fail", 1),
        (("fail", "error"), "error", 4),
    ],
)
def test_a_run_is_as_bad_as_its_worst_finding(
    verdicts: tuple[str, ...], overall: str, code: int
) -> None:
    assert (report(*verdicts).verdict, report(*verdicts).exit_code) == (overall, code)
    assert report(*verdicts).level == pytest.approx(1e-9 * len(verdicts))


def test_worst_of_nothing_is_skipped() -> None:
    assert worst([]) == "skipped"


def rows(finding: Finding) -> dict[str, tuple[str, int]]:
    return {r["estimator"]: (r["verdict"], r["samples"]) for r in finding.estimators}


def test_what_can_not_decide_is_not_sampled_to_the_end() -> None:
    """A lobe that cosine sampling would resolve with 1e10 samples, which its own did at once."""
    blunt = steady(1.0, 0.05, name="cosine")
    finding = decide(claim(both(blunt, steady(1.0, 1e-5, name="own"))), PLAN)
    assert finding.verdict == "pass"
    verdict, samples = rows(finding)["cosine"]
    assert verdict == "inconclusive" and samples < PLAN.samples
    reason = next(r["not_used"] for r in finding.estimators if r["estimator"] == "cosine")
    assert float(reason.rpartition("about ")[2]) > 100 * PLAN.samples


def test_what_may_still_refute_is_sampled_on() -> None:
    """It can not resolve the tolerance, but what it is off is more than the last look will."""
    error = 5e-2
    wrong = steady(1.0 + 7.0 * error, error, name="cosine")
    finding = decide(claim(both(wrong, steady(1.0, 1e-6, name="own"))), PLAN)
    assert finding.verdict == "fail"
    assert rows(finding)["cosine"][1] > FIRST_LOOK


def test_where_none_decides_all_are_sampled_to_the_end() -> None:
    finding = decide(claim(both(steady(1.0, 0.1), steady(1.0, 0.05, name="two"))), PLAN)
    assert (finding.verdict, finding.samples) == ("inconclusive", PLAN.samples)
    assert "needs about" in (finding.note or "")
