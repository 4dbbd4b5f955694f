"""The model in question: where its source is, and whether it returns at all."""
from __future__ import annotations

import os
from typing import Any

from montecarlo_brdf.errors import TooSlow
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify.common import Deadline
from montecarlo_brdf.verify.supervision import supervised

PATIENCE = 20.0  # seconds for a few evaluations: sampling needs a million


def probed(model: Model, p: Any) -> None:
    """A first look at the model, where it can be left if it does not return."""
    if not supervised(lambda: probe.check(model, p), Deadline(PATIENCE)):
        raise TooSlow(
            f"model {model.name} did not return from its first few evaluations in {PATIENCE:g} s: "
            "too slow to be sampled, or an endless loop"
        )


def source(model: Model) -> dict[str, Any]:
    """File and line of the f of a user's file, relative to here if it lies below."""
    code = getattr(getattr(model.f, "py_func", model.f), "__code__", None)
    if model.built_in or model.terms or code is None or not os.path.isfile(code.co_filename):
        return {}
    return {"file": _relative(code.co_filename), "line": code.co_firstlineno}


def _relative(file: str) -> str:
    below = os.path.relpath(file)
    return os.path.abspath(file) if below.startswith("..") else below.replace(os.sep, "/")
