"""CSV: a line per cell, with its coordinates, values and certificates; comments say how it was
made."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table.axes import points
from montecarlo_brdf.table.written.finished import Finished
from montecarlo_brdf.table.written.npz import Read, axis_of, facts_of

MARK = "# brdf-check table "


def write(table: Finished) -> bytes:
    """The file."""
    facts = {**table.facts, "model": table.title, "quantities": [*table.values],
             "axes": [facts_of(a) for a in table.axes]}  # fmt: skip
    names = [a.name for a in table.axes]
    names += [n for q in table.values for n in (q, f"{q}_error")]
    columns = [c.ravel() for q in table.values for c in (table.values[q], table.errors[q])]
    lines = [MARK + json.dumps(facts), ",".join(names)]
    for k, point in enumerate(points(table.axes)):
        cells = [repr(float(x)) for x in (*point, *(c[k] for c in columns))]
        lines.append(",".join(cells))
    return ("\n".join(lines) + "\n").encode()


def read(path: Path) -> Read | None:
    """A table that was written here; None for other CSV files."""
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise UserError(f"table {path} is no text") from error
    if not text.startswith(MARK):
        return None
    try:
        head, names, *lines = text.splitlines()
        facts = json.loads(head[len(MARK):])
        axes = tuple(axis_of(a) for a in facts["axes"])
        shape = tuple(axis.size for axis in axes)
        rows = np.array([line.split(",") for line in lines], dtype=float)
        place = {name: k for k, name in enumerate(names.split(","))}
        values = {q: rows[:, place[q]].reshape(shape) for q in facts["quantities"]}
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise UserError(f"table {path} is damaged: {' '.join(str(error).split())}") from error
    return Read(axes, values)
