"""Forms that are printed in books and shipped in engines and lose their digits, kept on purpose.

Each is a model file like any other; `brdf-check stress --model NAME` and `--compare` know them.
"""

from __future__ import annotations

import importlib
from pathlib import Path

from montecarlo_brdf import contract, loading
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.model import Model


def names() -> list[str]:
    """Every specimen: the files of this folder."""
    return sorted(p.stem for p in Path(__file__).parent.glob("*.py") if not p.stem.startswith("_"))


def load(spec: str) -> Model:
    """A specimen by name, or any model that `loading.load` knows."""
    if spec in names():
        return contract.build(spec, vars(importlib.import_module(f"{__name__}.{spec}")))
    known = loading.names()
    if spec not in known and not (loading.is_path(spec) or "+" in spec):
        either = ", or give the path of a .py file or of a shader"
        raise UserError(unknown("model", spec, [*known, *names()]) + either)
    return loading.load(spec)
