"""NumPy's .npz: the values of every axis, of every quantity, their certificates, and how they were
made; equal tables are equal bytes."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table.axes import Axis, Placement
from montecarlo_brdf.table.written.finished import Finished

Array = NDArray[np.float64]
FACTS = "brdf_check"
LONG_AGO = (1980, 1, 1, 0, 0, 0)


class Read(NamedTuple):
    """What a table written here says."""

    axes: tuple[Axis, ...]
    values: Mapping[str, Array]


def write(table: Finished) -> bytes:
    """The file."""
    facts = {**table.facts, "model": table.title, "quantities": [*table.values],
             "axes": [facts_of(a) for a in table.axes]}  # fmt: skip
    arrays: dict[str, Any] = {axis.name: np.array(axis.values()) for axis in table.axes}
    arrays |= table.values
    arrays |= {f"{name}_error": errors for name, errors in table.errors.items()}
    arrays[FACTS] = np.array(json.dumps(facts))
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.ascontiguousarray(array), allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy", LONG_AGO)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, member.getvalue())
    return content.getvalue()


def facts_of(axis: Axis) -> dict[str, Any]:
    """An axis, as files say it."""
    return {**axis._asdict(), "placement": str(axis.placement), "told": axis.told()}


def axis_of(said: Mapping[str, Any]) -> Axis:
    """The axis that facts say."""
    return Axis(str(said["name"]), float(said["low"]), float(said["high"]), int(said["size"]),
                Placement(said["placement"]))  # fmt: skip


def read(path: Path) -> Read | None:
    """A table that was written here; None for other archives. Raises UserError for none at all."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            if FACTS not in archive:
                raise UserError(
                    f"table {path} was not written here ({', '.join(archive.files)}): save its "
                    "values as .npy and say its axes by --axis"
                )
            facts = json.loads(archive[FACTS].item())
            axes = tuple(axis_of(a) for a in facts["axes"])
            values = {n: np.asarray(archive[n], dtype=float) for n in facts["quantities"]}
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise UserError(f"table {path} is damaged or no table: {' '.join(str(error).split())}"
                        ) from error  # fmt: skip
    shape = tuple(axis.size for axis in axes)
    if any(v.shape != shape for v in values.values()):
        raise UserError(f"table {path} is damaged: its values do not have the shape of its axes")
    return Read(axes, values)
