"""OpenEXR: the first axis along the rows, the second down the columns, a channel per quantity."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table.written.finished import Finished, Number, bound, rounded

CHANNELS = "RGBA"


def check(axes: int, quantities: int) -> None:
    """Raise UserError for what is no image, or where there is no library for it."""
    if axes > 2:
        raise UserError("an .exr file has two axes, not three: take .npz, .csv or .h")
    if quantities > len(CHANNELS):
        raise UserError(f"an .exr file has {len(CHANNELS)} channels, not {quantities}")
    try:
        import OpenEXR  # noqa: F401
    except ImportError as error:
        raise UserError(
            "writing .exr needs OpenEXR: pip install 'montecarlo-brdf[scene]'"
        ) from error


def write(table: Finished, number: Number) -> bytes:
    """The file."""
    import OpenEXR

    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    header["comments"] = json.dumps({
        "model": table.title, **table.facts,
        "axes": [axis.told() for axis in table.axes],
        "channels": dict(zip(CHANNELS, table.values, strict=False)),
        "error": {name: bound(table, name, number) for name in table.values},
    })  # fmt: skip
    channels = {
        letter: np.ascontiguousarray(np.atleast_2d(rounded(values.T, number)))
        for letter, values in zip(CHANNELS, table.values.values(), strict=False)
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "table.exr"
        OpenEXR.File(header, channels).write(str(path))
        return path.read_bytes()
