"""OpenEXR images, through OpenEXR's own bindings: an extra."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.image_size import check_size


def read_exr(path: Path) -> Any:
    """Linear values (height, width) or (height, width, channels)."""
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
