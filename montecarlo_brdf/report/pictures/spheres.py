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
#: ends that the scale of a difference panel may have
SCALES = tuple(m * 10.0**e for e in range(-6, 2) for m in (1.0, 2.0, 5.0))
READABLE = 192  # pixels: smaller spheres are enlarged by whole factors
LOSS_TO_GAIN = (
    "053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7",
    "fddbc7", "f4a582", "d6604d", "b2182b", "67001f",
)  # fmt: skip
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
    columns: int | None = None, scale: float | None = None, exposure: float = 0.0,
) -> bytes:  # fmt: skip
    """A file of spheres, `columns` in a row: a picture, or their linear values side by side.

    light: radiance of the furnace they are in, or None. scale: of the difference to it at the ends
    of the colours, None for one that fits. exposure: powers of two by which a picture is brighter.
    """
    import numpy as np

    step = columns or len(spheres)
    rows = [spheres[k : k + step] for k in range(0, len(spheres), step)]
    if kind == "png":
        named = [labels[k : k + step] for k in range(0, len(labels), step)]
        furnace = None
        if light is not None:
            furnace = Furnace(light, scale or fitting([difference(s, light) for s in spheres]))
        return _png(rows, named, furnace, exposure)
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


class Furnace(NamedTuple):
    """The radiance of the light, and the difference to it that the colours end at."""

    light: float
    scale: float

    def numbers(self) -> list[str]:
        """What stands at the bar of colours, from its lower end."""
        ends = [f"{k * self.scale:+.3g}".replace("+0", "0") for k in (-100, -50, 0, 50, 100)]
        return [f"{ends[0]}% or less", *(f"{n}%" for n in ends[1:-1]), f"{ends[-1]}% or more"]


def fitting(differences: Sequence[Values]) -> float:
    """The least scale at which no difference is cut off."""
    import numpy as np

    largest = max((float(np.nanmax(np.abs(d))) for d in differences), default=0.0)
    return next((s for s in SCALES if s >= largest), SCALES[-1])


def coloured(difference: Values, scale: float) -> Values:
    """A signed difference as pixels of the diverging map; NaN is white."""
    import numpy as np

    anchors = np.array([[int(c[i : i + 2], 16) for i in (0, 2, 4)] for c in LOSS_TO_GAIN])
    at = np.linspace(-scale, scale, len(anchors))
    known = np.nan_to_num(difference)
    rgb = np.stack([np.interp(known, at, anchors[:, k]) for k in range(3)], axis=-1)
    return np.where(np.isnan(difference)[..., None], 255.0, rgb)


def _png(
    spheres: Sequence[Sequence[Sphere]], labels: Sequence[Sequence[str]], furnace: Furnace | None,
    exposure: float,
) -> bytes:  # fmt: skip
    from PIL import Image

    content = io.BytesIO()
    bright = 2.0**exposure
    if furnace is None and len(spheres) == len(spheres[0]) == 1:
        pixels = 255.0 * encoded(bright * smooth(spheres[0][0])) + 0.5
        Image.fromarray(pixels.astype("uint8")).save(content, "png")
        return content.getvalue()
    rows = []
    for some, titles in zip(spheres, labels, strict=True):
        shown = [255.0 * encoded(bright * smooth(s)) for s in some]
        rows.append([Panel(t, pixels) for t, pixels in zip(titles, shown, strict=True)])
        if furnace is not None:
            rows.append([_difference(s, furnace) for s in some])
    _page(rows, furnace).save(content, "png")
    return content.getvalue()


def smooth(sphere: Sphere) -> Values:
    """The radiance with an edge that is as soft as a pixel is wide: what a pixel at the edge shows
    is part sphere, part background. Numbers that are written are not touched."""
    import numpy as np

    values, inside = sphere.values, sphere.inside
    size = len(inside)
    x = (np.arange(size) + 0.5) * (2.2 / size) - 1.1
    out = (np.hypot(*np.meshgrid(x, x)) - 1.0) * size / 2.2  # pixels beyond the edge
    edge = np.abs(out) < 0.5
    near = values.copy()
    for row, column in zip(*np.nonzero(edge & ~inside), strict=True):
        around = (slice(max(0, row - 1), row + 2), slice(max(0, column - 1), column + 2))
        near[row, column] = values[around][inside[around]].mean(axis=0)
    cover = np.clip(0.5 - out, 0.0, 1.0)[:, :, None]
    background = values[0, 0]  # of a corner, where no sphere is
    return np.where(edge[:, :, None], cover * near + (1.0 - cover) * background, values)


def _difference(sphere: Sphere, furnace: Furnace) -> Panel:
    import numpy as np

    d = difference(sphere, furnace.light)
    title = f"{_percent(np.nanmin(d))} to {_percent(np.nanmax(d))}"
    return Panel(title, coloured(d, furnace.scale))


def _percent(value: float) -> str:
    """A signed share; what rounds to nothing has no sign."""
    return f"{value:+.2%}" if abs(value) >= 5e-5 else "0.00%"


def _page(rows: Sequence[Sequence[Panel]], furnace: Furnace | None) -> Image:
    """All panels on one page; in a furnace the scale of differences stands at their right."""
    from PIL import Image

    size = len(rows[0][0].pixels)
    factor = -(-READABLE // size)
    size *= factor
    gap = size // 16
    font = _font(rows, size)
    line = 1.25 * font.size
    heads = [int(line * max(p.title.count("\n") + 1 for p in row)) + gap // 2 for row in rows]
    right = int(size // 10 + font.getlength(furnace.numbers()[-1])) + gap if furnace else 0
    width = gap + max(map(len, rows)) * (size + gap) + right
    sheet = Image.new("RGB", (width, gap + sum(heads) + len(rows) * (size + gap // 2)), WHITE)
    top = gap // 2
    for head, row in zip(heads, rows, strict=True):
        for k, panel in enumerate(row):
            _place(sheet, panel, (gap + k * (size + gap), top, head), factor, font)
        top += head + size + gap // 2
    if furnace is not None:
        _scale(sheet, (width - right, top - size - gap // 2, size), furnace, font)
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


def _scale(sheet: Image, at: tuple[int, int, int], furnace: Furnace, font: FreeTypeFont) -> None:
    """The bar of the diverging map with its numbers."""
    import numpy as np
    from PIL import Image, ImageDraw

    left, top, size = at
    wide, s = size // 16, furnace.scale
    shades = np.repeat(coloured(np.linspace(s, -s, size), s)[:, None], wide, axis=1)
    sheet.paste(Image.fromarray((shades + 0.5).astype("uint8")), (left, top))
    draw = ImageDraw.Draw(sheet)
    draw.rectangle((left, top, left + wide, top + size), outline=BLACK)
    for k, number in enumerate(furnace.numbers()):
        y = top + size - size * k // 4
        y_text = min(max(y, top + font.size // 2), top + size - font.size // 2)
        draw.line((left + wide, y, left + wide + wide // 3, y), BLACK)
        draw.text((left + 1.6 * wide, y_text), number, BLACK, font, anchor="lm")
    title = f"(L - {furnace.light:g})/{furnace.light:g}"
    draw.text((left, top - font.size // 4), title, BLACK, font, anchor="ld")


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
