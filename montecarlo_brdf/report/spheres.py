"""Pictures of spheres: tone-mapped PNG, furnace panels with signed differences, raw numbers."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import OutputError, UserError
from montecarlo_brdf.report.write import write_bytes

KINDS = ("png", "npy", "exr")
SCALE = 0.1  # the difference panel runs from -10 % to +10 %


def check_kind(path: Path) -> None:
    """Raise OutputError unless the name ends in a kind that can be written here."""
    kind = path.suffix.lstrip(".").lower()
    if kind not in KINDS:
        raise OutputError(f"cannot write {path}: the name must end in .png, .npy or .exr")
    if kind == "exr":
        _openexr(path)


def save(path: Path, spheres: Sequence[Any], labels: Sequence[str], furnace: float | None) -> None:
    """Write the spheres: a picture, or their linear values side by side."""
    import numpy as np

    kind = path.suffix.lstrip(".").lower()
    values = np.concatenate([s.values for s in spheres], axis=1)
    if kind == "npy":
        content = io.BytesIO()
        np.save(content, values)
        write_bytes(path, content.getvalue())
    elif kind == "exr":
        _write_exr(path, values)
    else:
        write_bytes(path, _png(spheres, labels, furnace))


def encoded(values: Any) -> Any:
    """Linear radiance as sRGB in [0, 1], (height, width, 3)."""
    import numpy as np

    if values.shape[2] not in (1, 3):
        raise UserError(
            f"a picture needs 1 or 3 channels, not {values.shape[2]}: write numbers to a .npy file"
        )
    v = np.clip(np.repeat(values, 3 // values.shape[2], axis=2), 0.0, 1.0)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1.0 / 2.4) - 0.055)


def difference(sphere: Any, light: float) -> Any:
    """(L - L_i)/L_i of the channel that deviates most, per pixel; NaN beside the sphere."""
    import numpy as np

    d = sphere.values / light - 1.0
    worst = np.take_along_axis(d, np.abs(d).argmax(axis=2)[:, :, None], axis=2)[:, :, 0]
    return np.where(sphere.inside, worst, np.nan)


def _png(spheres: Sequence[Any], labels: Sequence[str], furnace: float | None) -> bytes:
    content = io.BytesIO()
    if furnace is None and len(spheres) == 1:
        from PIL import Image

        Image.fromarray((255.0 * encoded(spheres[0].values) + 0.5).astype("uint8")).save(
            content, "png"
        )
    else:
        import matplotlib

        matplotlib.use("Agg")
        _figure(spheres, labels, furnace).savefig(content, format="png", dpi=100)
    return content.getvalue()


def _figure(spheres: Sequence[Any], labels: Sequence[str], furnace: float | None) -> Any:
    """One column per parameter set: the sphere, and in a furnace the signed difference below it."""
    from matplotlib.figure import Figure

    rows = 1 if furnace is None else 2
    width = 3.2 * len(spheres) + (0.0 if furnace is None else 1.0)
    figure = Figure(figsize=(width, 3.3 * rows), layout="constrained")
    axes = figure.subplots(rows, len(spheres), squeeze=False)
    for k, (sphere, label) in enumerate(zip(spheres, labels, strict=True)):
        axes[0][k].imshow(encoded(sphere.values), interpolation="nearest")
        axes[0][k].set_title(label, fontsize=9)
        if furnace is not None:
            _panel(axes[1][k], sphere, furnace)
    for one in axes.ravel():
        one.set_axis_off()
    if furnace is not None:
        ticks = [k * SCALE / 2.0 for k in range(-2, 3)]
        image = axes[1][-1].images[0]
        bar = figure.colorbar(image, ax=list(axes[1]), extend="both", shrink=0.9, ticks=ticks)
        bar.set_label(f"(L_o - L_i)/L_i,  L_i = {furnace:g}")
        bar.ax.yaxis.set_major_formatter("{x:+.0%}")
    return figure


def _panel(axes: Any, sphere: Any, light: float) -> None:
    import numpy as np

    d = difference(sphere, light)
    axes.imshow(d, cmap="RdBu_r", vmin=-SCALE, vmax=SCALE, interpolation="nearest")
    axes.set_title(f"{np.nanmin(d):+.2%} to {np.nanmax(d):+.2%}", fontsize=9)


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
