"""Kernels compute what their Python source says, however the work is cut."""
from __future__ import annotations

import math
from typing import Any

import kernels
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.estimate.evaluate import CHUNK, Call, run
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import samplers_of
from montecarlo_brdf.statistics import Moments

#: model -> quantities; every integrand at least once
MODELS = {
    "lambert": ["albedo"],
    "oren_nayar": ["albedo"],
    "phong": ["reverse"],
    "ggx": ["albedo", "bihemispherical"],
}
CASES = [
    (name, f"{quantity}_{sampler}")
    for name, quantities in MODELS.items()
    for quantity in quantities
    for sampler in samplers_of(mb.load(name), Quantity(quantity))
]
#: Reassociation and fused operations move a value by some units of 2^-53, times the condition of
#: the models' powers and square roots (up to 1e3 near the horizon), and sums of 300 by 300 more.
ROUNDING = 1e3 * 300 * 2.0**-53


def close(got: Moments, expected: Moments) -> bool:
    scale = expected.largest
    return (
        got.count == expected.count
        and abs(got.mean - expected.mean) <= ROUNDING * scale
        and abs(got.squares - expected.squares) <= ROUNDING * scale * scale * expected.count
        and abs(got.largest - expected.largest) <= ROUNDING * scale
    )


@pytest.mark.parametrize(("model_name", "integrand"), CASES)
def test_kernel_equals_python(model_name: str, integrand: str) -> None:
    model = mb.load(model_name)
    p = model.parameters()
    points = "sobol" if integrand.endswith("cosine") else "independent"
    job = kernels.job(model, [p], [integrand], points, 42, 256, replicates=2)
    for replicate, got in enumerate(run(job)[0]):
        x = list(kernels.values(model, p, integrand, points, 42, replicate, range(256)))
        assert close(got, kernels.moments(x))


def test_a_wrong_stream_would_be_seen() -> None:
    model = mb.load("oren_nayar")
    p = model.parameters()
    got = run(kernels.job(model, [p], ["albedo_uniform"], "independent", 42, 256))[0][0]
    for key, replicate, first in ((43, 0, 0), (42, 1, 0), (42, 0, 1)):
        indices = range(first, first + 256)
        x = list(kernels.values(model, p, "albedo_uniform", "independent", key, replicate, indices))
        assert not close(got, kernels.moments(x))


@pytest.mark.parametrize("key", [0, (1 << 63) - 1, 1 << 63, (1 << 64) - 1])
@pytest.mark.parametrize("start", [0, (1 << 32) - 5, 1 << 40])
def test_large_keys_and_counters(key: int, start: int) -> None:
    """Ten samples across the end of 32 bits, and keys whose sign bit is set."""
    model = mb.load("oren_nayar")
    p = model.parameters()
    job = kernels.job(model, [p], ["albedo_uniform"], "independent", key, 1 << 41)
    (got,) = job.moments(Call(first=3, many=1, start=start, count=10))
    indices = range(start, start + 10)
    x = list(kernels.values(model, p, "albedo_uniform", "independent", key, 3, indices))
    assert close(got, kernels.moments(x))


@pytest.mark.parametrize("count", [1, 2, 1023, 1024, 1025, 5000])
def test_partial_blocks(count: int) -> None:
    model = mb.load("oren_nayar")
    p = model.parameters()
    job = kernels.job(model, [p], ["albedo_uniform"], "independent", 1, count, replicates=3)
    for replicate, got in enumerate(run(job)[0]):
        indices = range(count)
        x = list(kernels.values(model, p, "albedo_uniform", "independent", 1, replicate, indices))
        assert got.count == count and close(got, kernels.moments(x))


@pytest.mark.parametrize("count", [CHUNK - 1, CHUNK, CHUNK + 1, 5 * CHUNK + 3])
def test_every_sample_is_counted_once(count: int) -> None:
    model = mb.load("oren_nayar")
    p = model.parameters()
    job = kernels.job(model, [p], ["albedo_uniform"], "independent", 1, count, replicates=3)
    ranges: dict[int, list[tuple[int, int]]] = {0: [], 1: [], 2: []}
    for call in job.calls():
        for r in range(call.first, call.first + call.many):
            ranges[r].append((call.start, call.start + call.count))
    for spans in ranges.values():
        ends = [0, *(b for _, b in spans)]
        assert [a for a, _ in spans] == ends[:-1] and ends[-1] == count
    assert [m.count for m in run(job)[0]] == [count] * 3


@pytest.mark.parametrize("count", [100, 5 * CHUNK + 3])
def test_threads_change_no_bit(count: int) -> None:
    model = mb.load("oren_nayar")
    p = model.parameters()
    job = kernels.job(model, [p], ["albedo_uniform"], "independent", 1, count, replicates=5)
    assert run(job, 1) == run(job, 2) == run(job, 7) == run(job, 1)


def test_small_replicates_share_calls_and_change_no_bit() -> None:
    """100 replicates in one call, or each in its own."""
    model = mb.load("oren_nayar")
    p = model.parameters()
    job = kernels.job(model, [p], ["albedo_uniform"], "independent", 1, 1500, replicates=100)
    alone = [job.moments(Call(r, 1, 0, 1500))[0] for r in range(100)]
    assert run(job)[0] == alone


@pytest.mark.parametrize("names", [["albedo_cosine"], ["albedo_uniform", "albedo_cosine"]])
def test_channels_equal_single_runs(names: list[str]) -> None:
    """Not to the bit: another kernel may associate otherwise."""
    model = mb.load("oren_nayar")
    rows = [model.parameters(sigma=s) for s in (0.1, 0.2, 0.6)]
    together = run(kernels.job(model, rows, names, "sobol", 4, 2048, replicates=4))
    single = [
        row for p in rows for row in run(kernels.job(model, [p], names, "sobol", 4, 2048, 4))
    ]
    assert len(together) == len(single) == len(rows) * len(names)
    for a, b in zip(together, single, strict=True):
        assert all(close(x, y) for x, y in zip(a, b, strict=True))


def test_a_constant_has_no_spread() -> None:
    model = mb.load("lambert")
    p = model.parameters(albedo=0.7)
    job = kernels.job(model, [p], ["albedo_cosine"], "independent", 1, 3 * CHUNK + 17)
    (got,) = run(job)[0]
    assert got.squares == 0.0 and got.mean == got.largest
    assert abs(got.mean - 0.7) <= 2.0**-53


def test_not_a_number_and_infinity_stay_visible(user_file: Any) -> None:
    """Fast arithmetic must not assume them away."""
    text = "def f(wo, wi, p):\n    return {} if wi[0] > 0.9 else 0.1\n"
    bad = {"nan.py": "0.0 * (1.0 / (wi[2] - wi[2]))", "inf.py": "1.0 / (wi[2] * 0.0)"}
    for name, value in bad.items():
        model = mb.load(str(user_file(text.format(value), name)))
        e = mb.directional_albedo(model, model.parameters(), 30.0, samples=4096)
        assert not math.isfinite(e.mean)
