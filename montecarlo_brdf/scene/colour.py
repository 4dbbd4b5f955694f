"""Colours, one number per channel; spectra, (wavelength, value) pairs, piecewise linear.

Wavelengths are in nanometres. Reflectance is at one wavelength; albedo over a band is whole-band:
int rho E dl / int E dl, the radiosity over the irradiance of an illuminant E. Products of two
linear pieces are integrated exactly (Simpson's rule on the union of both sets of wavelengths).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeVar

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.toml import is_number

T = TypeVar("T")
Colour = tuple[float, ...]  # one number per channel of a scene, or one for all of them
Pairs = tuple[tuple[float, float], ...]


def spread(values: tuple[T, ...], count: int) -> tuple[T, ...]:
    """One value per channel."""
    return values * count if len(values) == 1 else values


class Band(NamedTuple):
    """The wavelengths that stand for channels, and the light they are weighted with."""

    wavelengths: tuple[float, ...]
    illuminant: Pairs

    @property
    def shares(self) -> list[float]:
        """The weight of every wavelength in the band albedo: that of a spectrum that is 1 there."""
        units = (tuple((w, float(w == one)) for w in self.wavelengths) for one in self.wavelengths)
        return [band_albedo(unit, self.illuminant) for unit in units]


def pairs(value: object) -> Pairs:
    """Checked pairs: finite, wavelengths positive and increasing, values not negative.

    Raises UserError for anything else.
    """
    rows = []
    for row in value if isinstance(value, (list, tuple)) else (value,):
        if not isinstance(row, (list, tuple)) or len(row) != 2 or not all(map(is_number, row)):
            raise UserError(f"a spectrum is a list of [wavelength, value] pairs, not {row!r}")
        rows.append((float(row[0]), float(row[1])))
    wavelengths = [w for w, _ in rows]
    if min(wavelengths, default=1.0) <= 0.0:
        raise UserError(f"wavelengths are positive numbers in nm, not {min(wavelengths):g}")
    if any(b <= a for a, b in zip(wavelengths, wavelengths[1:], strict=False)):
        raise UserError("the wavelengths of a spectrum must increase")
    if min((v for _, v in rows), default=0.0) < 0.0:
        raise UserError(f"the values of a spectrum are at least 0, not {min(v for _, v in rows):g}")
    if not rows:
        raise UserError("a spectrum needs at least one pair")
    return tuple(rows)


def at(spectrum: Pairs, wavelength: float) -> float:
    """The value at a wavelength; UserError if it is not between the first and the last."""
    first, last = spectrum[0][0], spectrum[-1][0]
    if not first <= wavelength <= last:
        raise UserError(
            f"no value at {wavelength:g} nm: the spectrum runs from {first:g} to {last:g} nm"
        )
    for (a, x), (b, y) in zip(spectrum, spectrum[1:], strict=False):
        if a <= wavelength <= b:
            t = (wavelength - a) / (b - a)
            return (1.0 - t) * x + t * y
    return spectrum[0][1]


def interpolated(spectrum: Pairs, wavelengths: Sequence[float]) -> Colour:
    """Values at some wavelengths."""
    return tuple(at(spectrum, w) for w in wavelengths)


def band_albedo(reflectance: Pairs, illuminant: Pairs) -> float:
    """int rho E dl / int E dl over the wavelengths of the reflectance."""
    first, last = reflectance[0][0], reflectance[-1][0]
    inside = {w for w, _ in (*reflectance, *illuminant) if first <= w <= last}
    grid = sorted(inside | {first, last})
    if len(grid) == 1:
        return reflectance[0][1]
    upper, lower = [], []
    for a, b in zip(grid, grid[1:], strict=False):
        for w, share in ((a, 1.0), (0.5 * (a + b), 4.0), (b, 1.0)):
            light = share * (b - a) * at(illuminant, w)
            upper.append(at(reflectance, w) * light)
            lower.append(light)
    if not math.fsum(lower) > 0.0:
        raise UserError("the illuminant is black over the band")
    return math.fsum(upper) / math.fsum(lower)


def illuminant_table(name: str, first: float, last: float) -> Pairs:
    """A standard illuminant (D65, A, F2, ...) of the colour library, an extra."""
    if name == "E":
        return ((first, 1.0), (last, 1.0)) if last > first else ((first, 1.0),)
    try:
        import colour
    except ImportError as error:
        raise UserError(
            f"illuminant {name!r} needs the colour library: pip install 'montecarlo-brdf[scene]', "
            "or give [wavelength, value] pairs"
        ) from error
    if name not in colour.SDS_ILLUMINANTS:
        raise UserError(unknown("illuminant", name, sorted(colour.SDS_ILLUMINANTS)))
    table = colour.SDS_ILLUMINANTS[name]
    return tuple(zip(map(float, table.wavelengths), map(float, table.values), strict=True))
