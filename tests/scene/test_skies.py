"""Skies: their samplers follow their pdf, their irradiances are what they must be."""

import math

import numpy as np
import pytest

from montecarlo_brdf.estimate.quadrature import integrate
from montecarlo_brdf.estimate.regions import Around, Coordinates
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.scene import skies, truth
from montecarlo_brdf.scene.skies import cap_of
from montecarlo_brdf.scene.texels import texel_sky
from montecarlo_brdf.vectors import from_degrees

TILTED = from_degrees(70.0, 40.0)


def _sphere_rule() -> tuple[np.ndarray, np.ndarray]:
    z, weight = np.polynomial.legendre.leggauss(12)
    phi = 2.0 * np.pi * np.arange(24) / 24.0
    z, phi = (a.ravel() for a in np.meshgrid(z, phi, indexing="ij"))
    s = np.sqrt(1.0 - z * z)
    return np.stack([s * np.cos(phi), s * np.sin(phi), z]), np.repeat(
        weight, 24
    ) * 2.0 * np.pi / 24.0


def test_harmonics_are_orthonormal() -> None:
    w, weight = _sphere_rule()
    rows = np.array([skies.harmonics(w, skies.Harmonics(row)) + 0.0 * w[0] for row in np.eye(25)])
    assert np.allclose((rows * weight) @ rows.T, np.eye(25), atol=1e-13)


@pytest.mark.parametrize("tilt", [0.0, 35.0, 90.0])
def test_harmonics_irradiance(tilt: float) -> None:
    """(w.u)^2 and a + b (w.u) are harmonics: their coefficients by quadrature give their E."""
    u = np.array(from_degrees(tilt, 20.0))
    w, weight = _sphere_rule()
    values = 0.7 + 0.2 * (u @ w) + (u @ w) ** 2
    rows = np.array([skies.harmonics(w, skies.Harmonics(row)) + 0.0 * w[0] for row in np.eye(25)])
    found = _irradiance.harmonics([float(c) for c in rows @ (weight * values)])
    exact = _irradiance.linear(0.7, 0.2, u[2]) + _irradiance.quadratic(u[2])
    assert found == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize("band", [0, 1, 2, 3, 4])
def test_harmonics_factors(band: int) -> None:
    coefficients = tuple(float(k == band * (band + 1)) for k in range(25))
    shape = skies.Harmonics(coefficients)

    def g(w: np.ndarray) -> np.ndarray:
        return skies.harmonics(tuple(w.T), shape) * w[:, 2]

    value, error = integrate(g, Coordinates((0.0, 0.0, 1.0)), 1e-11)
    assert abs(value - _irradiance.harmonics(coefficients)) <= error + 1e-13
    assert error < 1e-10


@pytest.mark.parametrize("gamma", [1.0, 20.0, 89.0, 120.0, 170.0])
@pytest.mark.parametrize("beta", [0.0, 50.0, 85.0, 95.0, 150.0])
def test_cap_irradiance_by_quadrature(gamma: float, beta: float) -> None:
    """Closed form against quadrature, also partly and wholly below the horizon."""
    axis, reach = from_degrees(beta, 10.0), math.radians(gamma)
    value, error = integrate(lambda w: w[:, 2], Around(axis, reach), 1e-11)
    assert _irradiance.cap(reach, math.radians(beta)) == pytest.approx(value, abs=1e-10)
    assert error < 1e-10


def _image() -> tuple[skies.Image, object]:
    values = np.random.default_rng(3).random((8, 16, 1)) ** 4 * 5.0
    shapes, keep = texel_sky(values)
    return shapes[0], keep


SHAPES = [cap_of(15.0, TILTED), skies.Cosine(20.0, TILTED), _image()]


@pytest.mark.parametrize("shape", SHAPES, ids=["cap", "cosine", "image"])
def test_sampler_follows_its_pdf(shape: object) -> None:
    """E[g/pdf] is the integral of g where the sky shines, for g that tells directions apart."""
    shape = shape[0] if isinstance(shape, tuple) and not hasattr(shape, "_fields") else shape
    functions = skies.FUNCTIONS[type(shape)]
    k = np.arange(1 << 12)
    u = np.stack(
        [(k + 0.5) / len(k), (k * 0.6180339887498949) % 1.0], axis=1
    )  # a Fibonacci lattice
    for tell in ((1.0, 0.0, 0.0), (0.3, -0.8, 0.5)):
        rows = [functions.sample(*point, shape) for point in u.tolist()]
        terms = [
            functions.radiance(w, shape) * (2.0 + np.dot(w, tell)) / functions.pdf(w, shape)
            for w in rows
        ]
        assert np.allclose([np.dot(w, w) for w in rows], 1.0, atol=1e-14)
        assert np.mean(terms) == pytest.approx(_integral(shape, np.array(tell)), rel=3e-3)


def _integral(shape: object, tell: np.ndarray) -> float:
    """int L (2 + w.tell) over the sphere (an image: over the upper half, where it shines)."""
    if isinstance(shape, skies.Image):
        values = truth._texel_values(shape)[:4]
        theta = (np.arange(4 * 50) + 0.5) * np.pi / 400.0
        phi = -np.pi + (np.arange(16 * 50) + 0.5) * 2.0 * np.pi / 800.0
        t, p = np.meshgrid(theta, phi, indexing="ij")
        w = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
        cells = np.sin(t) * (np.pi / 400.0) * (2.0 * np.pi / 800.0)
        return float(np.sum(np.kron(values, np.ones((50, 50))) * (2.0 + w @ tell) * cells))
    top = np.dot(shape.axis, tell)
    if isinstance(shape, skies.Cap):
        return 2.0 * math.pi * shape.depth * (2.0 + top * (1.0 - 0.5 * shape.depth))
    n = shape.exponent
    return 2.0 * math.pi * (2.0 / (n + 1.0) + top / (n + 2.0))
