"""Whether the certificates of tables hold: errors against references, in units of certificates.

A table of every model and seed; the certificates of all its values hold at once with 99 %. The
standard errors that certificates are made of are held against Student's t too: how many errors lie
beyond its 1 %, 10^-3, 10^-4 quantiles.

    python scripts/table_certificates.py [SEEDS]
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import references
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.table.axes import Axis, checked, points
from montecarlo_brdf.table.cell import LOOKS, REPLICATES, Terms
from montecarlo_brdf.table.cells import filled
from montecarlo_brdf.table.subject import Subject, measures_of

TARGET = Path(__file__).parent / "results" / "table_certificates.json"
SIZE, ERROR = 32, 1e-5
MU = Axis("mu", 0.0, 1.0, SIZE)
#: model, its second axis
CASES = (
    ("ggx", Axis("alpha", 0.0, 1.0, SIZE)),
    ("beckmann", Axis("alpha", 0.0, 1.0, SIZE)),
    ("phong", Axis("n", 0.0, 200.0, SIZE)),
    ("fon", Axis("roughness", 0.0, 1.0, SIZE)),
)
LEVELS = (1e-2, 1e-3, 1e-4)


def ratios(name: str, axis: Axis, known: np.ndarray, seed: int) -> np.ndarray:
    """Errors over certificates of a table."""
    model = mb.load(name)
    subject = Subject(model, checked([MU, axis]), measures_of(["albedo"]))
    found = filled(subject, Terms(ERROR, 0.01 / SIZE**2, seed), threads=2)
    return np.asarray(np.abs(found.values[0] - known) / found.errors[0])


def truths(name: str, axis: Axis) -> np.ndarray:
    """Of all cells."""
    model, rows = mb.load(name), []
    for mu, x in points([MU, axis]):
        p = model.parameters(**{axis.name: x})._asdict()
        found = references.albedo(name, mu, **p, **model.picks)
        assert found is not None
        rows.append(found.value)
    return np.array(rows).reshape(SIZE, SIZE)


def case(name: str, axis: Axis, seeds: int) -> dict[str, Any]:
    """All tables of a model."""
    known = truths(name, axis)
    rows = np.array([ratios(name, axis, known, seed) for seed in range(seeds)])
    width = quantile(0.5 * 0.01 / SIZE**2 / LOOKS, REPLICATES - 1)
    beyond = {f"{level:g}": float(np.mean(rows * width > quantile(0.5 * level, REPLICATES - 1)))
              for level in LEVELS}  # fmt: skip
    return {"model": name, "values": rows.size, "largest": float(rows.max()),
            "outside": int((rows > 1.0).sum()), "beyond": beyond}  # fmt: skip


def main() -> None:
    """All models."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    found = [case(name, axis, seeds) for name, axis in CASES]
    TARGET.write_text(json.dumps({**describe(), "cases": found}, indent=1) + "\n", encoding="utf-8")
    for one in found:
        shares = ", ".join(f"{level}: {share:.1e}" for level, share in one["beyond"].items())
        print(f"{one['model']:9} {one['values']} values, {one['outside']} outside, largest error "
              f"{one['largest']:.2f} of its certificate; beyond {shares}")  # fmt: skip


if __name__ == "__main__":
    main()
