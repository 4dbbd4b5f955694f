"""Smith's Lambda, the energy table and Fresnel against mpmath and independent formulas."""

from __future__ import annotations

import math
from types import FunctionType
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from cases import IDS, VARIANTS, made

from montecarlo_brdf.compile.bind import names_used, references
from montecarlo_brdf.models import _energy, _smith
from montecarlo_brdf.models._fresnel import conductor, dielectric

MU = (2.5e-16, 1e-8, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.5, 0.7, 0.9, 0.99, 0.999999, 1.0)
DIGITS = 40
INSTRUCTIONS = {"sqrt", "copysign", "pi", "inf"}


def error(got: float, mu: float, hidden: Any) -> float:
    """Error of mu Lambda against mu (1 + Lambda), which is what masking divides by."""
    return float(abs(got - hidden) / (mu + hidden))


def direction(mu: float) -> tuple[float, float, float]:
    return math.sqrt((1.0 - mu) * (1.0 + mu)), 0.0, mu


@pytest.mark.parametrize("n", [0.0, 0.5, 1.0, 10.0, 100.0, 199.0, 1e4])
def test_blinn_phong_masking(n: float) -> None:
    p = _smith.blinn_phong_series(n)
    with mp.workdps(DIGITS):
        c = mp.gamma((n + mp.mpf(3)) / 2) / (mp.sqrt(mp.pi) * mp.gamma((n + mp.mpf(2)) / 2))
        for mu in MU:
            s2 = 1 - mp.mpf(mu) ** 2
            low = mp.betainc(0.5, (n + mp.mpf(2)) / 2, 0, mp.mpf(mu) ** 2, regularized=True)
            hidden = c * s2 ** (mp.mpf(n) / 2 + 1) / (n + mp.mpf(1)) - mu * (1 - low) / 2
            assert error(_smith.blinn_phong_hidden(direction(mu), p), mu, hidden) < 4e-15


@pytest.mark.parametrize("alpha", [1e-4, 1e-3, 0.01, 0.3, 1.0])
def test_beckmann_masking(alpha: float) -> None:
    with mp.workdps(DIGITS):
        for mu in MU:
            side = alpha * mp.mpf(direction(mu)[0])
            a = mu / side if side else mp.inf
            lead = side * mp.exp(-a * a) / mp.sqrt(mp.pi) if side else 0
            hidden = (lead - mu * mp.erfc(a)) / 2
            assert error(_smith.beckmann_hidden(direction(mu), alpha), mu, hidden) < 2e-15


def test_beckmann_masking_at_every_slope() -> None:
    """x = cot(theta)/alpha from the horizon to where nothing is masked any more."""
    alpha = 0.7
    with mp.workdps(DIGITS):
        for x in np.concatenate([np.geomspace(1e-6, 0.1, 500), np.linspace(0.1, 7.0, 2000)]):
            mu = alpha * float(x) / math.hypot(1.0, alpha * float(x))
            sin = math.sqrt((1.0 - mu) * (1.0 + mu))
            side = alpha * mp.mpf(sin)
            lead = side * mp.exp(-((mu / side) ** 2)) / mp.sqrt(mp.pi)
            hidden = (lead - mu * mp.erfc(mu / side)) / 2
            assert error(_smith.beckmann_hidden((sin, 0.0, mu), alpha), mu, hidden) < 1.5e-15


@pytest.mark.parametrize("mu", MU)
def test_lost_energy_at_alpha_1(mu: float) -> None:
    """Closed form: GGX of alpha 1 is Lommel-Seeliger."""
    truth = mu * math.log1p(1.0 / mu)
    assert _energy.lost_exactly(mu, 1.0) == pytest.approx(truth, rel=1e-13)
    assert _energy.lost(mu, _energy.table(1.0, 1.0)) == pytest.approx(truth, rel=1e-13)


def albedo(mu: float, alpha: float) -> Any:
    """E from D and masking as they are written, over the elevation of wi, to 20 digits."""
    a2, mu_o = mp.mpf(alpha) ** 2, mp.mpf(mu)
    up_o = mp.asin(mu_o)

    def stretched(m: Any) -> Any:
        return mp.sqrt(m * m + a2 * (1 - m * m))

    def part(up: Any) -> Any:
        mu_i = mp.sin(up)
        s, d = (up + up_o) / 2, (up - up_o) / 2
        minus = 4 * mp.sin(s) ** 2 * (mp.sin(d) ** 2 + a2 * mp.cos(d) ** 2)
        plus = 4 * mp.cos(d) ** 2 * (mp.cos(s) ** 2 + a2 * mp.sin(s) ** 2)
        a, root = 4 * mp.sin(s) ** 2 * mp.cos(d) ** 2 * (1 - a2), mp.sqrt(minus * plus)
        around = 2 * a2 * (1 + 2 * a / root + a * a * (minus + plus) / (2 * root**3))
        smith = mu_i * stretched(mu_o) + mu_o * stretched(mu_i)
        return around * mu_i * mp.cos(up) / (2 * smith)

    depth = math.ceil(-math.log(min(mu, alpha), 4)) + 1
    steps = [mp.mpf(4) ** -k for k in range(depth)]
    peaks = (mp.mpf(0), up_o, mp.pi / 2)
    cuts = {c for peak in peaks for k in steps for c in (peak - k, peak, peak + k)}
    inside = sorted(c for c in cuts if 0 <= c <= mp.pi / 2)
    return mp.quad(part, inside, method="gauss-legendre", maxdegree=4)


@pytest.mark.parametrize("alpha, mu", [(1e-4, 0.6), (1e-4, 3e-4), (0.03, 1e-9), (0.5, 1.0)])
def test_lost_energy_keeps_its_digits(alpha: float, mu: float) -> None:
    with mp.workdps(25):
        truth = float(1 - albedo(mu, alpha))
    assert _energy.lost_exactly(mu, alpha) == pytest.approx(truth, rel=1e-12)


@pytest.mark.parametrize("alpha", [1e-4, 2e-4, 1e-3, 0.01, 0.1, 0.5, 0.9])
def test_table_of_lost_energy(alpha: float) -> None:
    p = _energy.table(alpha, 1.0)
    for mu in np.concatenate([10.0 ** np.linspace(-16, 0, 60), np.linspace(0.01, 1.0, 60)]):
        exact = _energy.lost_exactly(float(mu), alpha)
        assert _energy.lost(float(mu), p) == pytest.approx(exact, rel=1e-10, abs=0.0)


def test_lost_energy_at_the_last_numbers_above_the_horizon() -> None:
    values = [_energy.lost(mu, _energy.table(0.1, 1.0)) for mu in (0.0, 5e-324, 1e-300, 1e-18)]
    assert values[0] == 0.0 and values == sorted(values) and values[-1] < 1e-15


def test_fresnel_limits() -> None:
    for x in (1e-16, 0.3, 1.0):
        assert dielectric(x, 1.0) == conductor(x, 1.0, 0.0) == 0.0
        assert conductor(x, 1.5, 0.0) == pytest.approx(dielectric(x, 1.5), rel=1e-14)
    assert dielectric(1.0, 1.5) == pytest.approx(0.04, rel=1e-15)
    faint = ((1.000001 - 1.0) / 2.000001) ** 2
    assert dielectric(1.0, 1.000001) == pytest.approx(faint, rel=1e-14)
    assert conductor(1.0, 1.000001, 0.0) == pytest.approx(faint, rel=1e-14)
    metal = (0.64 + 15.21) / (1.44 + 15.21)  # ((eta - 1)^2 + k^2)/((eta + 1)^2 + k^2)
    assert conductor(1.0, 0.2, 3.9) == pytest.approx(metal, rel=1e-14)


def reached(function: FunctionType, found: dict[int, FunctionType]) -> dict[int, FunctionType]:
    """Every plain function that `function` can call."""
    if id(function) not in found:
        found[id(function)] = function
        for value in references(function, {}).values():
            if isinstance(value, FunctionType):
                reached(value, found)
    return found


@pytest.mark.parametrize("variant", VARIANTS, ids=IDS)
def test_no_call_leaves_the_loop(variant: Any) -> None:
    """A libm call keeps a loop scalar; what is a machine instruction does not."""
    model = made(variant)
    for start in (model.f, model.sample, model.pdf):
        for function in reached(start, {}).values():
            used = set(names_used(function.__code__)) - set(function.__globals__)
            assert not used & (set(dir(math)) - INSTRUCTIONS), function.__name__
