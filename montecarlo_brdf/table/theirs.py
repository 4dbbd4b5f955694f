"""Somebody else's table or fit, as a function of the axes: from a file of numbers, a function in a
Python file, or a formula."""

from __future__ import annotations

import inspect
import math
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf import loading
from montecarlo_brdf.errors import ModelError, UserError, unknown
from montecarlo_brdf.files import know_input
from montecarlo_brdf.table.axes import Axis, checked, said
from montecarlo_brdf.table.formula import formula_of
from montecarlo_brdf.table.fresh import Stand
from montecarlo_brdf.table.interpolation import Interpolation, between
from montecarlo_brdf.table.written import csv, npz
from montecarlo_brdf.table.written.header import numbers

Array = NDArray[np.float64]
SUFFIXES = (".npz", ".npy", ".csv", ".exr", ".h")
FUNCTION = re.compile(r"(?P<file>.+\.py):(?P<name>\w+)")


class Theirs(NamedTuple):
    """What it is called, its values between cells, and its cells if it is a table."""

    name: str
    stand: Stand
    cells: Array | None = None  # (measures, cells along each axis)


def is_table(text: str) -> bool:
    """Whether a file of numbers is meant."""
    return Path(text).suffix in SUFFIXES


def axes_of(text: str) -> tuple[tuple[Axis, ...], tuple[str, ...]] | None:
    """The axes and measures that a table written here brings with it; None for any other."""
    if Path(text).suffix not in (".npz", ".csv"):
        return None
    found = _own(Path(text))
    return (checked(found.axes), tuple(found.values)) if found else None


def theirs_of(text: str, axes: Sequence[Axis], measures: Sequence[str]) -> Theirs:
    """What stands against a table with these axes and measures.

    text: a file of numbers (.npz, .npy, .csv, .exr, .h), "fit.py:function" of the axes' names, or a
    formula of them for each measure, with semicolons between. Raises UserError, ModelError where
    it cannot stand for that.
    """
    match = FUNCTION.fullmatch(text)
    if match:
        return Theirs(Path(text).name, _function(text, axes, measures))
    if is_table(text):
        return _table(Path(text), axes, measures)
    if os.path.exists(text):
        raise UserError(f"{text} is no table: {', '.join(SUFFIXES)}, file.py:function or a formula")
    parts = [part.strip() for part in text.split(";")]
    if len(parts) != len(measures):
        wanted = ", ".join(measures)
        raise UserError(f"{len(measures)} formulas are needed, of {wanted}, with ';' between")
    made = [formula_of(part, [axis.name for axis in axes]) for part in parts]
    return Theirs(text, _pointwise(lambda given: [f(given) for f in made], axes))


def _pointwise(one: Callable[[dict[str, float]], Sequence[float]], axes: Sequence[Axis]) -> Stand:
    """A function of one place as one of many."""
    return lambda points: np.array([one(said(axes, p)) for p in points], dtype=float).T


def _function(text: str, axes: Sequence[Axis], measures: Sequence[str]) -> Stand:
    function = loading.function(text)
    wanted = [*inspect.signature(function).parameters]
    names = [axis.name for axis in axes]
    for name in wanted:
        if name not in names:
            raise UserError(f"{text}: " + unknown("axis", name, names))

    def one(given: dict[str, float]) -> Sequence[float]:
        try:
            found: Any = function(**{n: given[n] for n in wanted})
            row = [float(x) for x in (found if isinstance(found, tuple | list) else (found,))]
        except Exception as error:
            file = text.rpartition(":")[0]
            raise ModelError(f"{text} {loading.raised(error, file)}") from error
        if len(row) != len(measures):
            raise ModelError(
                f"{text} returns {len(row)} numbers, but {len(measures)} are asked for: "
                f"{', '.join(measures)}"
            )
        return row

    return _pointwise(one, axes)


def _table(path: Path, axes: Sequence[Axis], measures: Sequence[str]) -> Theirs:
    if not os.path.isfile(path):
        raise UserError(f"no table {path}")
    know_input(path)
    own = _own(path) if path.suffix in (".npz", ".csv") else None
    if own:
        cells = _chosen(path, own, axes, measures)
    else:
        cells = _shaped(path, _plain(path), axes, measures)
    if not np.isfinite(cells).all():
        k, *place = (int(i) for i in np.argwhere(~np.isfinite(cells))[0])
        at = zip(axes, place, strict=True)
        where = ", ".join(f"{a.name} = {a.values()[i]:.6g}" for a, i in at)
        raise UserError(f"table {path} has a value that is not finite: {measures[k]} at {where}")
    return Theirs(path.name, lambda p: between(cells, axes, p, Interpolation.LINEAR), cells)


def _own(path: Path) -> npz.Read | None:
    """A table that was written here."""
    try:
        return npz.read(path) if path.suffix == ".npz" else csv.read(path)
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error


def _chosen(
    path: Path, own: npz.Read, axes: Sequence[Axis], measures: Sequence[str]
) -> Array:
    if tuple(own.axes) != tuple(axes):
        told = "; ".join(a.told() for a in own.axes)
        raise UserError(f"table {path} has other axes ({told}): leave out --axis to take them")
    missing = [m for m in measures if m not in own.values]
    if missing:
        raise UserError(f"table {path} has " + unknown("quantity", missing[0], own.values))
    return np.stack([own.values[m] for m in measures])


def _plain(path: Path) -> Array:
    """The numbers of a file that says nothing of axes."""
    try:
        if path.suffix == ".npy":
            return np.asarray(np.load(path, allow_pickle=False), dtype=float)
        if path.suffix == ".exr":
            return _pixels(path)
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".h":
            return numbers(text)
        rows = [line.split(",") for line in text.splitlines() if line.strip()]
        return np.array(rows, dtype=float)
    except UserError:
        raise
    except Exception as error:  # of libraries that decode: theirs are of every type
        reason = " ".join(str(error).split()) or type(error).__name__
        raise UserError(f"table {path} is damaged or no table: {reason}") from error


def _pixels(path: Path) -> Array:
    try:
        import OpenEXR
    except ImportError as error:
        extra = "pip install 'montecarlo-brdf[scene]'"
        raise UserError(f"reading .exr needs OpenEXR: {extra}") from error
    with OpenEXR.File(str(path), separate_channels=True) as file:
        found = file.channels()
        names = sorted(found, key=lambda n: "RGBA".find(n[-1]) if n[-1] in "RGBA" else 9)
        return np.stack([np.asarray(found[n].pixels, dtype=float) for n in names], axis=-1)


def _shaped(path: Path, found: Array, axes: Sequence[Axis], measures: Sequence[str]) -> Array:
    """Rows from the last axis to the first, as images have them: the first axis runs fastest, and
    the quantities of a cell lie together."""
    sizes = [axis.size for axis in axes]
    cells, m = math.prod(sizes), len(measures)
    shape = "x".join(map(str, reversed(sizes)))
    if found.size % cells or found.size // cells < m:
        raise UserError(
            f"table {path} has {found.size} numbers, but {shape} cells of {m} quantities need "
            f"{cells * m}: say its axes by --axis"
        )
    rows = found.reshape(*reversed(sizes), found.size // cells)[..., :m]
    return np.ascontiguousarray(rows.T)
