"""A page of spheres drawn pixel by pixel: titles, and in a furnace the signed difference below.

Drawn with Pillow: every pixel of a sphere is a pixel of the page, which a plot's resampling would
not give. The diverging map is ColorBrewer's RdBu (Brewer 2003), blue for loss and red for gain.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

SCALE = 0.1  # the difference panel runs from -10 % to +10 %
READABLE = 192  # pixels: smaller spheres are enlarged by whole factors
LOSS_TO_GAIN = (
    "053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7",
    "fddbc7", "f4a582", "d6604d", "b2182b", "67001f",
)  # fmt: skip
NUMBERS = ("-10% or less", "-5%", "0%", "+5%", "+10% or more")
WHITE, BLACK = (255, 255, 255), (0, 0, 0)


class Panel(NamedTuple):
    """One cell: a title and pixels (size, size, 3) of 0 to 255."""

    title: str
    pixels: Any


def coloured(difference: Any) -> Any:
    """A signed difference as pixels of the diverging map; NaN is white."""
    import numpy as np

    anchors = np.array([[int(c[i : i + 2], 16) for i in (0, 2, 4)] for c in LOSS_TO_GAIN])
    at = np.linspace(-SCALE, SCALE, len(anchors))
    known = np.nan_to_num(difference)
    rgb = np.stack([np.interp(known, at, anchors[:, k]) for k in range(3)], axis=-1)
    return np.where(np.isnan(difference)[..., None], 255.0, rgb)


def page(rows: Sequence[Sequence[Panel]], light: float | None) -> Any:
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


def _font(rows: Sequence[Sequence[Panel]], size: int) -> Any:
    """As large as looks well, and no title wider than its picture."""
    from PIL import ImageFont

    font: Any = ImageFont.load_default(max(12, size // 20))
    widest = max(font.getlength(t) for row in rows for p in row for t in p.title.split("\n"))
    return ImageFont.load_default(max(9.0, font.size * min(1.0, size / max(1.0, widest))))


def _place(sheet: Any, panel: Panel, at: tuple[int, int, int], factor: int, font: Any) -> None:
    """A title centred above its picture."""
    from PIL import Image, ImageDraw

    left, top, head = at
    whole = (panel.pixels + 0.5).astype("uint8").repeat(factor, 0).repeat(factor, 1)
    sheet.paste(Image.fromarray(whole), (left, top + head))
    ImageDraw.Draw(sheet).multiline_text(
        (left + whole.shape[1] // 2, top + head - font.size // 4),
        panel.title, BLACK, font, anchor="md", align="center", spacing=font.size // 5,
    )  # fmt: skip


def _scale(sheet: Any, at: tuple[int, int, int], light: float, font: Any) -> None:
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
    title = f"(L - {light:g})/{light:g}"
    draw.text((left, top - font.size // 4), title, BLACK, font, anchor="ld")
