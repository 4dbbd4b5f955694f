"""Files of the MERL database: 90 x 90 x 180 values of three channels, and what may be wrong with
one."""

from __future__ import annotations

import math
import os
import struct
import types
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.files import know_input

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

MARK, SUFFIX = "merl:", ".binary"
SIZES = (90, 90, 180)
CHANNELS = 3
SCALES = (1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0)
HEAD = struct.Struct("<3i")
LENGTH = HEAD.size + CHANNELS * 8 * math.prod(SIZES)
LEAST = 1e-6  # of the largest mean, that a bin of half vectors is drawn with


def is_measured(spec: str) -> bool:
    """Whether a measured file is asked for."""
    return spec.startswith(MARK)


def namespace(spec: str) -> Mapping[str, Any]:
    """The names of a model that reads the file of 'merl:file.binary'.

    Raises UserError if there is no such file, ModelError for one that is not of the database.
    """
    import numpy as np

    path = Path(spec.removeprefix(MARK))
    planes = read(path)
    code = Path(__file__).with_name("half_angles.py")
    made = types.ModuleType(path.stem)
    exec(compile(code.read_text(encoding="utf-8"), f"{path} (measured)", "exec"), vars(made))  # noqa: S102
    tables: list[list[Any]] = []
    keep: list[Array] = []
    for scales in (SCALES, (1.0,) * CHANNELS):
        row: list[Any] = []
        for plane, scale in zip(planes, scales, strict=True):
            values = np.ascontiguousarray(np.where(plane >= 0.0, plane * scale, -1.0))
            arrays = (values, *halves_of(values))
            keep += arrays
            row.append(tuple(float(array.ctypes.data) for array in arrays))
        tables.append(row)
    tables[0] = _doubted(path, planes, tables[0])
    vars(made).update(TABLES=tables, KEEP=keep)
    return vars(made)


def read(path: Path) -> Array:
    """The values as the file has them, (channels, theta_h, theta_d, phi_d)."""
    import numpy as np

    if not os.path.isfile(path):
        raise UserError(f"no measured file {path}")
    know_input(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    _check(path, content)
    planes = np.frombuffer(content, "<f8", offset=HEAD.size).reshape(CHANNELS, *SIZES)
    if not np.isfinite(planes).all():
        raise ModelError(f"measured file {path} has values that are not finite")
    if not (planes >= 0.0).any(axis=(1, 2, 3)).all():
        raise ModelError(f"measured file {path} has a channel without any measured value")
    return planes


def _check(path: Path, content: bytes) -> None:
    """Raise ModelError for another kind of file, another size, a truncated one."""
    wanted = " x ".join(map(str, SIZES))
    if len(content) < HEAD.size:
        raise ModelError(f"measured file {path} is truncated: {len(content)} bytes")
    sizes = HEAD.unpack_from(content)
    if sizes != SIZES:
        turned = struct.unpack_from(">3i", content) == SIZES
        why = "its bytes are in the wrong order" if turned else f"not {' x '.join(map(str, sizes))}"
        raise ModelError(f"measured file {path} must have dimensions {wanted}: {why}")
    if len(content) != LENGTH:
        what = "truncated" if len(content) < LENGTH else "too long"
        raise ModelError(
            f"measured file {path} is {what}: {len(content)} bytes, where {wanted} doubles of "
            f"{CHANNELS} channels make {LENGTH}"
        )


def halves_of(values: Array) -> tuple[Array, Array]:
    """How half vectors are drawn: the share of them before each edge of theta_h's bins, and their
    density in sin^2(theta_h) there, which goes like the mean of f and is linear in between."""
    import numpy as np

    known = values >= 0.0
    total = np.where(known, values, 0.0).sum(axis=(1, 2))
    mean = total / np.maximum(known.sum(axis=(1, 2)), 1)
    mean = np.maximum(mean, LEAST * mean.max()) if mean.max() > 0.0 else np.ones(len(mean))
    heights = np.concatenate([mean[:1], 0.5 * (mean[1:] + mean[:-1]), mean[-1:]])
    edges = np.sin((np.arange(SIZES[0] + 1) / SIZES[0]) ** 2 * (0.5 * np.pi)) ** 2
    shares = np.cumsum(0.5 * (heights[1:] + heights[:-1]) * np.diff(edges))
    return np.concatenate([[0.0], shares]) / shares[-1], heights / shares[-1]


def normal_albedo(values: Array) -> float:
    """A of light that falls in along the normal, roughly: theta_h = theta_d = theta_i/2."""
    import numpy as np

    theta = (np.arange(90) + 0.5) / 90.0 * (0.5 * np.pi)
    half = 0.5 * theta / (0.5 * np.pi)
    i = np.minimum((SIZES[0] * np.sqrt(half)).astype(int), SIZES[0] - 1)
    j = np.minimum((SIZES[1] * half).astype(int), SIZES[1] - 1)
    f = np.maximum(values[i, j], 0.0).mean(axis=-1)
    return float(np.sum(f * np.cos(theta) * np.sin(theta)) * (np.pi**2 / 90.0))


def _doubted(path: Path, planes: Array, tables: Sequence[Any]) -> list[Any]:
    """A sentence in place of the tables of a file that seems to be scaled already: what reflects no
    more than it receives without MERL's scales would be darker than any material with them."""
    seen = max(normal_albedo(plane) for plane in planes)
    if seen > 1.0:
        return list(tables)
    told = (
        f"measured file {path} reflects {seen:.2g} at the normal without MERL's scales, and with "
        f"them {seen * SCALES[0]:.1e}: it is scaled already, write -p scale=one"
    )
    return [told] * CHANNELS


def encoded(planes: Array) -> bytes:
    """A file of values in 1/sr, (channels, theta_h, theta_d, phi_d); negative ones are not
    measured."""
    import numpy as np

    scales = np.array(SCALES)[:, None, None, None]
    raw = np.where(planes >= 0.0, planes / scales, -1.0)
    return HEAD.pack(*SIZES) + raw.astype("<f8").tobytes()
