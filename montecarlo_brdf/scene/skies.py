"""Skies: radiance L(w) in W/(m^2 sr) from every direction w, each with a way to draw directions.

Every sky has a shape of unit size, multiplied by one scale per channel; the shape's numbers travel
as a NamedTuple through the kernel beside the model's. Axes are unit vectors in the surface's frame.
Sources of the shapes: Nicodemus 1977 (cap); Ramamoorthi & Hanrahan 2001, "An efficient
representation for irradiance environment maps", eq. 3, and Sloan 2008, "Stupid spherical harmonics
tricks", appendix A2 (spherical harmonics).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from montecarlo_brdf.scene.colour import spread
from montecarlo_brdf.scene.texels import Image as Image
from montecarlo_brdf.scene.texels import image, image_pdf, image_sample
from montecarlo_brdf.special import cosine_power, expm1, log1p, turn
from montecarlo_brdf.vectors import NORMAL, Vec, dot, from_degrees, tangent_frame

PI = math.pi
TWO_PI = 2.0 * math.pi
K1 = math.sqrt(3.0 / (4.0 * PI))
K2 = 0.5 * math.sqrt(15.0 / PI)
K3A, K3B, K3C = math.sqrt(35.0 / (2.0 * PI)), math.sqrt(105.0 / PI), math.sqrt(21.0 / (2.0 * PI))
K4A, K4B = math.sqrt(35.0 / PI), math.sqrt(5.0 / (2.0 * PI))


class Constant(NamedTuple):
    """L = 1."""

    one: float = 1.0


def constant(w: Vec, p: Constant) -> float:
    """1."""
    return 1.0


class Linear(NamedTuple):
    """L = a + b (w.u): a + b cos(theta), and every gradient between two poles."""

    a: float = 1.0
    b: float = 0.0
    axis: Vec = NORMAL


def linear(w: Vec, p: Linear) -> float:
    """a + b (w.u)."""
    return p.a + p.b * dot(w, p.axis)


class Quadratic(NamedTuple):
    """L = (w.u)^2."""

    axis: Vec = NORMAL


def quadratic(w: Vec, p: Quadratic) -> float:
    """(w.u)^2."""
    c = dot(w, p.axis)
    return c * c


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


class Cosine(NamedTuple):
    """L = max(0, w.u)^exponent."""

    exponent: float = 1.0
    axis: Vec = NORMAL


def cosine(w: Vec, p: Cosine) -> float:
    """max(0, w.u)^exponent."""
    return cosine_power(away(w, p.axis), p.exponent)


def cosine_sample(u1: float, u2: float, p: Cosine) -> Vec:
    """cos = (1 - u1)^(1/(exponent+1)) from the axis."""
    return around(p.axis, -expm1(log1p(-u1) / (p.exponent + 1.0)), u2)


def cosine_pdf(w: Vec, p: Cosine) -> float:
    """(exponent+1)/(2 pi) (w.u)^exponent."""
    return (p.exponent + 1.0) / TWO_PI * cosine_power(away(w, p.axis), p.exponent)


class Cap(NamedTuple):
    """L = 1 within an angle of the axis; depth = 1 - cos(angle)."""

    depth: float = 2.0
    axis: Vec = NORMAL


def cap_of(half_angle_deg: float, axis: Vec) -> Cap:
    """A cap by its half angle: depth = 2 sin^2(angle/2)."""
    return Cap(2.0 * math.sin(math.radians(half_angle_deg) / 2.0) ** 2, axis)


def cap(w: Vec, p: Cap) -> float:
    """1 within the cap."""
    return 1.0 if away(w, p.axis) <= p.depth else 0.0


def cap_sample(u1: float, u2: float, p: Cap) -> Vec:
    """Uniform in the cap's solid angle."""
    return around(p.axis, u1 * p.depth, u2)


def cap_pdf(w: Vec, p: Cap) -> float:
    """1/(solid angle) within the cap."""
    return 1.0 / (TWO_PI * p.depth) if away(w, p.axis) <= p.depth else 0.0


class Harmonics(NamedTuple):
    """L = sum of L_lm Y_lm, bands 0 to 4, 25 coefficients in the order l^2 + l + m."""

    coefficients: tuple[float, ...] = (0.0,) * 25


def harmonics(w: Vec, p: Harmonics) -> float:
    """Sum of L_lm Y_lm(w): real, orthonormal over the sphere, without the Condon-Shortley phase."""
    c = p.coefficients
    x, y, z = w[0], w[1], w[2]
    xx, yy, zz = x * x, y * y, z * z
    low = 0.5 / math.sqrt(PI) * c[0] + K1 * (c[1] * y + c[2] * z + c[3] * x)
    two = c[4] * x * y + c[5] * y * z + c[7] * x * z + 0.5 * c[8] * (xx - yy)
    two = K2 * (two + c[6] * math.sqrt(1.0 / 48.0) * (3.0 * zz - 1.0) * 2.0)
    three = 0.25 * K3A * (c[9] * y * (3.0 * xx - yy) + c[15] * x * (xx - 3.0 * yy))
    three += K3B * (0.5 * c[10] * x * y * z + 0.25 * c[14] * z * (xx - yy))
    three += 0.25 * K3C * (5.0 * zz - 1.0) * (c[11] * y + c[13] * x)
    three += 0.25 * math.sqrt(7.0 / PI) * c[12] * z * (5.0 * zz - 3.0)
    four = 0.75 * K4A * c[16] * x * y * (xx - yy)
    four += 0.75 * K3A * z * (c[17] * y * (3.0 * xx - yy) + c[23] * x * (xx - 3.0 * yy))
    four += 0.75 * K4B * (7.0 * zz - 3.0) * z * (c[19] * y + c[21] * x)
    five = 0.75 * c[18] * x * y + 0.375 * c[22] * (xx - yy)
    four += math.sqrt(5.0 / PI) * (7.0 * zz - 1.0) * five
    four += 0.1875 / math.sqrt(PI) * c[20] * ((35.0 * zz - 30.0) * zz + 3.0)
    four += 0.1875 * K4A * c[24] * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy))
    return low + two + three + four


class Functions(NamedTuple):
    """What a kernel needs of a sky; without a sampler its directions are cosine-weighted."""

    radiance: Callable[..., float]
    sample: Callable[..., Vec] | None = None
    pdf: Callable[..., float] | None = None


Shape = Constant | Linear | Quadratic | Cosine | Cap | Harmonics | Image
FUNCTIONS: dict[type, Functions] = {
    Constant: Functions(constant),
    Linear: Functions(linear),
    Quadratic: Functions(quadratic),
    Cosine: Functions(cosine, cosine_sample, cosine_pdf),
    Cap: Functions(cap, cap_sample, cap_pdf),
    Harmonics: Functions(harmonics),
    Image: Functions(image, image_sample, image_pdf),
}


class Sky(NamedTuple):
    """A shape and a scale per channel, or one for all; `keep` is what shapes point to in memory."""

    shapes: tuple[Shape, ...]
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

    @property
    def channels(self) -> int:
        """How many channels it has itself."""
        return max(len(self.shapes), len(self.scales))

    def spread(self, count: int) -> Sky:
        """The sky in `count` channels."""
        return self._replace(shapes=spread(self.shapes, count), scales=spread(self.scales, count))


def below_horizon(shape: Shape) -> bool:
    """A cap that lies wholly below the horizon: no direction of it lights the surface."""
    if not isinstance(shape, Cap):
        return False
    angle = 2.0 * math.asin(math.sqrt(min(1.0, 0.5 * shape.depth)))
    tilt = math.atan2(math.hypot(shape.axis[0], shape.axis[1]), shape.axis[2])
    return tilt >= 0.5 * math.pi + angle


def lowest(shape: Shape, last: int = 180) -> float:
    """The smallest radiance of a shape down to a polar angle; of harmonics, on a grid."""
    if isinstance(shape, Linear):
        return shape.a - abs(shape.b)
    if not isinstance(shape, Harmonics):
        return 0.0
    angles = ((t, p) for t in range(0, last + 1, 3) for p in range(0, 360, 6))
    return min(harmonics(from_degrees(t, p), shape) for t, p in angles)


def visible_share(shape: Shape) -> float:
    """The fraction of the hemisphere's solid angle in which a shape is sampled, at most."""
    return min(1.0, shape.depth) if isinstance(shape, Cap) else 1.0


def axis_of(shape: Shape) -> Vec:
    """The shape's axis; the normal if it has none."""
    return getattr(shape, "axis", NORMAL)


def identity(shape: Shape) -> str:
    """What a stream is named after: equal for equal skies in any process."""
    return repr(shape[2:]) if isinstance(shape, Image) else repr(shape)


def concentrated(shape: Shape) -> bool:
    """Whether it shines from so little of the hemisphere that its own sampler is worth while."""
    return isinstance(shape, (Cap, Cosine, Image))


def symmetric(shape: Shape) -> bool:
    """Whether turning the surface about its normal changes nothing."""
    if isinstance(shape, (Harmonics, Image)):
        return False
    axis = axis_of(shape)
    return axis[0] == 0.0 and axis[1] == 0.0
