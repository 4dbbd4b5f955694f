"""Known BRDFs and densities as functions of arrays: what a model is compared with, wrong ones that
people write among them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.diagnosis.geometry import Geometry

if TYPE_CHECKING:
    from montecarlo_brdf.diagnosis.geometry import Array

PI = math.pi
Distribution = Callable[[Geometry, float], "Array"]
Lambda = Callable[["Array", float], "Array"]
#: of Lambda_o, Lambda_i, geometry and the width
Masking = Callable[["Array", "Array", Geometry, float], "Array"]


class Formula(NamedTuple):
    """A BRDF or a density with its name; `wrong`: what is, if somebody meant the right one."""

    name: str
    words: str  # how its parameter comes from the model's: '{}^2'
    value: Callable[[Geometry, float], Array]
    wrong: str = ""


def _ggx(g: Geometry, a: float) -> Array:
    q = g.normal_half**2 * (a * a - 1.0) + 1.0
    return a * a / (PI * q * q)


def _beckmann(g: Geometry, a: float) -> Array:
    c2 = np.maximum(g.normal_half**2, 1e-300)
    found: Array = np.exp(-(1.0 - c2) / (c2 * a * a)) / (PI * a * a * c2 * c2)
    return found


def _lambda_ggx(cosine: Array, a: float) -> Array:
    tan2 = (1.0 - cosine * cosine) / (cosine * cosine)
    return 0.5 * (np.sqrt(1.0 + a * a * tan2) - 1.0)


def _lambda_beckmann(cosine: Array, a: float) -> Array:
    from scipy.special import erfc

    tan = np.sqrt(np.maximum(1e-30, 1.0 - cosine * cosine)) / cosine
    x = 1.0 / (a * tan)
    found: Array = 0.5 * (np.exp(-x * x) / (x * np.sqrt(PI)) - erfc(x))
    return found


NORMALS: dict[str, tuple[Distribution, Lambda]] = {
    "GGX": (_ggx, _lambda_ggx), "Beckmann": (_beckmann, _lambda_beckmann),
}  # fmt: skip


def _schlick(k: Callable[[float], float]) -> Masking:
    def masking(o: Array, i: Array, g: Geometry, a: float) -> Array:
        one = g.cos_i / (g.cos_i * (1.0 - k(a)) + k(a))
        return one * g.cos_o / (g.cos_o * (1.0 - k(a)) + k(a))

    return masking


def _cavity(o: Array, i: Array, g: Geometry, a: float) -> Array:
    least = np.minimum(g.cos_i, g.cos_o)
    found: Array = np.minimum(1.0, 2.0 * g.normal_half * least / g.out_half)
    return found


#: masking -> what is wrong with it
MASKINGS: dict[str, tuple[Masking, str]] = {
    "correlated masking": (lambda o, i, g, a: 1.0 / (1.0 + o + i), ""),
    "uncorrelated masking": (lambda o, i, g, a: 1.0 / ((1.0 + o) * (1.0 + i)), ""),
    "no masking": (lambda o, i, g, a: 1.0 + 0.0 * i, "masking is missing"),
    "masking of the light only": (
        lambda o, i, g, a: 1.0 / (1.0 + i), "masking of one direction alone: the light's"),
    "masking of the viewer only": (
        lambda o, i, g, a: 1.0 / (1.0 + o) + 0.0 * i,
        "masking of one direction alone: the viewer's"),
    "the light's masking squared": (
        lambda o, i, g, a: 1.0 / (1.0 + i) ** 2,
        "masking of one direction alone: the light's, twice"),
    "V-cavity masking": (_cavity, ""),
    "Lambda without 1/2": (
        lambda o, i, g, a: 1.0 / (1.0 + 2.0 * o + 2.0 * i), "masking: Lambda lacks its 1/2"),
    "Schlick masking, k = alpha/2": (_schlick(lambda a: a / 2.0), ""),
    "Schlick masking, k = (1 + alpha)^2/8": (
        _schlick(lambda a: (1.0 + a) ** 2 / 8.0),
        "masking with the k of direct light, (1 + alpha)^2/8"),
    "Schlick masking, k = (1 + sqrt(alpha))^2/8": (
        _schlick(lambda a: (1.0 + math.sqrt(a)) ** 2 / 8.0), ""),
    "Kelemen masking": (lambda o, i, g, a: g.cos_i * g.cos_o / g.out_half**2, ""),
}  # fmt: skip
TWICE = "masking takes alpha^2 where D takes alpha"
WIDTHS: dict[str, Callable[[float], float]] = {
    "{}": lambda x: x, "{}^2": lambda x: x * x, "sqrt({})": lambda x: math.sqrt(abs(x)),
}  # fmt: skip
NARROWEST, WIDEST, HIGHEST = 1e-4, 1.5, 1e6


def _wide(width: float) -> bool:
    return NARROWEST < width <= WIDEST


def reflections() -> Iterator[Formula]:
    """Microfacet BRDFs of a perfect mirror, without Fresnel, of one width."""
    for words, width in WIDTHS.items():
        for name, (d, lam) in NORMALS.items():
            for masking, (g2, wrong) in MASKINGS.items():
                yield Formula(f"{name}, {masking}", words, _reflection(d, lam, g2, width), wrong)
            yield Formula(
                f"{name}, masking with alpha^2", words, _reflection(d, lam, None, width), TWICE
            )


def _reflection(
    d: Distribution, lam: Lambda, masking: Masking | None, width: Callable[[float], float]
) -> Callable[[Geometry, float], Array]:
    def value(g: Geometry, x: float) -> Array:
        a = width(x)
        if not _wide(a):
            return np.full(len(g.cos_i), np.nan)
        b = a if masking else a * a
        o, i = lam(g.cos_o, b), lam(g.cos_i, b)
        shown = masking(o, i, g, a) if masking else 1.0 / (1.0 + o + i)
        return d(g, a) * shown / (4.0 * g.cos_i * g.cos_o)

    return value


def _exponent(f: Callable[[Geometry, float], Array]) -> Callable[[Geometry, float], Array]:
    def value(g: Geometry, x: float) -> Array:
        return f(g, x) if 0.0 <= x <= HIGHEST else np.full(len(g.cos_i), np.nan)

    return value


PHONG_FOR_BLINN = (
    "Phong's normalisation (n + 2)/(2 pi) on a lobe about h, where about a factor 4 less belongs "
    "((n + 8)/(8 pi))"
)


def lobes() -> Iterator[Formula]:
    """Lobes of one exponent."""
    rows: tuple[tuple[str, Callable[[Geometry, float], Array], str], ...] = (
        ("Phong's lobe with (n + 2)/(2 pi)",
         lambda g, n: (n + 2.0) / (2.0 * PI) * g.mirror**n, ""),
        ("Blinn's lobe with (n + 2)/(2 pi)",
         lambda g, n: (n + 2.0) / (2.0 * PI) * g.normal_half**n, PHONG_FOR_BLINN),
        ("blinn_phong with (n + 8)/(8 pi)",
         lambda g, n: (n + 8.0) / (8.0 * PI) * g.normal_half**n,
         "normalisation (n + 8)/(8 pi) is an approximation: it exceeds 1 near the normal"),
        ("minnaert with (k + 1)/(2 pi)",
         lambda g, k: (k + 1.0) / (2.0 * PI) * (g.cos_i * g.cos_o) ** min(k - 1.0, 50.0), ""),
        ("blinn_phong with (n + 2)(n + 4)/(8 pi (2^(-n/2) + n))",
         lambda g, n: (n + 2.0) * (n + 4.0) / (8.0 * PI * (2.0 ** (-n / 2.0) + n))
         * g.normal_half**n, ""),
    )  # fmt: skip
    return (Formula(name, "{}", _exponent(f), wrong) for name, f, wrong in rows)


def anisotropic(g: Geometry, a: float, b: float) -> Iterator[tuple[str, str, Array]]:
    """(name, what is wrong, values) of anisotropic GGX."""
    if not (_wide(a) and _wide(b)):
        return
    q = g.h[:, 0] ** 2 / a**2 + g.h[:, 1] ** 2 / b**2 + g.normal_half**2
    d = 1.0 / (PI * a * b * q * q) / (4.0 * g.cos_i * g.cos_o)

    def lam(w: Array) -> Array:
        slope = ((a * w[:, 0]) ** 2 + (b * w[:, 1]) ** 2) / w[:, 2] ** 2
        found: Array = 0.5 * (np.sqrt(1.0 + slope) - 1.0)
        return found

    o, i = lam(g.wo), lam(g.wi)
    yield "anisotropic GGX, correlated masking", "", d / (1.0 + o + i)
    yield "anisotropic GGX, uncorrelated masking", "", d / ((1.0 + o) * (1.0 + i))
    yield "anisotropic GGX, no masking", "masking is missing", d


COSINE, UNIFORM = "the cosine", "the uniform hemisphere"
PLAIN: dict[str, Callable[[Geometry], Array]] = {
    COSINE: lambda g: g.cos_i / PI,
    UNIFORM: lambda g: 0.0 * g.cos_i + 0.5 / PI,
    "a disk with radius u in place of sqrt(u)": lambda g: (
        g.cos_i / (2.0 * PI * np.sqrt(np.maximum(1e-12, 1.0 - g.cos_i**2)))
    ),
    "the viewer's cosine": lambda g: g.cos_o / PI,
}


def densities() -> Iterator[Formula]:
    """Densities of solid angle that samplers of one width or exponent have."""
    for words, width in WIDTHS.items():
        for name, (d, lam) in NORMALS.items():
            yield Formula(f"{name} normals, alpha = {words}", words, _of_normals(d, width))
            visible = _of_visible(d, lam, width)
            yield Formula(f"{name} visible normals, alpha = {words}", words, visible)
    rows: dict[str, Callable[[Geometry, float], Array]] = {
        "Phong's lobe, exponent {}": lambda g, n: (n + 1.0) / (2.0 * PI) * g.mirror**n,
        "Phong's lobe about the normal, exponent {}":
            lambda g, n: (n + 1.0) / (2.0 * PI) * g.cos_i**n,
        "Blinn's half vectors, exponent {}":
            lambda g, n: (n + 1.0) / (2.0 * PI) * g.normal_half**n / (4.0 * g.out_half),
    }  # fmt: skip
    for name, f in rows.items():
        yield Formula(name, "{}", _exponent(f))


def _of_normals(
    d: Distribution, width: Callable[[float], float]
) -> Callable[[Geometry, float], Array]:
    def value(g: Geometry, x: float) -> Array:
        a = width(x)
        known = d(g, a) * g.normal_half / (4.0 * g.out_half) if _wide(a) else np.nan
        return known + 0.0 * g.cos_i

    return value


def _of_visible(
    d: Distribution, lam: Lambda, width: Callable[[float], float]
) -> Callable[[Geometry, float], Array]:
    def value(g: Geometry, x: float) -> Array:
        a = width(x)
        known = d(g, a) / (4.0 * g.cos_o * (1.0 + lam(g.cos_o, a))) if _wide(a) else np.nan
        return known + 0.0 * g.cos_i

    return value
