"""Rates as claimed, and wrong point sets caught: a true claim is refuted with chance 1e-6 each."""
from __future__ import annotations

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.bits import u32
from montecarlo_brdf.compile import bitcode, compiler, kernel
from montecarlo_brdf.sampling import charts, points
from montecarlo_brdf.verify.converge import CLAIMS, SLACK, converge

SMALL = 1 << 17


def verdicts(report):
    return {
        (f.where["sampler"], f.where["points"]): f.verdict for f in report.results[0].findings
    }


@pytest.fixture
def fresh_kernels(monkeypatch):
    """Functions already compiled would hide what a test replaces."""
    monkeypatch.setattr(kernel, "_kernels", {})
    monkeypatch.setattr(bitcode, "_parts", {})
    compiler.specialiser.cache_clear()
    yield
    compiler.specialiser.cache_clear()


@pytest.mark.parametrize(
    ("name", "values", "theta", "chart"),
    [
        ("ggx", {"alpha": 0.3}, 60.0, "half_vector"),
        ("ggx", {"alpha": 0.01}, 85.0, "half_vector"),
        ("oren_nayar", {"sigma": 0.5}, 60.0, "panels"),
        ("phong", {"n": 1e5}, 75.0, "mirror"),
    ],
)
def test_charts_converge_as_claimed(name, values, theta, chart):
    model = mb.load(name)
    report = converge(model, model.parameters(**values), theta, sampler=chart)
    assert set(verdicts(report).values()) == {"pass"}
    for finding in report.results[0].findings:
        assert finding.value < CLAIMS[finding.where["points"]][0] + SLACK


@pytest.mark.parametrize("sampler", ["cosine", "own"])
def test_kinked_and_cut_integrands_converge_as_claimed(sampler):
    for name in ("oren_nayar", "ggx"):
        model = mb.load(name)
        points = ["stratified", "sobol", "lattice"]
        report = converge(model, None, 60.0, sampler=sampler, points=points)
        assert set(verdicts(report).values()) == {"pass"}


def test_a_constant_integrand_has_no_slope():
    model = mb.load("lambert")
    report = converge(model, None, 60.0, sampler="cosine", points="sobol", samples=SMALL)
    (finding,) = report.results[0].findings
    assert finding.verdict == "skipped" and "exact at every N" in finding.note


def left_shifts(x: int) -> int:
    """The second Sobol dimension with its shifts the wrong way: marginals stay right."""
    x = x ^ u32(x << u32(16))
    x = x ^ (u32(x << u32(8)) & u32(0xFF00FF00))
    x = x ^ (u32(x << u32(4)) & u32(0xF0F0F0F0))
    x = x ^ (u32(x << u32(2)) & u32(0xCCCCCCCC))
    return x ^ (u32(x << u32(1)) & u32(0xAAAAAAAA))


def test_a_wrong_second_sobol_dimension_is_refuted(monkeypatch, fresh_kernels):
    monkeypatch.setattr(points, "pascal_reversed", left_shifts)
    assert points.sobol.__globals__["pascal_reversed"] is left_shifts
    report = converge(mb.load("oren_nayar"), None, 60.0, sampler="panels", points="sobol")
    assert report.verdict == "fail"


def test_a_lattice_without_periodisation_is_refuted(monkeypatch, fresh_kernels):
    monkeypatch.setattr(charts, "smooth_step", lambda u: (u, 1.0 - u, 1.0))
    report = converge(mb.load("oren_nayar"), None, 60.0, sampler="panels", points="lattice")
    assert report.verdict == "fail"


def test_report_tells_samples_needed():
    report = converge(mb.load("ggx"), None, 60.0, sampler="half_vector", points="lattice")
    assert "1e-06: 2^8, 1e-09: 2^9" in report.results[0].findings[0].note


def test_results_do_not_depend_on_threads():
    model = mb.load("ggx")
    one, two = (
        converge(model, None, 60.0, sampler="own", threads=t, samples=1 << 19).to_dict()["results"]
        for t in (1, 2)
    )
    assert one == two
