"""Skies: radiance L(w) in W/(m^2 sr) from every direction w, each with a way to draw directions.

Every sky has a shape of unit size, multiplied by one scale per channel; the shape's numbers travel
as a NamedTuple through the kernel beside the model's. Axes are unit vectors in the surface's frame.
Sources of the shapes: Nicodemus 1977 (cap), Ramamoorthi & Hanrahan 2001 (spherical harmonics).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from montecarlo_brdf.scene.harmonics import harmonics
from montecarlo_brdf.scene.shapes import (
    Cap,
    Constant,
    Cosine,
    Harmonics,
    Image,
    Linear,
    Quadratic,
)
from montecarlo_brdf.scene.texels import image, image_pdf, image_sample
from montecarlo_brdf.special import cosine_power, expm1, log1p, turn
from montecarlo_brdf.vectors import NORMAL, Vec, dot, from_degrees, tangent_frame

TWO_PI = 2.0 * math.pi


def away(w: Vec, axis: Vec) -> float:
    """1 - w.u = |w - u|^2/2, with all its digits near the axis."""
    x, y, z = w[0] - axis[0], w[1] - axis[1], w[2] - axis[2]
    return 0.5 * (x * x + y * y + z * z)


def around(axis: Vec, d: float, u: float) -> Vec:
    """The direction with 1 - w.axis = d at the fraction u of a turn around the axis."""
    c, s = turn(u)
    r = math.sqrt(max(0.0, d * (2.0 - d)))
    t, b = tangent_frame(axis)
    return (
        axis[0] - d * axis[0] + r * (c * t[0] + s * b[0]),
        axis[1] - d * axis[1] + r * (c * t[1] + s * b[1]),
        axis[2] - d * axis[2] + r * (c * t[2] + s * b[2]),
    )


def constant(w: Vec, p: Constant) -> float:
    """1."""
    return 1.0


def linear(w: Vec, p: Linear) -> float:
    """a + b (w.u)."""
    return p.a + p.b * dot(w, p.axis)


def quadratic(w: Vec, p: Quadratic) -> float:
    """(w.u)^2."""
    c = dot(w, p.axis)
    return c * c


def cosine(w: Vec, p: Cosine) -> float:
    """max(0, w.u)^exponent."""
    return cosine_power(away(w, p.axis), p.exponent)


def cosine_sample(u1: float, u2: float, p: Cosine) -> Vec:
    """cos = (1 - u1)^(1/(exponent+1)) from the axis."""
    return around(p.axis, -expm1(log1p(-u1) / (p.exponent + 1.0)), u2)


def cosine_pdf(w: Vec, p: Cosine) -> float:
    """(exponent+1)/(2 pi) (w.u)^exponent."""
    return (p.exponent + 1.0) / TWO_PI * cosine_power(away(w, p.axis), p.exponent)


def cap(w: Vec, p: Cap) -> float:
    """1 within the cap."""
    return 1.0 if away(w, p.axis) <= p.depth else 0.0


def cap_sample(u1: float, u2: float, p: Cap) -> Vec:
    """Uniform in the cap's solid angle."""
    return around(p.axis, u1 * p.depth, u2)


def cap_pdf(w: Vec, p: Cap) -> float:
    """1/(solid angle) within the cap."""
    return 1.0 / (TWO_PI * p.depth) if away(w, p.axis) <= p.depth else 0.0


def spherical_harmonics(w: Vec, p: Harmonics) -> float:
    """Sum of L_lm Y_lm."""
    return harmonics(w, p.coefficients)


class Functions(NamedTuple):
    """What a kernel needs of a sky; without a sampler its directions are cosine-weighted."""

    radiance: Callable[..., float]
    sample: Callable[..., Vec] | None = None
    pdf: Callable[..., float] | None = None


FUNCTIONS: dict[type, Functions] = {
    Constant: Functions(constant),
    Linear: Functions(linear),
    Quadratic: Functions(quadratic),
    Cosine: Functions(cosine, cosine_sample, cosine_pdf),
    Cap: Functions(cap, cap_sample, cap_pdf),
    Harmonics: Functions(spherical_harmonics),
    Image: Functions(image, image_sample, image_pdf),
}


class Sky(NamedTuple):
    """A shape and a scale per channel; `keep` holds what the shapes point to in memory."""

    shapes: tuple[Any, ...]
    scales: tuple[float, ...]
    keep: Any = None

    @property
    def functions(self) -> Functions:
        """The shape's functions."""
        return FUNCTIONS[type(self.shapes[0])]

    @property
    def black(self) -> bool:
        """Whether no light comes from it, in any channel."""
        return not any(self.scales)


def below_horizon(shape: Any) -> bool:
    """A cap that lies wholly below the horizon: no direction of it lights the surface."""
    if not isinstance(shape, Cap):
        return False
    angle = 2.0 * math.asin(math.sqrt(min(1.0, 0.5 * shape.depth)))
    tilt = math.atan2(math.hypot(shape.axis[0], shape.axis[1]), shape.axis[2])
    return tilt >= 0.5 * math.pi + angle


def lowest(shape: Any, last: int = 180) -> float:
    """The smallest radiance of a shape down to a polar angle; of harmonics, on a grid."""
    if isinstance(shape, Linear):
        return shape.a - abs(shape.b)
    if not isinstance(shape, Harmonics):
        return 0.0
    angles = ((t, p) for t in range(0, last + 1, 3) for p in range(0, 360, 6))
    return min(spherical_harmonics(from_degrees(t, p), shape) for t, p in angles)


def visible_share(shape: Any) -> float:
    """The fraction of the hemisphere's solid angle in which a shape is sampled, at most."""
    return min(1.0, shape.depth) if isinstance(shape, Cap) else 1.0


def axis_of(shape: Any) -> Vec:
    """The shape's axis; the normal if it has none."""
    return getattr(shape, "axis", NORMAL)


def identity(shape: Any) -> str:
    """What a stream is named after: equal for equal skies in any process."""
    return repr(shape[2:]) if isinstance(shape, Image) else repr(shape)


def concentrated(shape: Any) -> bool:
    """Whether it shines from so little of the hemisphere that its own sampler is worth while."""
    return isinstance(shape, (Cap, Cosine, Image))


def symmetric(shape: Any) -> bool:
    """Whether turning the surface about its normal changes nothing."""
    if isinstance(shape, (Harmonics, Image)):
        return False
    axis = axis_of(shape)
    return axis[0] == 0.0 and axis[1] == 0.0
