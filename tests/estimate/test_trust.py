"""Estimators that must not be believed are listed as not used, with the reason."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf import references
from montecarlo_brdf.cases.case import pointwise
from montecarlo_brdf.estimate import adaptive, evaluate
from montecarlo_brdf.estimate.ends import ACROSS, Ends, at_ends
from montecarlo_brdf.estimate.trust import Sight, heeding_ends, heeding_rejected, look, reason_unfit
from montecarlo_brdf.statistics import Estimate, estimate
from montecarlo_brdf.vectors import from_degrees

Command = Callable[..., Outcome]


def nothing(samples: int = 16384) -> Estimate:
    return Estimate(0.0, 0.0, samples, (0.0,) * 16, 0.0, 0.0)


@pytest.mark.parametrize("sampler", ["uniform", "cosine"])
def test_a_lobe_that_was_never_hit(sampler: str) -> None:
    reason = reason_unfit(sampler, nothing(), Sight(1e6, 1e6, 0.0), None)
    assert str(reason) == f"a lobe that {sampler} sampling did not hit once in 16384 samples"


def test_black_is_black() -> None:
    assert reason_unfit("cosine", nothing(), Sight(0.0, 0.0, 0.0), None) is None


@pytest.mark.parametrize("seed", [0, 2])
def test_beckmann_too_narrow_to_hit_passes_by_its_own_sampler(seed: int) -> None:
    """It failed for these seeds: uniform sampling found nothing, with no spread."""
    model = mb.load("beckmann")
    p = model.parameters(alpha=1e-4)
    report = mb.furnace(model, p, [0.0], seed=seed, samples=1 << 18)
    assert report.verdict == "pass"


@pytest.mark.parametrize("sampler", ["uniform", "cosine"])
def test_a_narrow_lobe_on_a_bright_base_needs_more_samples(sampler: str) -> None:
    """Some ten of 2^14 samples hit it and make nearly all of the spread: p-values of 1e-34 came of
    that in a study of 2,300 confirmations, though the base gives the mean 16,000 effective samples.
    """
    model = mb.load("ashikhmin_shirley")
    p = model.parameters(rd=1.0, rs=0.04, n=1e4)
    for samples, verdict in ((1 << 14, "unfit"), (1 << 20, "inconclusive")):
        finding = mb.furnace(model, p, [50.0], samples=samples).results[0].findings[0]
        row = next(r for r in finding.estimators if r["estimator"] == sampler)
        few = f"few samples make the spread under {sampler} sampling: needs about"
        assert row["not_used"].startswith(few) == (verdict == "unfit")
        assert (row["verdict"], finding.verdict) == (verdict, "pass")


def test_where_f_may_be_negative_a_small_mean_is_no_lack_of_samples() -> None:
    """Its values cancel; that few of them make the spread is still looked for."""
    e = Estimate(0.01, 1e-5, 1 << 20, (0.01,) * 16, 1.0, 3.0)
    plain, signed = Sight(1.0, 1.0, 0.0), Sight(1.0, 1.0, 0.0, signed=True)
    assert str(reason_unfit("own", e, plain, None)).startswith("105 effective samples")
    assert reason_unfit("own", e, signed, None) is None
    spike = e._replace(largest=1e3)
    assert str(reason_unfit("own", spike, signed, None)).startswith("few samples make the spread")


def test_the_radiance_of_a_model_with_negative_values_is_decided(cli: Command) -> None:
    """Its values cancel to a hundredth at 80 degrees under the tilted sky."""
    command = ["run", "--model", "phong_unclamped", "--check", "radiance", "--theta-o", 80]
    assert cli(*command).code == 0


REJECTS = [("phong_original", 60.0), ("ggx", 60.0), ("ward", 85.0), ("lafortune_willems", 60.0)]


@pytest.mark.parametrize(("name", "theta"), REJECTS)
def test_the_share_of_rejected_draws(name: str, theta: float) -> None:
    """From 4e-4 to a half of the draws, counted in a million."""
    model, wo = mb.load(name), from_degrees(theta)
    p = model.parameters()
    u = np.random.default_rng(1).random((1_000_000, 3))
    drawn, _ = pointwise(model, p).sample(np.array(wo), u)
    share = float(np.mean(drawn[:, 2] <= 0.0))
    assert 0.5 <= at_ends(model, model.prepared(p), wo).rejected / share <= 2.0


def test_rejected_draws_that_a_million_would_hardly_meet() -> None:
    """A half vector further than 45 degrees from the normal: half of (1/2)^((n + 1)/2)."""
    model = mb.load("ashikhmin_shirley")
    p = model.parameters(n=32.0)
    share = at_ends(model, model.prepared(p), (0.0, 0.0, 1.0)).rejected
    assert 0.5 <= share / (0.5 * 0.5**16.5) <= 2.0


def test_no_draw_is_rejected_where_none_can_be() -> None:
    for name in ("lambert", "minnaert"):
        model = mb.load(name)
        ready = model.prepared(model.parameters())
        assert at_ends(model, ready, from_degrees(85.0)).rejected == 0.0


@pytest.mark.parametrize(("samples", "fewest"), [(1 << 10, 9e-4), (1 << 16, 0.0)])
def test_equal_weights_hide_draws_that_are_rejected(samples: int, fewest: float) -> None:
    """A thousandth of Phong's draws at 60 degrees: of 1,024 often none, and all others agree (in
    three of ten seeds the 95 % interval then missed the truth)."""
    model = mb.load("phong_original")
    for seed in range(5):
        report = mb.furnace(model, model.parameters(), [60.0], samples=samples, seed=seed)
        rows = report.results[0].findings[0].estimators
        own = next(r for r in rows if r["estimator"] == "own")
        assert fewest < own["stderr"] < 1e-2 and own["verdict"] != "fail"


def test_rejected_draws_widen_an_error_bar_while_they_are_too_few_to_count() -> None:
    e = Estimate(2.0, 1e-6, 1 << 10, (2.0,) * 16, 4.0, 2.0)
    assert heeding_rejected(e, 0.0) == e
    assert heeding_rejected(e, 1e-9) == e
    assert heeding_rejected(e, 1e-3).stderr == 2e-3
    assert heeding_rejected(e._replace(samples=1 << 14), 1e-3).stderr == 1e-6


def test_what_a_logarithm_at_an_end_adds_to_an_error() -> None:
    """-ln u is spread by 1 in every slice that ends at 0; flat ends add nothing."""
    flat, falling = (1.0,) * 24, tuple(-math.log(0.375 * 0.5**k) for k in range(24))
    ends = Ends(0.0, (falling,) * ACROSS + (flat,) * 3 * ACROSS)
    for samples in (2, 64, 1024, 1 << 14):
        assert ends.spread(samples) == pytest.approx(1.0 / samples, rel=0.05)
    assert ends.spread(1 << 40) == 0.0  # beyond what was looked at
    e = Estimate(2.0, 1e-6, 1 << 10, (2.0,) * 16, 4.0, 2.0)
    assert heeding_ends(e, ends).stderr == pytest.approx(2.0 / 64 / 4, rel=0.05)
    assert heeding_ends(e, Ends(0.0, (flat,) * 4 * ACROSS)) == e
    assert heeding_ends(e, Ends(0.0, ((math.nan,) * 24, flat))) == e


def test_intervals_hold_where_the_draw_nearest_to_an_end_makes_the_error() -> None:
    """Of 1,000 honest intervals at 95 % fewer than 930 hold with a chance of 2e-3."""
    model, wo, samples = mb.load("ashikhmin_shirley"), (0.0, 0.0, 1.0), 1024
    p = model.parameters()
    method = next(m for m in adaptive.methods(model) if m.sampler == "own")
    setting = adaptive.prepare(model, p, type(p), method)
    reals = (*wo, setting.width, *setting.numbers)
    rows = evaluate.run(evaluate.Job(setting.means(), reals, 1, 7, 16 * 1000, samples))[0]
    truth = references.albedo("ashikhmin_shirley", 1.0, **p._asdict())
    assert truth is not None
    found = [estimate(rows[k : k + 16]) for k in range(0, len(rows), 16)]
    ends = look(model, p, wo).ends
    held = [abs(e.mean - truth.value) <= heeding_ends(e, ends).half_width(0.05) for e in found]
    plain = [abs(e.mean - truth.value) <= e.half_width(0.05) for e in found]
    assert sum(plain) < 930 <= sum(held)
