"""Images as skies: every format decoded from bytes that were encoded here, by other code."""

import math
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import estimates, written

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.scene.images import read_image

RANDOM = np.random.default_rng(4)


def _rgbe(values: np.ndarray) -> np.ndarray:
    """Shared exponents: mantissas are rounded down, so that + 1/2 is their middle."""
    brightest = values.max(axis=2)
    exponent = np.where(brightest > 0.0, np.frexp(brightest)[1], -128)
    mantissas = np.floor(np.ldexp(values, (8 - exponent)[..., None])).astype(np.uint8)
    return np.concatenate([mantissas, (exponent + 128).astype(np.uint8)[..., None]], axis=2)


def _runs(plane: bytes) -> bytes:
    """Runs of three or more as (128 + count, value), the rest as (count, values)."""
    out, k, rest = b"", 0, b""
    while k < len(plane):
        n = 1
        while k + n < len(plane) and plane[k + n] == plane[k] and n < 127:
            n += 1
        if n >= 3 or len(rest) == 128:
            out, rest = out + (bytes([len(rest)]) + rest if rest else b""), b""
        if n >= 3:
            out, k = out + bytes([128 + n, plane[k]]), k + n
        else:
            rest, k = rest + plane[k : k + 1], k + 1
    return out + (bytes([len(rest)]) + rest if rest else b"")


def _hdr(values: np.ndarray, encoded: bool, header: bytes = b"FORMAT=32-bit_rle_rgbe\n") -> bytes:
    height, width, _ = values.shape
    rgbe, body = _rgbe(values), b""
    for row in rgbe:
        if encoded:
            body += bytes([2, 2, width >> 8, width & 255])
            body += b"".join(_runs(row[:, k].tobytes()) for k in range(4))
        else:
            body += row.tobytes()
    return b"#?RADIANCE\n" + header + f"\n-Y {height} +X {width}\n".encode() + body


def _panorama() -> np.ndarray:
    """Smooth areas, a black one, and a sun: runs and single values."""
    values = np.ones((16, 300, 3)) * np.linspace(0.5, 3.0, 16)[:, None, None]
    values[:, 100:180] *= RANDOM.random((16, 80, 1)) + 0.1
    values[12:] = 0.0
    values[3, 40] = (9000.0, 8000.0, 5000.0)
    return values


@pytest.mark.parametrize("encoded", [False, True], ids=["flat", "run-length encoded"])
def test_hdr(encoded: bool, tmp_path: Path) -> None:
    """Every value within half a step of its shared exponent."""
    values = _panorama()
    content = _hdr(values, encoded)
    assert (len(content) < 4 * 16 * 300) == encoded
    (tmp_path / "sky.hdr").write_bytes(content)
    found = read_image(tmp_path / "sky.hdr")
    step = values.max(axis=2, keepdims=True) / 128.0
    assert found.shape == values.shape
    assert (np.abs(found - values) <= 0.5 * step).all()
    assert (found[12:] == 0.0).all()


def test_hdr_header(tmp_path: Path) -> None:
    """Exposures are undone, all of them; another colour space is refused."""
    path, values = tmp_path / "sky.hdr", np.ones((2, 8, 3))
    path.write_bytes(_hdr(values, True, b"EXPOSURE=2\nSOFTWARE=x\nEXPOSURE= 4\n"))
    assert read_image(path) == pytest.approx(values / 8.0, rel=5e-3)
    path.write_bytes(_hdr(values, True, b"FORMAT=32-bit_rle_xyze\n"))
    with pytest.raises(UserError, match="has the format 32-bit_rle_xyze"):
        read_image(path)
    whole = _hdr(_panorama(), True)
    path.write_bytes(whole[:-7])
    with pytest.raises(UserError, match="is truncated"):
        read_image(path)
    path.write_bytes(whole.replace(bytes([2, 2, 1, 44, 228]), bytes([2, 2, 1, 44, 255]), 1))
    with pytest.raises(UserError, match="damaged"):
        read_image(path)


def _chunk(name: bytes, data: bytes) -> bytes:
    checked = name + data
    return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))


def _png(values: np.ndarray, bits: int, kind: int) -> bytes:
    """A PNG whose rows take the five filters in turn."""
    height, width = values.shape[:2]
    rows = values.astype(f">u{bits // 8}").reshape(height, -1).view("u1").astype(int)
    step = rows.shape[1] // width
    above, body = np.zeros(rows.shape[1], int), b""
    for k, row in enumerate(rows):
        left, corner = (np.concatenate([np.zeros(step, int), r[:-step]]) for r in (row, above))
        far = [np.abs(above - corner), np.abs(left - corner), np.abs(left + above - 2 * corner)]
        paeth = np.choose(np.argmin(far, axis=0), [left, above, corner])
        guess = (0, left, above, (left + above) // 2, paeth)[k % 5]
        body += bytes([k % 5]) + ((row - guess) % 256).astype(np.uint8).tobytes()
        above = row
    head = struct.pack(">IIBBBBB", width, height, bits, kind, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(body)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*p) for p in parts)


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize(
    ("kind", "channels"), [(0, 1), (2, 3), (6, 4)], ids=["grey", "RGB", "RGBA"]
)
def test_png(bits: int, kind: int, channels: int, tmp_path: Path) -> None:
    """All bits count, sRGB is made linear, alpha is dropped."""
    most = 2**bits - 1
    values = RANDOM.integers(0, most + 1, (12, 9, channels))
    values[0, 0] = most
    (tmp_path / "sky.png").write_bytes(_png(values, bits, kind))
    found = read_image(tmp_path / "sky.png")
    shown = values[:, :, : min(channels, 3)] / most
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    assert found == pytest.approx(linear, rel=1e-12, abs=1e-300)


def _deep_png(path: Path) -> np.ndarray:
    """A file with 16 bits of RGB, and its values."""
    values = RANDOM.integers(0, 1 << 16, (12, 9, 3))
    path.write_bytes(_png(values, 16, 2))
    return values


class Documented:
    """A picture of which nothing but what Pillow documents can be seen, and nothing changed."""

    SEEN = ("__array_interface__", "convert", "height", "info", "mode", "size", "width")

    def __init__(self, picture: Any) -> None:
        object.__setattr__(self, "_picture", picture)

    def __enter__(self) -> "Documented":
        self._picture.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        self._picture.__exit__(*error)

    def __getattr__(self, name: str) -> Any:
        if name not in self.SEEN:
            raise AttributeError(name)
        return getattr(self._picture, name)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(name)


def test_png_leaves_pillow_as_it_is(tmp_path: Path, monkeypatch: Any) -> None:
    from PIL import Image

    values, opened = _deep_png(tmp_path / "sky.png"), Image.open
    monkeypatch.setattr(Image, "open", lambda *a, **more: Documented(opened(*a, **more)))
    s = values / 65535
    linear = np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4)
    assert read_image(tmp_path / "sky.png") == pytest.approx(linear, rel=1e-12, abs=1e-300)


def test_png_in_several_parts(tmp_path: Path) -> None:
    """Pixels may stand in any number of chunks, and anything after the end."""
    path = tmp_path / "sky.png"
    _deep_png(path)
    whole = read_image(path)
    content = path.read_bytes()
    at = content.index(b"IDAT")
    length = int.from_bytes(content[at - 4 : at], "big")
    data, rest = content[at + 4 : at + 4 + length], content[at + 8 + length :]
    chunks = b"".join(_chunk(b"IDAT", part) for part in (data[:50], b"", data[50:]))
    path.write_bytes(content[: at - 4] + chunks + rest + b"more")
    assert np.array_equal(read_image(path), whole)


def test_png_interlaced(tmp_path: Path) -> None:
    """Adam7: seven pictures of every second, fourth or eighth pixel, none of them filtered."""
    path = tmp_path / "sky.png"
    values = _deep_png(path)
    whole, body = read_image(path), b""
    starts = ((0, 0, 8, 8), (0, 4, 8, 8), (4, 0, 8, 4), (0, 2, 4, 4), (2, 0, 4, 2), (0, 1, 2, 2))
    for y, x, down, across in (*starts, (1, 0, 2, 1)):
        for row in values[y::down, x::across].astype(">u2"):
            body += b"\0" + row.tobytes()
    head = struct.pack(">IIBBBBB", 9, 12, 16, 2, 0, 0, 1)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(body)), (b"IEND", b""))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*p) for p in parts))
    assert np.array_equal(read_image(path), whole)


def test_exr(tmp_path: Path) -> None:
    exr = pytest.importorskip("OpenEXR")
    values = _panorama().astype(np.float32)
    for channels in ({"RGB": values}, {"Y": values[:, :, 0].copy()}):
        header: dict[str, Any] = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
        exr.File(header, channels).write(str(tmp_path / "sky.exr"))
        found = read_image(tmp_path / "sky.exr")
        assert np.array_equal(found[:, :, 0], values[:, :, 0].astype(float))
        assert found.shape[2] == (3 if "RGB" in channels else 1)


def test_a_panorama_lights_a_surface(tmp_path: Path) -> None:
    """L_o = E/pi of the texels above the horizon, with a sun in one of them."""
    values = _panorama()
    (tmp_path / "sky.hdr").write_bytes(_hdr(values, True))
    scene = written(
        tmp_path,
        '[surface]\nmodel = "lambert"\nalbedo = 1.0\n'
        '[environment]\nkind = "image"\nfile = "sky.hdr"\n',
    )
    decoded = read_image(tmp_path / "sky.hdr")
    for c, found in enumerate(estimates(scene, 30.0, 1 << 14)):
        e = found.estimate
        sums = [float(v) for v in decoded[:, :, c].sum(axis=1)]
        exact = _irradiance.image(sums, 300) / math.pi
        assert abs(e.mean - exact) <= e.half_width(1e-8) < 0.01 * exact
