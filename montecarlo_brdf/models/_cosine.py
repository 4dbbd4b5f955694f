"""Cosine-weighted sampling, for models that are nearly diffuse: they import `sample` and `pdf`."""
from __future__ import annotations

import math

from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec


def sample(wo: Vec, u: Vec, p: object) -> Vec:
    """Cosine-weighted."""
    return random_hemisphere_cosine(u[0], u[1])


def pdf(wo: Vec, wi: Vec, p: object) -> float:
    """cos(theta_i)/pi."""
    return wi[2] / math.pi
