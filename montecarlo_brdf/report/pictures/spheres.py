"""Pages of spheres: sRGB in PNG, in a furnace signed differences below it, or raw numbers.

Drawn pixel by pixel with Pillow: every pixel of a sphere is a pixel of the page, which a plot's
resampling would not give. The diverging map is ColorBrewer's RdBu (Brewer 2003), blue for loss and
red for gain.
"""

from __future__ import annotations

import importlib
import io
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple, Protocol

from montecarlo_brdf.errors import OutputError, UserError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from PIL.Image import Image
    from PIL.ImageFont import FreeTypeFont

    Values = NDArray[np.float64]

KINDS = ("png", "npy", "exr")
SCALE = 0.1  # the difference panel runs from -10 % to +10 %
READABLE = 192  # pixels: smaller spheres are enlarged by whole factors
LOSS_TO_GAIN = (
    "053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7",
    "fddbc7", "f4a582", "d6604d", "b2182b", "67001f",
)  # fmt: skip
NUMBERS = ("-10% or less", "-5%", "0%", "+5%", "+10% or more")
WHITE, BLACK = (255, 255, 255), (0, 0, 0)


class Sphere(Protocol):
    """What is drawn of a rendered sphere."""

    @property
    def values(self) -> Values:
        """Linear radiance (size, size, channels), background included."""

    @property
    def inside(self) -> NDArray[np.bool_]:
        """(size, size), which pixels show the sphere."""


class Panel(NamedTuple):
    """One cell of a page: a title and pixels (size, size, 3) of 0 to 255."""

    title: str
    pixels: Values


def kind_of(path: Path) -> str:
    """ "png", "npy" or "exr"; UserError for another, OutputError if it cannot be written here."""
    kind = path.suffix.lstrip(".").lower()
    if kind not in KINDS:
        raise UserError(f"cannot draw {path}: the name must end in .png, .npy or .exr")
    if kind == "exr":
        try:
            _openexr()
        except ImportError as error:
            needs = ".exr needs OpenEXR, pip install 'montecarlo-brdf[scene]'"
            raise OutputError(f"cannot write {path}: {needs}") from error
    return kind


def drawn(
    kind: str, spheres: Sequence[Sphere], labels: Sequence[str], light: float | None,
    columns: int | None = None,
) -> bytes:  # fmt: skip
    """A file of spheres, `columns` in a row: a picture, or their linear values side by side.

    light: radiance of the furnace they are in, or None.
    """
    import numpy as np

    step = columns or len(spheres)
    rows = [spheres[k : k + step] for k in range(0, len(spheres), step)]
    if kind == "png":
        return _png(rows, [labels[k : k + step] for k in range(0, len(labels), step)], light)
    values = np.concatenate([np.concatenate([s.values for s in r], axis=1) for r in rows])
    if kind == "exr":
        return _exr(values)
    content = io.BytesIO()
    np.save(content, values)
    return content.getvalue()


def encoded(values: Values) -> Values:
    """Linear radiance as sRGB in [0, 1], (height, width, 3)."""
    import numpy as np

    if values.shape[2] not in (1, 3):
        few = f"a picture needs 1 or 3 channels, not {values.shape[2]}"
        raise UserError(f"{few}: write numbers to a .npy file")
    v = np.clip(values, 0.0, 1.0)
    v = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1.0 / 2.4) - 0.055)
    return np.repeat(v, 3 // v.shape[2], axis=2)


def difference(sphere: Sphere, light: float) -> Values:
    """(L - L_i)/L_i of the channel that deviates most, per pixel; NaN beside the sphere."""
    import numpy as np

    d = sphere.values / light - 1.0
    worst = np.take_along_axis(d, np.abs(d).argmax(axis=2)[:, :, None], axis=2)[:, :, 0]
    return np.where(sphere.inside, worst, np.nan)


def coloured(difference: Values) -> Values:
    """A signed difference as pixels of the diverging map; NaN is white."""
    import numpy as np

    anchors = np.array([[int(c[i : i + 2], 16) for i in (0, 2, 4)] for c in LOSS_TO_GAIN])
    at = np.linspace(-SCALE, SCALE, len(anchors))
    known = np.nan_to_num(difference)
    rgb = np.stack([np.interp(known, at, anchors[:, k]) for k in range(3)], axis=-1)
    return np.where(np.isnan(difference)[..., None], 255.0, rgb)


def _png(
    spheres: Sequence[Sequence[Sphere]], labels: Sequence[Sequence[str]], light: float | None
) -> bytes:
    from PIL import Image

    content = io.BytesIO()
    if light is None and len(spheres) == len(spheres[0]) == 1:
        pixels = 255.0 * encoded(spheres[0][0].values) + 0.5
        Image.fromarray(pixels.astype("uint8")).save(content, "png")
        return content.getvalue()
    rows = []
    for some, titles in zip(spheres, labels, strict=True):
        shown = [255.0 * encoded(s.values) for s in some]
        rows.append([Panel(t, pixels) for t, pixels in zip(titles, shown, strict=True)])
        if light is not None:
            rows.append([_difference(s, light) for s in some])
    _page(rows, light).save(content, "png")
    return content.getvalue()


def _difference(sphere: Sphere, light: float) -> Panel:
    import numpy as np

    d = difference(sphere, light)
    return Panel(f"{_percent(np.nanmin(d))} to {_percent(np.nanmax(d))}", coloured(d))


def _percent(value: float) -> str:
    """A signed share; what rounds to nothing has no sign."""
    return f"{value:+.2%}" if abs(value) >= 5e-5 else "0.00%"


def _page(rows: Sequence[Sequence[Panel]], light: float | None) -> Image:
    """All panels on one page; with `light` the scale of differences stands at their right."""
    from PIL import Image

    size = len(rows[0][0].pixels)
    factor = -(-READABLE // size)
    size *= factor
    gap = size // 16
    font = _font(rows, size)
    line = 1.25 * font.size
    heads = [int(line * max(p.title.count("\n") + 1 for p in row)) + gap // 2 for row in rows]
    right = int(size // 10 + font.getlength(NUMBERS[-1])) + gap if light is not None else 0
    width = gap + max(map(len, rows)) * (size + gap) + right
    sheet = Image.new("RGB", (width, gap + sum(heads) + len(rows) * (size + gap // 2)), WHITE)
    top = gap // 2
    for head, row in zip(heads, rows, strict=True):
        for k, panel in enumerate(row):
            _place(sheet, panel, (gap + k * (size + gap), top, head), factor, font)
        top += head + size + gap // 2
    if light is not None:
        _scale(sheet, (width - right, top - size - gap // 2, size), light, font)
    return sheet


def _font(rows: Sequence[Sequence[Panel]], size: int) -> FreeTypeFont:
    """As large as looks well, and no title wider than its picture."""
    largest = _font_of(max(12, size // 20))
    widest = max(largest.getlength(t) for row in rows for p in row for t in p.title.split("\n"))
    return _font_of(max(9.0, largest.size * min(1.0, size / max(1.0, widest))))


def _font_of(size: float) -> FreeTypeFont:
    from PIL import ImageFont

    font = ImageFont.load_default(size)
    assert isinstance(font, ImageFont.FreeTypeFont)  # with a size it is
    return font


def _place(
    sheet: Image, panel: Panel, at: tuple[int, int, int], factor: int, font: FreeTypeFont
) -> None:
    """A title centred above its picture."""
    from PIL import Image, ImageDraw

    left, top, head = at
    whole = (panel.pixels + 0.5).astype("uint8").repeat(factor, 0).repeat(factor, 1)
    sheet.paste(Image.fromarray(whole), (left, top + head))
    ImageDraw.Draw(sheet).multiline_text(
        (left + whole.shape[1] // 2, top + head - font.size // 4),
        panel.title, BLACK, font, anchor="md", align="center", spacing=font.size // 5,
    )  # fmt: skip


def _scale(sheet: Image, at: tuple[int, int, int], light: float, font: FreeTypeFont) -> None:
    """The bar of the diverging map with its numbers."""
    import numpy as np
    from PIL import Image, ImageDraw

    left, top, size = at
    wide = size // 16
    shades = np.repeat(coloured(np.linspace(SCALE, -SCALE, size))[:, None], wide, axis=1)
    sheet.paste(Image.fromarray((shades + 0.5).astype("uint8")), (left, top))
    draw = ImageDraw.Draw(sheet)
    draw.rectangle((left, top, left + wide, top + size), outline=BLACK)
    for k, number in enumerate(NUMBERS):
        y = top + size - size * k // 4
        y_text = min(max(y, top + font.size // 2), top + size - font.size // 2)
        draw.line((left + wide, y, left + wide + wide // 3, y), BLACK)
        draw.text((left + 1.6 * wide, y_text), number, BLACK, font, anchor="lm")
    draw.text((left, top - font.size // 4), f"(L - {light:g})/{light:g}", BLACK, font, anchor="ld")


def _openexr() -> ModuleType:
    return importlib.import_module("OpenEXR")


def _exr(values: Values) -> bytes:
    """RGB, luminance, or any number of channels; OpenEXR writes nothing but files."""
    import tempfile

    import numpy as np

    exr = _openexr()
    pixels = np.ascontiguousarray(values, dtype=np.float32)
    if pixels.shape[2] == 3:
        channels = {"RGB": pixels}
    else:
        planes = [np.ascontiguousarray(pixels[:, :, k]) for k in range(pixels.shape[2])]
        channels = {"Y" if len(planes) == 1 else f"c{k:03d}": p for k, p in enumerate(planes)}
    header = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
    with tempfile.TemporaryDirectory() as folder:
        temporary = Path(folder, "picture.exr")
        exr.File(header, channels).write(str(temporary))
        return temporary.read_bytes()
