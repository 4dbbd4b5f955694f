"""Pictures of spheres: sRGB in PNG, furnace panels with signed differences, raw numbers."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import OutputError, UserError
from montecarlo_brdf.files import write_bytes
from montecarlo_brdf.report import panels

KINDS = ("png", "npy", "exr")


def check_kind(path: Path) -> None:
    """Raise OutputError unless the name ends in a kind that can be written here."""
    kind = path.suffix.lstrip(".").lower()
    if kind not in KINDS:
        raise OutputError(f"cannot write {path}: the name must end in .png, .npy or .exr")
    if kind == "exr":
        _openexr(path)


def save(
    path: Path,
    spheres: Sequence[Any],
    labels: Sequence[str],
    furnace: float | None,
    columns: int | None = None,
) -> None:
    """Write the spheres, `columns` in a row: a picture, or their linear values side by side."""
    kind = path.suffix.lstrip(".").lower()
    rows = _rows(spheres, columns)
    if kind == "png":
        write_bytes(path, _png(rows, _rows(labels, columns), furnace))
        return
    import numpy as np

    values = np.concatenate([np.concatenate([s.values for s in r], axis=1) for r in rows])
    if kind == "exr":
        _write_exr(path, values)
        return
    content = io.BytesIO()
    np.save(content, values)
    write_bytes(path, content.getvalue())


def _rows(things: Sequence[Any], columns: int | None) -> list[Sequence[Any]]:
    step = columns or len(things)
    return [things[k : k + step] for k in range(0, len(things), step)]


def encoded(values: Any) -> Any:
    """Linear radiance as sRGB in [0, 1], (height, width, 3)."""
    import numpy as np

    if values.shape[2] not in (1, 3):
        raise UserError(
            f"a picture needs 1 or 3 channels, not {values.shape[2]}: write numbers to a .npy file"
        )
    v = np.clip(values, 0.0, 1.0)
    v = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1.0 / 2.4) - 0.055)
    return np.repeat(v, 3 // v.shape[2], axis=2)


def difference(sphere: Any, light: float) -> Any:
    """(L - L_i)/L_i of the channel that deviates most, per pixel; NaN beside the sphere."""
    import numpy as np

    d = sphere.values / light - 1.0
    worst = np.take_along_axis(d, np.abs(d).argmax(axis=2)[:, :, None], axis=2)[:, :, 0]
    return np.where(sphere.inside, worst, np.nan)


def _png(
    spheres: Sequence[Sequence[Any]], labels: Sequence[Sequence[str]], furnace: float | None
) -> bytes:
    from PIL import Image

    content = io.BytesIO()
    if furnace is None and len(spheres) == len(spheres[0]) == 1:
        pixels = _pixels(spheres[0][0]) + 0.5
        Image.fromarray(pixels.astype("uint8")).save(content, "png")
    else:
        rows = [
            row
            for some, names in zip(spheres, labels, strict=True)
            for row in _panels(some, names, furnace)
        ]
        panels.page(rows, furnace).save(content, "png")
    return content.getvalue()


def _panels(
    spheres: Sequence[Any], labels: Sequence[str], furnace: float | None
) -> list[list[panels.Panel]]:
    """A row of spheres, and in a furnace the signed differences below it."""
    found = [[panels.Panel(t, _pixels(s)) for s, t in zip(spheres, labels, strict=True)]]
    if furnace is not None:
        found.append([_difference(s, furnace) for s in spheres])
    return found


def _pixels(sphere: Any) -> Any:
    return 255.0 * encoded(sphere.values)


def _difference(sphere: Any, light: float) -> panels.Panel:
    import numpy as np

    d = difference(sphere, light)
    title = f"{_percent(np.nanmin(d))} to {_percent(np.nanmax(d))}"
    return panels.Panel(title, panels.coloured(d))


def _percent(value: float) -> str:
    """A signed share; what rounds to nothing has no sign."""
    return f"{value:+.2%}" if abs(value) >= 5e-5 else "0.00%"


def _openexr(path: Path) -> Any:
    try:
        import OpenEXR
    except ImportError as error:
        raise OutputError(
            f"cannot write {path}: .exr needs OpenEXR, pip install 'montecarlo-brdf[scene]'"
        ) from error
    return OpenEXR


def _write_exr(path: Path, values: Any) -> None:
    import tempfile

    import numpy as np

    exr = _openexr(path)
    pixels = np.ascontiguousarray(values, dtype=np.float32)
    if pixels.shape[2] == 3:
        channels = {"RGB": pixels}
    else:
        planes = [np.ascontiguousarray(pixels[:, :, k]) for k in range(pixels.shape[2])]
        channels = {"Y" if len(planes) == 1 else f"c{k:03d}": p for k, p in enumerate(planes)}
    header = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
    with tempfile.TemporaryDirectory() as folder:
        temporary = Path(folder) / "picture.exr"
        exr.File(header, channels).write(str(temporary))
        write_bytes(path, temporary.read_bytes())
