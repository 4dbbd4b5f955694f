"""The standard lighting equation read as a BRDF: f = kd [mu_i^(g-1)] + ks lobe^gloss / mu_i.

What the equation adds per light, divided by the irradiance E mu_i: the diffuse colour without 1/pi
and a highlight without the light's cosine. In this form its albedo and its energy can be asked for.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

from montecarlo_brdf import loading
from montecarlo_brdf.model import Model
from montecarlo_brdf.model_file import build
from montecarlo_brdf.models._half_lobe import half_power_pdf, sample_half_power
from montecarlo_brdf.models._microfacet import half_power, half_sums
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.special import power
from montecarlo_brdf.vectors import Vec


class Gloss(NamedTuple):
    """The exponent."""

    n: float = 32.0


def blinn(wo: Vec, wi: Vec, p: Gloss) -> float:
    """(n.h)^n/mu_i."""
    return half_power(half_sums(wo, wi), p.n) / wi[2]


def sample_blinn(wo: Vec, u: Vec, p: Gloss) -> Vec:
    """A half vector by its cosine power."""
    return sample_half_power(wo, u, p.n)


def pdf_blinn(wo: Vec, wi: Vec, p: Gloss) -> float:
    """Its density."""
    return half_power_pdf(wo, wi, p.n)


def glossy_diffuse(wo: Vec, wi: Vec, p: Gloss) -> float:
    """mu_i^(n-1): the printed variant with the gloss exponent on the diffuse cosine."""
    return power(wi[2], p.n - 1.0)


def _width(p: Gloss) -> float:
    return math.sqrt(2.0 / (p.n + 2.0))


def _model(name: str, f: Any, **more: Any) -> Model:
    return build(name, {"__doc__": name, "Params": Gloss, "f": f, **more}, {}, built_in=False)


def surface_of(s: Standard) -> Surface:
    """The two lobes of the equation."""
    return Surface((_diffuse(s), _specular(s)))


def _diffuse(s: Standard) -> Lobe:
    count = len(s.diffuse)
    if s.gloss_on_diffuse:
        return Lobe(
            "diffuse", s.diffuse, _model("diffuse", glossy_diffuse), (Gloss(s.gloss),) * count
        )
    model = loading.load("lambert_unnormalised")
    return Lobe("diffuse", s.diffuse, model, (model.parameters(c=1.0),) * count)


def _specular(s: Standard) -> Lobe:
    count = len(s.specular)
    if s.form == "phong":
        model = loading.load("phong_original", norm="none")
        return Lobe("specular", s.specular, model, (model.parameters(ks=1.0, n=s.gloss),) * count)
    functions = {"sample": sample_blinn, "pdf": pdf_blinn, "lobe": ("half vector", _width)}
    return Lobe(
        "specular", s.specular, _model("blinn", blinn, **functions), (Gloss(s.gloss),) * count
    )


def as_lobes(scene: Scene) -> Scene:
    """The standard lighting equation as a surface of lobes; other scenes as they are."""
    if not isinstance(scene.surface, Standard):
        return scene
    ambient = zip(scene.emission, scene.ambient, scene.surface.ambient_colour, strict=True)
    glow = tuple(e + a * k for e, a, k in ambient)
    dark = (0.0,) * scene.channels
    return replace(scene, surface=surface_of(scene.surface), emission=glow, ambient=dark)


def factors(s: Standard) -> tuple[float, float]:
    """What the diffuse and the specular colour must be multiplied with, beside n.l for the latter.

    Then the lobes are Lambert and normalised Phong (Lafortune & Willems 1994) or Blinn-Phong
    (Giesen 2009), whose albedos are at most their colours.
    """
    n = s.gloss
    phong = (n + 2.0) / (2.0 * math.pi)
    blinn = (n + 2.0) * (n + 4.0) / (8.0 * math.pi * (2.0 ** (-0.5 * n) + n))
    return 1.0 / math.pi, phong if s.form == "phong" else blinn


def mend(s: Standard) -> str:
    """What makes a surface of it that conserves energy."""
    diffuse, specular = factors(s)
    norm = {
        "phong": "(n + 2)/(2 pi)",
        "blinn": "(n + 2)(n + 4)/(8 pi (2^(-n/2) + n))",
    }[s.form]
    exponent = ", without the exponent on its cosine" if s.gloss_on_diffuse else ""
    return (
        f"it would with the diffuse colour times 1/pi = {diffuse:.4g}{exponent}, the specular "
        f"colour times {norm} = {specular:.4g} and n.l, and diffuse + specular <= 1"
    )
