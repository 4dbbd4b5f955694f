"""An image as a sky: its texels, and the tables by which directions are drawn from it."""

from __future__ import annotations

import hashlib
from typing import Any

from montecarlo_brdf.scene.image import Texels
from montecarlo_brdf.scene.skies import Image


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
