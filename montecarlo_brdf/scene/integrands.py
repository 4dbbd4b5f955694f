"""What is averaged for reflected radiance: f L cos / pdf, one number per point u in [0, 1)^5.

`F`, `SAMPLE`, `PDF` are bound to a model's functions and `SKY`, `SKY_SAMPLE`, `SKY_PDF` to a sky's;
p = (model, sky) holds the numbers of both. A drawn direction below the horizon counts as 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from montecarlo_brdf.compile.bind import hole
from montecarlo_brdf.sampling.charts import Row
from montecarlo_brdf.sampling.warps import pdf_hemisphere_cosine, random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.scene.radiance import Lit
    from montecarlo_brdf.scene.skies import Shape

F: Callable[..., float] = hole()
SAMPLE: Callable[..., tuple[float, ...]] = hole()
PDF: Callable[..., float] = hole()
SKY: Callable[..., float] = hole()
SKY_SAMPLE: Callable[..., tuple[float, ...]] = hole()
SKY_PDF: Callable[..., float] = hole()

PI = math.pi


def cosine_sample(u1: float, u2: float, p: Shape) -> Vec:
    """For a sky without a sampler of its own."""
    return random_hemisphere_cosine(u1, u2)


def cosine_pdf(w: Vec, p: Shape) -> float:
    """For a sky without a sampler of its own."""
    return pdf_hemisphere_cosine(w)


def cosine(u: Row, wo: Vec, p: Lit) -> float:
    """wi cosine-weighted over the hemisphere."""
    wi = random_hemisphere_cosine(u[0], u[1])
    return F((wo[0], wo[1], wo[2]), wi, p.model) * SKY(wi, p.sky) * PI


def sky(u: Row, wo: Vec, p: Lit) -> float:
    """wi from the sky's sampler."""
    wi = SKY_SAMPLE(u[0], u[1], p.sky)
    if wi[2] <= 0.0:
        return 0.0
    value = F((wo[0], wo[1], wo[2]), wi, p.model) * SKY(wi, p.sky)
    return value * wi[2] / SKY_PDF(wi, p.sky)


def own(u: Row, wo: Vec, p: Lit) -> float:
    """wi from the model's sampler."""
    view = (wo[0], wo[1], wo[2])
    drawn = SAMPLE(view, (u[0], u[1], u[2]), p.model)
    if drawn[2] <= 0.0:
        return 0.0
    wi = drawn[:3]
    return F(view, wi, p.model) * SKY(wi, p.sky) * wi[2] / PDF(view, wi, p.model)


def weighted(u: Row, wo: Vec, p: Lit) -> float:
    """wi from the model's sampler, which returns its weight f cos / pdf."""
    drawn = SAMPLE((wo[0], wo[1], wo[2]), (u[0], u[1], u[2]), p.model)
    if drawn[2] <= 0.0:
        return 0.0
    return drawn[3] * SKY(drawn[:3], p.sky)


def mixed(u: Row, wo: Vec, p: Lit) -> float:
    """wi from the model's sampler or the sky's, half each, over the density of the mixture.

    The halves of u[0] choose and are stretched, so that each sampler gets a whole point set.
    One-sample multiple importance sampling with the balance heuristic: it sees a narrow lobe and a
    small light alike. Source: Veach 1997, "Robust Monte Carlo methods", section 9.2.4.
    """
    view = (wo[0], wo[1], wo[2])
    twice = 2.0 * u[0]
    if twice < 1.0:
        drawn = SAMPLE(view, (twice, u[1], u[2]), p.model)
        wi = drawn[:3]
    else:
        wi = SKY_SAMPLE(twice - 1.0, u[1], p.sky)
    if wi[2] <= 0.0:
        return 0.0
    density = 0.5 * (PDF(view, wi, p.model) + SKY_PDF(wi, p.sky))
    return F(view, wi, p.model) * SKY(wi, p.sky) * wi[2] / density


#: by what chooses the direction
BY_METHOD = {"cosine": cosine, "sky": sky, "own": own, "weighted": weighted, "mixed": mixed}
