"""Delta lights: their radiance cannot be sampled, their sums are exact.

A directional light has an irradiance E on a plane perpendicular to its beam; a point light has an
intensity I and E = I/(a + b d + c d^2), with (0, 0, 1) the physical inverse square.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.vectors import Vec


class Directional(NamedTuple):
    """Light from one direction; `irradiance` per channel, W/m^2 on a plane across the beam."""

    direction: Vec
    irradiance: tuple[float, ...]

    def at(self, point: Vec) -> tuple[Vec, float]:
        """Direction towards the light and the factor on its colour."""
        return self.direction, 1.0

    @property
    def colour(self) -> tuple[float, ...]:
        """What the factor multiplies."""
        return self.irradiance


class Point(NamedTuple):
    """Light from a point; `intensity` per channel, W/sr."""

    position: Vec
    intensity: tuple[float, ...]
    falloff: Vec = (0.0, 0.0, 1.0)

    def at(self, point: Vec) -> tuple[Vec, float]:
        """Direction towards the light and the factor on its colour: 1/(a + b d + c d^2)."""
        x, y, z = (a - b for a, b in zip(self.position, point, strict=True))
        d = math.sqrt(x * x + y * y + z * z)
        a, b, c = self.falloff
        return (x / d, y / d, z / d), 1.0 / (a + b * d + c * d * d)

    @property
    def colour(self) -> tuple[float, ...]:
        """What the factor multiplies."""
        return self.intensity


Light = Directional | Point
ORIGIN: Vec = (0.0, 0.0, 0.0)


def is_black(light: Light) -> bool:
    """No light in any channel."""
    return not any(light.colour)
