"""montecarlo_brdf.testing: whatever form a BRDF has, and what a failure says."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import pytest

from montecarlo_brdf import load
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.testing import (
    as_model,
    assert_checks,
    assert_conserves_energy,
    assert_converges,
    assert_furnace,
    assert_reciprocal,
    assert_samples_match_pdf,
    require,
)

FEW: dict[str, Any] = {"samples": 1 << 14, "theta_o_deg": (0.0, 60.0)}


class Params(NamedTuple):
    """Of `scaled`."""

    albedo: float = 0.5


def scaled(wo: Any, wi: Any, p: Any) -> float:
    """Lambert."""
    return p.albedo / math.pi


def lopsided(wo: Any, wi: Any, p: Any) -> float:
    """Not reciprocal."""
    return 0.1 * (1.0 + wi[2])


def cosine(wo: Any, u: Any, p: Any) -> Any:
    """Cosine sampling."""
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def uniform(wo: Any, wi: Any, p: Any) -> float:
    """Not the density of `cosine`."""
    return 0.5 / math.pi


FILE = "import math\n\ndef f(wo, wi, p):\n    return 0.5 / math.pi\n"
#: every form that a BRDF may have, all Lambert with albedo 0.5
FORMS: dict[str, Callable[[Path], tuple[Any, Any]]] = {
    "model": lambda path: (load("lambert"), {"albedo": 0.5}),
    "name": lambda path: ("lambert", {"albedo": 0.5}),
    "path": lambda path: (path, None),
    "text": lambda path: (str(path), None),
    "function": lambda path: (scaled, Params()),
    "namespace": lambda path: (SimpleNamespace(f=scaled, Params=Params), {"albedo": 0.5}),
    "class": lambda path: (type("Mine", (), {"f": staticmethod(scaled), "Params": Params}), None),
}


@pytest.mark.parametrize("form", FORMS)
def test_every_form(form: str, user_file: Callable[..., Path]) -> None:
    brdf, p = FORMS[form](user_file(FILE))
    report = assert_furnace(brdf, p, expected=0.5, **FEW)
    asked = [f.quantity for f in report.results[0].findings]
    assert report.verdict == "pass" and asked[:4] == ["A", "A <= 1"] * 2


def test_a_refutation_says_what_and_where() -> None:
    with pytest.raises(AssertionError) as caught:
        assert_furnace(scaled, Params(albedo=1.05), **FEW)
    text = str(caught.value)
    assert "scaled(albedo=1.05): fail" in text
    assert "A <= 1 at theta_o 0°: found 1.05" in text
    assert f"{Path(__file__).name}:{scaled.__code__.co_firstlineno}" in text
    assert "brdf-check run" not in text  # no command could load a function of a test


def test_a_command_reproduces_what_a_command_can_load() -> None:
    with pytest.raises(
        AssertionError, match="reproduce: brdf-check run --model lambert_unnormalised"
    ):
        assert_furnace("lambert_unnormalised", {"c": 0.5}, **FEW)


def test_expected_may_depend_on_the_angle() -> None:
    """A function that is wrong at 60 degrees."""
    with pytest.raises(AssertionError, match="A at theta_o 60°"):
        assert_furnace("lambert", {"albedo": 0.5}, lambda mu, p: 0.5 if mu > 0.9 else 0.4, **FEW)


def test_reciprocity_and_energy() -> None:
    assert_reciprocal(scaled, Params())
    with pytest.raises(AssertionError, match="reciprocity"):
        assert_reciprocal(lopsided)
    with pytest.raises(AssertionError, match="worst A"):
        assert_conserves_energy(scaled, Params(albedo=1.01), **FEW)


def test_samples_against_pdf() -> None:
    own = load("lambert").pdf
    good = SimpleNamespace(f=scaled, Params=Params, sample=cosine, pdf=own)
    assert_samples_match_pdf(good, theta_o_deg=(45.0,), tolerance=0.05)
    with pytest.raises(AssertionError, match="pdf/density"):
        assert_samples_match_pdf(
            SimpleNamespace(f=scaled, Params=Params, sample=cosine, pdf=uniform),
            theta_o_deg=(45.0,),
        )
    with pytest.raises(UserError, match="no sample and pdf"):
        assert_samples_match_pdf(scaled, Params())


def rough(wo: Any, wi: Any, p: Any) -> float:
    """So fast an oscillation that no point set beats independent points; its mean is known."""
    return (1.0 + math.sin(1e7 * wi[0])) / (2.0 * math.pi)


def test_convergence() -> None:
    few: dict[str, Any] = {"sampler": "uniform", "points": ("sobol",), "samples": 1 << 17}
    report = assert_converges("lambert", {"albedo": 0.5}, **few)
    assert [f.quantity for f in report.results[0].findings] == ["slope"]
    brdf = SimpleNamespace(f=rough, albedo=lambda cos_theta_o, p: 0.5)
    with pytest.raises(AssertionError, match="slope"):
        assert_converges(brdf, **few)


def test_undecided_is_no_proof() -> None:
    late = Finding("A", {}, "inconclusive", note="too few samples")
    report = Report(Command.RUN, {}, [Result("m", {}, "furnace", [late])])
    with pytest.raises(AssertionError, match="m: inconclusive\n.*\n    note: too few samples"):
        require(report)
    require(report, "pass")
    with pytest.raises(AssertionError, match="--max-time was over"):
        assert_checks("lambert", max_time=1e-9)


def test_what_is_no_brdf() -> None:
    with pytest.raises(UserError, match="has a function f, not 7"):
        as_model(7)
    with pytest.raises(UserError, match="must take the arguments"):
        as_model(lambda wo, wi: 0.0)
