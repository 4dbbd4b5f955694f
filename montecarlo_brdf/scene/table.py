"""A table of a scene file: beside numbers and words it holds colours and directions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Self

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.colour import Band, Colour, interpolated, pairs
from montecarlo_brdf.toml import REQUIRED, Table
from montecarlo_brdf.vectors import Vec, from_degrees


class SceneTable(Table):
    """A table, and the wavelengths at which the scene's spectra are taken."""

    band: Band | None = None

    def below(self, data: Mapping[str, Any], *keys: str | int) -> Self:
        """A table under this one, with the same wavelengths."""
        table = super().below(data, *keys)
        table.band = self.band
        return table

    def direction(self, key: str, default: object = REQUIRED) -> Vec:
        """A unit vector from [x, y, z], or from {tilt_deg, azimuth_deg}."""
        if isinstance(self.take(key, default), dict):
            table = self.table(key)
            tilt = table.number("tilt_deg", 0.0, 0.0, 180.0)
            azimuth = table.number("azimuth_deg", 0.0)
            table.done()
            return from_degrees(tilt, azimuth)
        x, y, z = self.numbers(key, 3, default)
        size = math.hypot(x, y, z)
        if size == 0.0:
            raise self.error(f"{key} has no direction: all three numbers are 0", key)
        return x / size, y / size, z / size

    def colour(self, key: str, default: object = REQUIRED, low: float = 0.0) -> Colour:
        """A number, one per channel, or (wavelength, value) pairs at the scene's wavelengths."""
        value = self.take(key, default)
        if isinstance(value, list) and value and isinstance(value[0], list):
            row = self._spectrum(key, value)
        elif isinstance(value, list):
            row = self.numbers(key)
        else:
            row = (self.number(key, default),)
        if min(row) < low:
            raise self.error(f"{key} must be at least {low:g}, not {min(row):g}", key)
        return row

    def _spectrum(self, key: str, value: list[object]) -> Colour:
        if self.band is None:
            raise self.error(f"{key} is a spectrum: the scene needs [spectrum] wavelengths", key)
        try:
            return interpolated(pairs(value), self.band.wavelengths)
        except UserError as error:
            raise self.error(f"{key}: {error}", key) from None
