"""The standard lighting equation of fixed-function shading, per channel, also read as a BRDF.

c = emission + ambient_light * ambient_colour
  + sum over lights of E_k ( diffuse max(n.l, 0) + specular lobe^gloss )   where n.l > 0

with the lobe max(r.v, 0) of Phong 1975 or max(n.h, 0) of Blinn 1977. The specular term has no
cosine of the light and is dropped when n.l <= 0. Printed in some texts with the gloss exponent on
the diffuse cosine too; `gloss_on_diffuse` is that variant. The ambient colour defaults to the
diffuse colour.

It never claimed to conserve energy. What it adds per light, divided by the irradiance E mu_i, is
f = kd [mu_i^(g-1)] + ks lobe^gloss / mu_i: the diffuse colour without 1/pi and a highlight without
the light's cosine. In this form (`as_surface`) its albedo and its energy can be asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import NamedTuple

from montecarlo_brdf.contract import build
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.models._half_lobe import pdf, sample
from montecarlo_brdf.models._microfacet import half_power, half_sums
from montecarlo_brdf.scene.colour import Colour
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.special import power
from montecarlo_brdf.vectors import Vec, dot, half_vector, mirrored


class Form(StrEnum):
    """Whose cosine the highlight is a power of."""

    PHONG = "phong"
    BLINN = "blinn"


class Standard(NamedTuple):
    """The surface of the standard lighting equation."""

    diffuse: Colour
    specular: Colour
    gloss: float = 32.0
    form: Form = Form.PHONG
    ambient: Colour | None = None  # None: the diffuse colour
    gloss_on_diffuse: bool = False

    @property
    def ambient_colour(self) -> Colour:
        """What ambient light is multiplied with."""
        return self.diffuse if self.ambient is None else self.ambient

    def as_surface(self) -> Surface:
        """The two lobes of the equation."""
        return Surface((_diffuse(self), _specular(self)))


def shade(
    s: Standard, wo: Vec, lights: Sequence[tuple[Vec, Colour]], ambient: Colour, emission: Colour
) -> Colour:
    """The colour seen from wo under lights (direction, irradiance), n = (0, 0, 1)."""
    total = [
        math.fsum((e, a * k)) for e, a, k in zip(emission, ambient, s.ambient_colour, strict=True)
    ]
    for wi, light in lights:
        n_l = wi[2]
        if n_l <= 0.0:
            continue
        spread = n_l**s.gloss if s.gloss_on_diffuse else n_l
        highlight = lobe(s, wo, wi) ** s.gloss
        for c, e in enumerate(light):
            total[c] += e * (s.diffuse[c] * spread + s.specular[c] * highlight)
    return tuple(total)


def lobe(s: Standard, wo: Vec, wi: Vec) -> float:
    """max(r.v, 0) or max(n.h, 0)."""
    if s.form is Form.PHONG:
        return min(1.0, max(0.0, dot(mirrored(wi), wo)))
    return min(1.0, max(0.0, half_vector(wi, wo)[2]))


class Gloss(NamedTuple):
    """The exponent."""

    n: float = 32.0


def blinn(wo: Vec, wi: Vec, p: Gloss) -> float:
    """(n.h)^n/mu_i."""
    return half_power(half_sums(wo, wi), p.n) / wi[2]


def glossy_diffuse(wo: Vec, wi: Vec, p: Gloss) -> float:
    """mu_i^(n-1): the printed variant with the gloss exponent on the diffuse cosine."""
    return power(wi[2], p.n - 1.0)


def _width(p: Gloss) -> float:
    return math.sqrt(2.0 / (p.n + 2.0))


def _model(name: str, f: Callable[..., float], **more: object) -> Model:
    """A model of this file, with the exponent as its parameter."""
    return build(name, {"__doc__": name, "Params": Gloss, "f": f, **more})


def _diffuse(s: Standard) -> Lobe:
    if s.gloss_on_diffuse:
        return _lobe("diffuse", s.diffuse, _model("diffuse", glossy_diffuse), Gloss(s.gloss))
    model = load("lambert_unnormalised")
    return _lobe("diffuse", s.diffuse, model, model.parameters(c=1.0))


def _specular(s: Standard) -> Lobe:
    if s.form is Form.PHONG:
        model = load("phong_original", norm="none")
        return _lobe("specular", s.specular, model, model.parameters(ks=1.0, n=s.gloss))
    functions = {"sample": sample, "pdf": pdf, "lobe": ("half vector", _width)}
    return _lobe("specular", s.specular, _model("blinn", blinn, **functions), Gloss(s.gloss))


def _lobe(name: str, colour: Colour, model: Model, p: ParameterSet) -> Lobe:
    """The same parameters in every channel."""
    return Lobe(name, colour, model, (p,) * len(colour))


def factors(s: Standard) -> tuple[float, float]:
    """What the diffuse and the specular colour must be multiplied with, beside n.l for the latter.

    Then the lobes are Lambert and normalised Phong (Lafortune & Willems 1994) or Blinn-Phong
    (Giesen 2009), whose albedos are at most their colours.
    """
    n = s.gloss
    phong = (n + 2.0) / (2.0 * math.pi)
    blinn = (n + 2.0) * (n + 4.0) / (8.0 * math.pi * (2.0 ** (-0.5 * n) + n))
    return 1.0 / math.pi, phong if s.form is Form.PHONG else blinn


def mend(s: Standard) -> str:
    """What makes a surface of it that conserves energy."""
    diffuse, specular = factors(s)
    phong = s.form is Form.PHONG
    norm = "(n + 2)/(2 pi)" if phong else "(n + 2)(n + 4)/(8 pi (2^(-n/2) + n))"
    exponent = ", without the exponent on its cosine" if s.gloss_on_diffuse else ""
    return (
        f"it would with the diffuse colour times 1/pi = {diffuse:.4g}{exponent}, the specular "
        f"colour times {norm} = {specular:.4g} and n.l, and diffuse + specular <= 1"
    )
