"""Radiance HDR files: shared-exponent RGBE, flat or run-length encoded by scanline.

Source: Ward 1991, "Real pixels", Graphics Gems II; the Radiance file formats reference.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.image_size import check_size


def read_hdr(path: Path) -> Any:
    """Linear RGB (height, width, 3)."""
    import numpy as np

    content = path.read_bytes()
    if not content.startswith((b"#?RADIANCE", b"#?RGBE")):
        raise UserError(f"image {path} is not a Radiance HDR file")
    end = content.index(b"\n\n") + 2
    line_end = content.index(b"\n", end)
    axes = content[end:line_end].split()
    if len(axes) != 4 or axes[0] != b"-Y" or axes[2] != b"+X":
        raise UserError(f"image {path} has an orientation other than -Y +X")
    exposure = _exposure(path, content[:end])
    height, width = int(axes[1]), int(axes[3])
    check_size(path, width, height)
    rows = _scanlines(path, content, line_end + 1, height, width)
    rgbe = np.frombuffer(bytes(rows), np.uint8).reshape(height, width, 4).astype(np.float64)
    shown = (rgbe[:, :, :3] + 0.5) * np.exp2(rgbe[:, :, 3:] - 136.0) * (rgbe[:, :, 3:] > 0.0)
    return shown / exposure


def _exposure(path: Path, header: bytes) -> float:
    """What the values were multiplied with; every line of the header counts."""
    exposure = 1.0
    for line in header.decode("latin-1").splitlines():
        name, _, value = line.partition("=")
        if name.strip() == "FORMAT" and value.strip() != "32-bit_rle_rgbe":
            raise UserError(f"image {path} has the format {value.strip()}, not 32-bit_rle_rgbe")
        if name.strip() == "EXPOSURE":
            exposure *= float(value)
    if not 0.0 < exposure < math.inf:
        raise UserError(f"image {path} has the exposure {exposure:g}")
    return exposure


def _scanlines(path: Path, content: bytes, at: int, height: int, width: int) -> bytearray:
    rows = bytearray()
    for _ in range(height):
        if content[at : at + 4] == bytes([2, 2, width >> 8, width & 255]) and 8 <= width < 32768:
            row, at = _run_lengths(path, content, at + 4, width)
            rows += row
        else:
            rows += content[at : at + 4 * width]
            at += 4 * width
    if len(rows) != 4 * height * width:
        raise UserError(f"image {path} is truncated")
    return rows


def _run_lengths(path: Path, content: bytes, at: int, width: int) -> tuple[bytearray, int]:
    """One scanline, its four planes interleaved, and where the next begins."""
    row = bytearray(4 * width)
    for k in range(4):
        plane = bytearray()
        while len(plane) < width:
            if at + 1 >= len(content):
                raise UserError(f"image {path} is truncated")
            count = content[at]
            if count > 128:
                plane += content[at + 1 : at + 2] * (count - 128)
                at += 2
            else:
                plane += content[at + 1 : at + 1 + count]
                at += 1 + count
        if len(plane) != width:
            raise UserError(f"image {path} is damaged: a run goes beyond its scanline")
        row[k::4] = plane
    return row, at
