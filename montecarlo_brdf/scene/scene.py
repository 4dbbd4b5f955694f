"""A scene: what the file says, as data with one entry per channel."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

from montecarlo_brdf.scene.lights import Light
from montecarlo_brdf.scene.skies import Constant, Sky
from montecarlo_brdf.scene.spectrum import Pairs
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.surface import Surface
from montecarlo_brdf.vectors import NORMAL, Vec


class View(NamedTuple):
    """Directions of the viewer in degrees: every theta with every phi; of a sphere, one camera."""

    theta_o_deg: tuple[float, ...] = (0.0, 30.0, 60.0, 85.0)
    phi_o_deg: tuple[float, ...] = (0.0,)
    camera: Vec = NORMAL


class Band(NamedTuple):
    """The wavelengths that stand for channels, and the light they are weighted with."""

    wavelengths: tuple[float, ...]
    illuminant: Pairs


@dataclass(frozen=True)
class Scene:
    """A surface and everything that lights it; colours are tuples of `channels` numbers."""

    name: str
    channels: int
    surface: Surface | Standard
    sky: Sky | None = None
    lights: tuple[Light, ...] = ()
    ambient: tuple[float, ...] = (0.0,)
    emission: tuple[float, ...] = (0.0,)
    view: View = View()
    band: Band | None = None
    words: tuple[str, ...] = ()  # what says the same on a command line

    def under_constant_light(self, radiance: float) -> Scene:
        """The same surface in a white furnace: a constant sky and nothing else."""
        sky = Sky((Constant(),) * self.channels, (radiance,) * self.channels)
        dark = (0.0,) * self.channels
        return replace(self, sky=sky, lights=(), ambient=dark, emission=dark)
