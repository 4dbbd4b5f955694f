"""All cells of a table: spread over threads, kept in a file on the way, the same whatever the way.

A cell depends on nothing but its place and the terms, so neither threads nor an interruption show.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.estimate.plan import Progress
from montecarlo_brdf.files import check_writable, write_bytes
from montecarlo_brdf.model import channels
from montecarlo_brdf.table.axes import Point, points
from montecarlo_brdf.table.cell import Cell, Terms, cell
from montecarlo_brdf.table.subject import Subject
from montecarlo_brdf.vectors import from_degrees

Array = NDArray[np.float64]
TOGETHER = 64  # cells of a piece of work
EVERY = 10.0  # seconds between two writings
FORMAT = b"brdf-check table, cells 1\n"


class Cells(NamedTuple):
    """Values and how far they are off at most, (measures, cells along each axis)."""

    values: Array
    errors: Array


def filled(
    subject: Subject, terms: Terms, threads: int = 1, progress: Progress | None = None,
    resume: Path | None = None,
) -> Cells:  # fmt: skip
    """The cells at all places of the axes. resume: where they are kept until all are there."""
    places = list(points(subject.axes))
    store = Store(resume, _digest(subject, terms, places)) if resume else None
    rows = np.full((len(places), 2, len(subject.measures)), np.nan)
    if store:
        store.read(rows)
    try:
        for first, found in _pieces(subject, terms, places, rows, threads):
            rows[first : first + len(found)] = [[c.values, c.errors] for c in found]
            if store:
                store.keep(rows)
            if progress:
                progress(min(1.0, (first + len(found)) / len(places)))
    finally:
        if store:
            store.write(rows)
    shape = tuple(axis.size for axis in subject.axes)
    both = np.moveaxis(rows, (1, 2), (0, 1)).reshape(2, len(subject.measures), *shape)
    return Cells(*both)


def at(subject: Subject, terms: Terms, places: Sequence[Point], threads: int = 1) -> Cells:
    """The cells at some places, (measures, places)."""
    with ThreadPoolExecutor(threads) as pool:
        found = list(pool.map(lambda point: cell(subject, point, terms), places))
    return Cells(np.array([c.values for c in found]).T, np.array([c.errors for c in found]).T)


def _pieces(
    subject: Subject, terms: Terms, places: list[Point], rows: Array, threads: int
) -> Iterator[tuple[int, list[Cell]]]:
    """Pieces of work that are not done, in order, each with where it begins."""
    starts = range(0, len(places), TOGETHER)
    left = [k for k in starts if np.isnan(rows[k : k + TOGETHER, 1]).any()]

    def piece(k: int) -> list[Cell]:
        return [cell(subject, point, terms) for point in places[k : k + TOGETHER]]

    with ThreadPoolExecutor(threads) as pool:
        for batch in _batches(left, 2 * threads):
            yield from zip(batch, pool.map(piece, batch), strict=True)


def _batches(items: Sequence[int], size: int) -> Iterator[Sequence[int]]:
    return (items[k : k + size] for k in range(0, len(items), size))


class Store:
    """A file of cells, whole or not at all; what it is of is in its first lines."""

    def __init__(self, path: Path, digest: str) -> None:
        check_writable(path)
        self._path, self._head = path, FORMAT + digest.encode() + b"\n"
        self._written = time.monotonic()

    def read(self, rows: Array) -> None:
        """Fill in what is known. Raises UserError for a file that holds anything else."""
        if not self._path.exists():
            return
        try:
            content = self._path.read_bytes()
        except OSError as error:
            raise UserError(f"cannot read {self._path}: {error.strerror or error}") from error
        if not content.startswith(FORMAT) or len(content) != len(self._head) + rows.nbytes:
            raise UserError(
                f"cannot resume from {self._path}: it holds no cells of this table, or is damaged"
            )
        if not content.startswith(self._head):
            raise UserError(
                f"cannot resume from {self._path}: it is of another model, table, seed or version"
            )
        rows[...] = np.frombuffer(content, offset=len(self._head)).reshape(rows.shape)

    def keep(self, rows: Array) -> None:
        """From time to time write them down."""
        if time.monotonic() - self._written > EVERY:
            self.write(rows)

    def write(self, rows: Array) -> None:
        """Write them down."""
        write_bytes(self._path, self._head + rows.tobytes())
        self._written = time.monotonic()


def _digest(subject: Subject, terms: Terms, places: Sequence[Point]) -> str:
    """Hash of all that the cells depend on: what is asked, the machine code, and values of f at
    some places, which tell what a model prepares and reads."""
    asked: list[Any] = [subject.model.identity, subject.model.picks, [*map(repr, subject.axes)],
                        subject.measures, repr(subject.split), terms]  # fmt: skip
    wo, wi = from_degrees(35.0, 20.0), from_degrees(50.0, 170.0)
    for point in (places[0], places[len(places) // 2], places[-1]):
        place = subject.place(point)
        model = subject.model.of(place.p)
        asked.append((place, [float(Pointwise(model, p).f(wo, wi)[0]) for p in channels(place.p)]))
        methods = adaptive.methods(model)
        asked.append([adaptive.prepare(model, place.p, 0, m).looks.key for m in methods])
    return hashlib.blake2b(json.dumps(asked, default=repr).encode(), digest_size=16).hexdigest()
