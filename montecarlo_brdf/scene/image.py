"""Latitude-longitude image files: PNG (sRGB, made linear), Radiance HDR, OpenEXR, NumPy.

The image is a panorama: its top row is the zenith (the surface's normal), its left edge azimuth
-180 degrees, its middle azimuth 0.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.exr import read_exr
from montecarlo_brdf.scene.image_size import check_size
from montecarlo_brdf.scene.png import read_png
from montecarlo_brdf.scene.rgbe import read_hdr


class Texels(NamedTuple):
    """Radiance (height, width, channels) in doubles."""

    values: Any

    @property
    def sums(self) -> list[list[float]]:
        """Per channel, the sum of every row."""
        return [list(map(float, row)) for row in self.values.sum(axis=1).T]


def read_image(path: Path) -> Texels:
    """An image file as checked radiance."""
    import numpy as np

    if not os.path.isfile(path):
        raise UserError(f"no image file {path}")
    kind = path.suffix.lower().lstrip(".")
    if kind not in _READERS:
        raise UserError(f"image {path} must be a .png, .hdr, .exr or .npy file")
    try:
        values = np.asarray(_READERS[kind](path), dtype=np.float64)
    except (UserError, MemoryError) as error:
        raise UserError(str(error) or f"image {path} is larger than memory allows") from error
    except Exception as error:
        if type(error).__name__ == "DecompressionBombError":  # Pillow's, which need not be there
            raise UserError(f"image {path} is larger than memory allows") from error
        reason = " ".join(str(error).split()) or type(error).__name__
        raise UserError(f"image {path} is damaged or no {kind} file: {reason}") from error
    return Texels(_checked(path, values))


def _checked(path: Path, values: Any) -> Any:
    import numpy as np

    values = values[:, :, None] if values.ndim == 2 else values
    if values.ndim != 3 or 0 in values.shape:
        raise UserError(
            f"image {path} must have rows, columns and channels, not shape {values.shape}"
        )
    values = values[:, :, :1] if values.shape[2] < 3 else values[:, :, :3]  # grey, without alpha
    if not np.isfinite(values).all():
        raise UserError(f"image {path} contains NaN or infinity")
    if values.min() < 0.0:
        raise UserError(f"image {path} contains negative radiance")
    return np.ascontiguousarray(values)


def _npy(path: Path) -> Any:
    import numpy as np

    values = np.load(path, mmap_mode="r", allow_pickle=False)  # the size, before it is read
    if values.ndim in (2, 3):
        check_size(path, values.shape[1], values.shape[0])
    return np.array(values)


_READERS = {"png": read_png, "npy": _npy, "exr": read_exr, "hdr": read_hdr}
