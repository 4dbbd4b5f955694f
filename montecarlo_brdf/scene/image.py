"""Latitude-longitude images as skies: PNG (sRGB, made linear), Radiance HDR, OpenEXR, NumPy.

The image is a panorama: its top row is the zenith (the surface's normal), its left edge azimuth
-180 degrees, its middle azimuth 0.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.skies import Image

MOST_TEXELS = 1 << 26  # 8192 x 8192: 1.6 GB of doubles in RGB


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


def check_size(path: Path, width: int, height: int) -> None:
    """Refuse what would not fit before it is read."""
    available = (
        os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        if hasattr(os, "sysconf")
        else 1 << 33
    )
    need = width * height * 3 * 8 * 3  # doubles, their tables, one copy
    if width * height > MOST_TEXELS or need > available // 2:
        raise UserError(
            f"image {path} is too large: {width} x {height} texels need {need / 1e9:.3g} GB"
        )


def _png(path: Path) -> Any:
    from montecarlo_brdf.scene.png import read_png

    return read_png(path)


def _npy(path: Path) -> Any:
    import numpy as np

    values = np.load(path, mmap_mode="r", allow_pickle=False)  # the size, before it is read
    if values.ndim in (2, 3):
        check_size(path, values.shape[1], values.shape[0])
    return np.array(values)


def _exr(path: Path) -> Any:
    """Through OpenEXR's own bindings, an extra."""
    import numpy as np

    try:
        import OpenEXR
    except ImportError as error:
        raise UserError(
            "reading .exr images needs OpenEXR: pip install 'montecarlo-brdf[scene]'"
        ) from error
    with OpenEXR.File(str(path), header_only=True) as file:
        low, high = file.header()["dataWindow"]
        check_size(path, int(high[0] - low[0]) + 1, int(high[1] - low[1]) + 1)
    with OpenEXR.File(str(path)) as file:
        found = file.channels()
        name = next((n for n in ("RGB", "RGBA", "Y") if n in found), None)
        if name is None:
            raise UserError(f"image {path} has channels {', '.join(found)}, not RGB")
        return np.array(found[name].pixels)


def _hdr(path: Path) -> Any:
    from montecarlo_brdf.scene.rgbe import read_hdr

    return read_hdr(path)


_READERS = {"png": _png, "npy": _npy, "exr": _exr, "hdr": _hdr}


def texel_sky(texels: Texels) -> tuple[tuple[Image, ...], Any]:
    """One shape per channel, and the arrays that must stay alive while they are used."""
    import numpy as np

    height, width, count = texels.values.shape
    shapes, keep = [], []
    for channel in range(count):
        plane = np.ascontiguousarray(texels.values[:, :, channel])
        table = cumulated(plane)
        keep += [plane, table]
        addresses = (float(plane.ctypes.data), float(table.ctypes.data))
        digest = hashlib.blake2b(plane.tobytes(), digest_size=6).digest()
        content = float(int.from_bytes(digest, "little"))
        shapes.append(Image(*addresses, float(width), float(height), content))
    return tuple(shapes), keep


def cumulated(plane: Any, below: bool = False) -> Any:
    """Shares of radiance times solid angle, summed up; `below`: also under the horizon."""
    import numpy as np

    height = len(plane)
    edges = np.cos(np.linspace(0.0, np.pi, height + 1))
    share = np.maximum(edges[:-1] - edges[1:], 0.0)[:, None]
    if not below:  # no light from there
        share[np.arange(height) * np.pi / height >= np.pi / 2] = 0.0
    table = np.cumsum((plane * share).ravel())
    return table / table[-1] if table[-1] > 0.0 else np.linspace(0.0, 1.0, len(table))
