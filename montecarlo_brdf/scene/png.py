"""PNG images of 8 or 16 bits per channel as linear radiance; the values are sRGB.

Source: IEC 61966-2-1 (sRGB); the PNG specification, 3rd edition.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

from montecarlo_brdf.scene.image_size import check_size

DEEP = ("RGB;16B", "RGBA;16B")  # Pillow keeps the upper byte of these only


def read_png(path: Path) -> Any:
    """Linear values (height, width) or (height, width, channels) in [0, 1]."""
    import numpy as np

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Pillow's, on large images: checked here
        upper, raw = _pixels(path)
        if raw in DEEP:
            lower, _ = _pixels(path, raw.replace("16B", "16L"))
            upper = (256.0 * upper + lower) / 257.0
    s = upper / 255.0
    return np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4)


def _pixels(path: Path, as_raw: str | None = None) -> tuple[Any, Any]:
    """Values from 0 to 255 and how the file stores them; `as_raw` reads them another way."""
    import numpy as np
    from PIL import Image

    with Image.open(path, formats=["PNG"]) as picture:
        check_size(path, *picture.size)
        codec, box, offset, raw = picture.tile[0]  # type: ignore[attr-defined]
        if as_raw:  # little-endian reading gives the lower byte
            picture.tile = [(codec, box, offset, as_raw)]  # type: ignore[attr-defined,list-item]
        grey = picture.mode in ("L", "I;16", "I")
        data = np.asarray(picture if grey else picture.convert("RGB"), dtype=np.float64)
        return data / (257.0 if picture.mode in ("I;16", "I") else 1.0), raw
