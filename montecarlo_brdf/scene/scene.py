"""A scene: what the file says, as data with one entry per channel.

Delta lights cannot be sampled, their sums are exact. A directional light has an irradiance E on a
plane perpendicular to its beam; a point light has an intensity I and E = I/(a + b d + c d^2), with
(0, 0, 1) the physical inverse square.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.scene.colour import Band, Colour
from montecarlo_brdf.scene.expected import Expected
from montecarlo_brdf.scene.skies import Constant, Sky
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.vectors import NORMAL, Vec

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

ORIGIN: Vec = (0.0, 0.0, 0.0)


class Directional(NamedTuple):
    """Light from one direction; `colour` is its irradiance, W/m^2 on a plane across the beam."""

    direction: Vec
    colour: Colour

    def at(self, point: Vec) -> tuple[Vec, float]:
        """Direction towards the light and the factor on its colour."""
        return self.direction, 1.0

    def over(self, points: NDArray[float64]) -> tuple[NDArray[float64], NDArray[float64]]:
        """The same for points (n, 3): directions (n, 3) and factors (n)."""
        import numpy as np

        return np.tile(np.array(self.direction), (len(points), 1)), np.ones(len(points))


class Point(NamedTuple):
    """Light from a point; `colour` is its intensity, W/sr."""

    position: Vec
    colour: Colour
    falloff: Vec = (0.0, 0.0, 1.0)

    def at(self, point: Vec) -> tuple[Vec, float]:
        """Direction towards the light and the factor on its colour: 1/(a + b d + c d^2)."""
        x, y, z = (a - b for a, b in zip(self.position, point, strict=True))
        d = math.sqrt(x * x + y * y + z * z)
        a, b, c = self.falloff
        return (x / d, y / d, z / d), 1.0 / (a + b * d + c * d * d)

    def over(self, points: NDArray[float64]) -> tuple[NDArray[float64], NDArray[float64]]:
        """The same for points (n, 3): directions (n, 3) and factors (n)."""
        import numpy as np

        to = np.array(self.position) - points
        d = np.linalg.norm(to, axis=1)
        a, b, c = self.falloff
        return to / d[:, None], 1.0 / (a + b * d + c * d * d)


Light = Directional | Point


class View(NamedTuple):
    """Directions of the viewer in degrees: every theta with every phi; of a sphere, one camera."""

    theta_o_deg: tuple[float, ...] = (0.0, 30.0, 60.0, 85.0)
    phi_o_deg: tuple[float, ...] = (0.0,)
    camera: Vec = NORMAL


@dataclass(frozen=True)
class Scene:
    """A surface and everything that lights it; colours are tuples of `channels` numbers."""

    name: str
    channels: int
    surface: Surface | Standard
    sky: Sky | None = None
    lights: tuple[Light, ...] = ()
    ambient: Colour = (0.0,)
    emission: Colour = (0.0,)
    view: View = View()
    band: Band | None = None
    expected: Expected | None = None  # what L_o must be, where the author says so
    words: tuple[str, ...] = ()  # what says the same on a command line

    @property
    def lobes(self) -> tuple[Lobe, ...]:
        """The surface's lobes; the standard lighting equation has them after `as_lobes`."""
        return self.surface.lobes if isinstance(self.surface, Surface) else ()

    def under_constant_light(self, radiance: float) -> Scene:
        """The same surface in a white furnace: a constant sky and nothing else."""
        sky = Sky((Constant(),) * self.channels, (radiance,) * self.channels)
        dark = (0.0,) * self.channels
        return replace(self, sky=sky, lights=(), ambient=dark, emission=dark)


def as_lobes(scene: Scene) -> Scene:
    """The standard lighting equation as a surface of lobes; other scenes as they are."""
    if not isinstance(scene.surface, Standard):
        return scene
    ambient = zip(scene.emission, scene.ambient, scene.surface.ambient_colour, strict=True)
    glow = tuple(e + a * k for e, a, k in ambient)
    dark = (0.0,) * scene.channels
    return replace(scene, surface=scene.surface.as_surface(), emission=glow, ambient=dark)
