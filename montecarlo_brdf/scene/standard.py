"""The standard lighting equation of fixed-function shading, per channel.

c = emission + ambient_light * ambient_colour
  + sum over lights of E_k ( diffuse max(n.l, 0) + specular lobe^gloss )   where n.l > 0

with the lobe max(r.v, 0) of Phong 1975 or max(n.h, 0) of Blinn 1977. The specular term has no
cosine of the light and is dropped when n.l <= 0. Printed in some texts with the gloss exponent on
the diffuse cosine too; `gloss_on_diffuse` is that variant. The ambient colour defaults to the
diffuse colour. It never claimed to conserve energy; `reading` says what surface it is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from montecarlo_brdf.vectors import Vec, dot, half_vector, mirrored

FORMS = ("phong", "blinn")
Colour = tuple[float, ...]


class Standard(NamedTuple):
    """The surface of the standard lighting equation."""

    diffuse: Colour
    specular: Colour
    gloss: float = 32.0
    form: str = "phong"
    ambient: Colour | None = None  # None: the diffuse colour
    gloss_on_diffuse: bool = False

    @property
    def ambient_colour(self) -> Colour:
        """What ambient light is multiplied with."""
        return self.diffuse if self.ambient is None else self.ambient


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
    if s.form == "phong":
        return min(1.0, max(0.0, dot(mirrored(wi), wo)))
    return min(1.0, max(0.0, half_vector(wi, wo)[2]))
