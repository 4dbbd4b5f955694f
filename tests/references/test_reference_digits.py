"""References against mpmath at 40 digits, towards the horizon and towards the limits of parameters.

mpmath starts from the same double cosine, so nothing but the reference's own error is left.
"""

from typing import Any

import mpmath as mp
import numpy as np
import pytest
from reference_data import cosine

from montecarlo_brdf import references
from montecarlo_brdf.references._gamma import half_step
from montecarlo_brdf.references._microfacet import blinn_phong, fresnel
from montecarlo_brdf.references._rules import gauss, tanh_sinh

STEEP = (0.01, 1.0, 40.0, 89.0, 89.9, 89.99)


@pytest.fixture(autouse=True)
def _digits() -> Any:
    with mp.workdps(40):
        yield


def check(truth: references.Truth | None, exact: Any, relative: float) -> None:
    assert truth is not None
    error = abs(mp.mpf(truth.value) - exact)
    assert error <= truth.error
    assert error <= relative * abs(exact)


def _theta(mu: Any) -> tuple[Any, Any]:
    return mp.acos(mu), mp.sqrt(1 - mu * mu)


def _b(n: Any) -> Any:
    return mp.sqrt(mp.pi) * mp.gamma((n + 1) / 2) / mp.gamma(n / 2 + 1)


def _sine_integral(n: Any, s: Any) -> Any:
    """Integral of sin^n from 0 to theta, as half an incomplete beta function."""
    return mp.betainc((n + 1) / 2, mp.mpf(1) / 2, 0, s * s) / 2


@pytest.mark.parametrize("n", [0.0, 0.37, 3.0, 50.5, 1e4])
@pytest.mark.parametrize("theta", STEEP)
def test_phong_as_published(theta: float, n: float) -> None:
    mu, m = mp.mpf(cosine(theta)), mp.mpf(n)
    _, s = _theta(mu)
    double = mu + _b(m) / (2 * mp.pi) * (s ** (m + 2) - (m + 1) * mu * _sine_integral(m + 1, s))
    check(references.albedo("phong", cosine(theta), ks=1.0, n=n), double, 1e-13)
    single = 1 - (m + 1) / (2 * mp.pi) * _b(m + 1) * _sine_integral(m, s)
    check(references.albedo("phong_original", cosine(theta), ks=1.0, n=n), single, 1e-13)
    reverse = (m + 1) / (m + 2) * double / mu
    check(references.reverse_albedo("phong_original", cosine(theta), ks=1.0, n=n), reverse, 1e-13)


@pytest.mark.parametrize("theta", STEEP)
def test_minnaert_and_oren_nayar(theta: float) -> None:
    mu, k = mp.mpf(cosine(theta)), mp.mpf(0.3)
    exact = 2 * mu ** (k - 1) / (k + 1)
    check(references.albedo("minnaert", cosine(theta), albedo=1.0, k=0.3), exact, 1e-13)
    angle, s = _theta(mu)
    g = s * (angle - s * mu) + 2 * s / (3 * mu) * (1 - s**3)
    v = mp.mpf(0.7) ** 2
    a, b = 1 - v / (2 * (v + mp.mpf(0.33))), mp.mpf(0.45) * v / (v + mp.mpf(0.09))
    truth = references.albedo("oren_nayar", cosine(theta), albedo=0.9, sigma=0.7)
    check(truth, mp.mpf(0.9) * (a + b / mp.pi * g), 1e-13)


@pytest.mark.parametrize("theta", STEEP)
def test_disney_and_lommel_seeliger(theta: float) -> None:
    mu, r = mp.mpf(cosine(theta)), mp.mpf(0.8)

    def around(i: Any) -> Any:
        """The azimuth integral of (1 + X a)(1 + X c), X = x + y cos dphi."""
        x, y = r - mp.mpf(1) / 2 + r * mu * i, r * mp.sqrt((1 - mu * mu) * (1 - i * i))
        a, c = (1 - i) ** 5, (1 - mu) ** 5
        return 2 * mp.pi * (1 + x * (a + c) + a * c * (x * x + y * y / 2))

    exact = mp.quad(lambda i: around(i) * i / mp.pi, [0, 1])
    truth = references.albedo("disney_diffuse", cosine(theta), albedo=1.0, roughness=0.8)
    check(truth, exact, 1e-13)
    exact = mp.quad(lambda i: i / (i + mu), [0, mu, 1])
    check(references.albedo("lommel_seeliger", cosine(theta), albedo=1.0), exact, 1e-13)


def _ggx_albedo(mu_o: Any, alpha: Any) -> Any:
    """F = 1, correlated Smith: the azimuth of 1/(p + q cos)^2 in closed form, in cosines."""
    s_o = mp.sqrt(1 - mu_o**2)

    def around(mu: Any) -> Any:
        # (n.h)^2 = (mu + mu_o)^2/(2 (1 + w.v)), so D = alpha^2 (1 + w.v)^2/(pi (p + q cos)^2)
        s = mp.sqrt(1 - mu**2)
        e, f = 1 + mu * mu_o, s * s_o
        p, q = e - (1 - alpha**2) * (mu + mu_o) ** 2 / 2, f
        # integral of ((e + f cos)/(p + q cos))^2 over the circle, with d = e - p f/q = e - p
        d, root = e - p, mp.sqrt(p * p - q * q)
        return alpha**2 / mp.pi * 2 * mp.pi * (1 + 2 * d / root + d * d * p / root**3)

    def shadow(mu: Any) -> Any:
        i, o = (mp.sqrt(c * c + alpha**2 * (1 - c * c)) for c in (mu, mu_o))
        return 2 * mu * mu_o / (mu * o + mu_o * i)

    theta = mp.acos(mu_o)
    points = [0, theta - 30 * alpha, theta - alpha, theta, theta + alpha, theta + 30 * alpha]
    inside = sorted({p for p in points if 0 <= p < mp.pi / 2} | {mp.pi / 2 - alpha / 9, mp.pi / 2})
    f = lambda t: around(mp.cos(t)) * shadow(mp.cos(t)) / (4 * mu_o) * mp.sin(t)  # noqa: E731
    return mp.quad(f, inside)


@pytest.mark.parametrize(
    ("alpha", "theta"),
    [(0.001, 0.0), (0.001, 30.0), (0.03, 89.9), (0.2, 89.99), (0.5, 1.0), (1.0, 89.0)],
)
def test_ggx(alpha: float, theta: float) -> None:
    exact = _ggx_albedo(mp.mpf(cosine(theta)), mp.mpf(alpha))
    check(references.albedo("ggx", cosine(theta), alpha=alpha, f0=1.0), exact, 1e-13)
    truth = references.albedo("cook_torrance", cosine(theta), alpha=alpha, fresnel="one")
    check(truth, exact, 1e-13)


@pytest.mark.parametrize("a", [0.5, 1.3, 20.2, 20.3, 5e5])
def test_half_step(a: float) -> None:
    exact = mp.exp(mp.loggamma(mp.mpf(a) + 0.5) - mp.loggamma(mp.mpf(a)))
    assert abs(half_step(a) / exact - 1) < 2e-15


@pytest.mark.parametrize(("n", "mu"), [(1e6, 1.745e-4), (1e6, 1e-3), (1e4, 0.01), (3.0, 0.6)])
def test_what_blinn_phong_hides(n: float, mu: float) -> None:
    """Lambda as defined, (1/nu) int (x - nu) P2(x) dx beyond nu = cot theta: at n = 1e6 it was
    once off by 2e-10, a million roundings of 1 - mu^2."""
    m, nu = mp.mpf(n), mu / mp.sqrt(1 - mp.mpf(mu) ** 2)
    scale = mp.exp(mp.loggamma((m + 3) / 2) - mp.loggamma(m / 2 + 1)) / mp.sqrt(mp.pi)
    edges = [j * mp.sqrt(2 / (m + 2)) for j in (0, 1, 4, 14, 300)]
    tail = mp.quad(lambda z: z * (1 + (nu + z) ** 2) ** (-(m + 3) / 2), [*edges, mp.inf])
    assert abs(blinn_phong(n).lam(np.asarray(mu)) - scale * tail / nu) < 1e-14


@pytest.mark.parametrize("m", [1.000001, 1.5, 0.5, 1.000001 + 1e-7j, 0.2 + 3.9j])
def test_fresnel_next_to_no_interface(m: complex) -> None:
    """The amplitudes as published; m^2 - 1 rounded from m^2 was off by 4e-11 at m = 1 + 1e-6."""
    index = mp.mpmathify(m)
    for x in (0.003, 0.1, 0.6, 1.0):
        c, g = mp.mpf(x), mp.sqrt(index**2 - 1 + mp.mpf(x) ** 2)
        s, p = (c - g) / (c + g), (index**2 * c - g) / (index**2 * c + g)
        exact = (abs(s) ** 2 + abs(p) ** 2) / 2
        got = fresnel(np.array([x]), m.real, m.imag)[0]
        assert abs(got / exact - 1) < 2e-14


@pytest.mark.parametrize("n", [8, 30, 120])
def test_gauss_weights(n: int) -> None:
    nodes = gauss(n)
    for power in (0, 1, 7, 2 * n - 1):
        assert abs(float((nodes.weight * nodes.x**power).sum()) * (power + 1) - 1.0) < 4e-15
    assert np.allclose(nodes.x + nodes.rest, 1.0, rtol=0.0, atol=2e-16)


def test_tanh_sinh_takes_a_singularity() -> None:
    nodes = tanh_sinh(160)
    assert abs(float((nodes.weight * np.log(nodes.x)).sum()) + 1.0) < 1e-14
