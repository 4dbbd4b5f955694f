"""Latitude-longitude image files: PNG (sRGB, made linear), Radiance HDR, OpenEXR, NumPy.

The image is a panorama: its top row is the zenith (the surface's normal), its left edge azimuth
-180 degrees, its middle azimuth 0.
Sources: IEC 61966-2-1 (sRGB); the PNG specification, 3rd edition; Ward 1991, "Real pixels",
Graphics Gems II, and the Radiance file formats reference (HDR).
"""

from __future__ import annotations

import math
import os
import struct
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.files import know_input

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray
    from PIL.Image import Image as Picture

    Radiance = NDArray[float64]  # (height, width) or (height, width, channels)

MOST_TEXELS = 1 << 26  # 8192 x 8192: 1.6 GB of doubles in RGB
RGB, RGBA = 2, 6  # colour types of PNG
#: of Pillow's zip decoder: the lower byte, where by itself it keeps the upper one alone
LOWER = {RGB: "RGB;16L", RGBA: "RGBA;16L"}


def read_image(path: Path) -> Radiance:
    """An image file as checked radiance, (height, width, 1 or 3) doubles.

    Raises UserError for what is no image, too large, negative or not finite.
    """
    import numpy as np

    if not os.path.isfile(path):
        raise UserError(f"no image file {path}")
    know_input(path)
    kind = path.suffix.lower().lstrip(".")
    if kind not in READERS:
        raise UserError(f"image {path} must be a .png, .hdr, .exr or .npy file")
    try:
        values = np.asarray(READERS[kind](path), dtype=np.float64)
    except (UserError, MemoryError) as error:
        raise UserError(str(error) or f"image {path} is larger than memory allows") from error
    except Exception as error:  # of libraries that decode: theirs are of every type
        reason = " ".join(str(error).split()) or type(error).__name__
        raise UserError(f"image {path} is damaged or no {kind} file: {reason}") from error
    return _checked(path, values)


def _checked(path: Path, values: Radiance) -> Radiance:
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
    known = hasattr(os, "sysconf")
    available = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") if known else 1 << 33
    need = width * height * 3 * 8 * 3  # doubles, their tables, one copy
    if width * height > MOST_TEXELS or need > available // 2:
        raise UserError(
            f"image {path} is too large: {width} x {height} texels need {need / 1e9:.3g} GB"
        )


def read_npy(path: Path) -> Radiance:
    """The array as it is."""
    import numpy as np

    values = np.load(path, mmap_mode="r", allow_pickle=False)  # the size, before it is read
    if values.ndim in (2, 3):
        check_size(path, values.shape[1], values.shape[0])
    return np.array(values)


def read_exr(path: Path) -> Radiance:
    """Linear values, through OpenEXR's own bindings: an extra."""
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


def read_png(path: Path) -> Radiance:
    """Linear values in [0, 1] from 8 or 16 bits of sRGB per channel."""
    import numpy as np
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of Pillow's, on large images: checked here
            with Image.open(path, formats=["PNG"]) as picture:
                check_size(path, *picture.size)
                s = _samples(path, picture) / 255.0
    except Image.DecompressionBombError as error:
        raise UserError(f"image {path} is larger than memory allows") from error
    return np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4)


def _samples(path: Path, picture: Picture) -> Radiance:
    """All bits of an open picture, from 0 to 255."""
    import numpy as np
    from PIL import Image

    if picture.mode in ("L", "I;16", "I"):
        return np.asarray(picture, dtype=np.float64) / (1.0 if picture.mode == "L" else 257.0)
    upper = np.asarray(picture.convert("RGB"), dtype=np.float64)
    content = path.read_bytes()
    bits, kind, interlaced = content[24], content[25], content[28]
    if bits != 16 or kind not in LOWER:
        return upper
    rest = Image.frombytes(
        picture.mode, picture.size, _compressed(content), "zip", LOWER[kind], interlaced
    )
    return (256.0 * upper + np.asarray(rest.convert("RGB"), dtype=np.float64)) / 257.0


def _compressed(content: bytes) -> bytes:
    """The pixels of a PNG file, from all its IDAT chunks: length, name, data, checksum."""
    at, found = 8, bytearray()
    while at + 12 <= len(content):
        length, name = struct.unpack_from(">I4s", content, at)
        found += content[at + 8 : at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    return bytes(found)


def read_hdr(path: Path) -> Radiance:
    """Linear RGB from shared exponents, flat or run-length encoded by scanline."""
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
    """All pixels, four bytes each; their lines begin at `at`."""
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


READERS = {"png": read_png, "npy": read_npy, "exr": read_exr, "hdr": read_hdr}
