"""Compiling what a user wrote: numba's complaints become one sentence."""

from __future__ import annotations

from typing import Any

from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.integration import build


def compiled(name: str, recipe: build.Buildable) -> Any:
    """The kernel of a recipe for model `name`; numba's complaints become one sentence."""
    try:
        return build.kernel_of(recipe)
    except (MemoryError, UserError):
        raise
    except Exception as error:  # what numba cannot compile ends in errors of every kind
        raise ModelError(f"model {name} does not compile: {_first_reason(error)}") from error


def _first_reason(error: Exception) -> str:
    """The line of a numba error that says what is wrong, without its stack of contexts."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    telling = [line for line in lines if not line.startswith(("Failed in", "During:", "-", "File"))]
    reason = (telling or lines or ["numba gave no reason"])[0]
    return " ".join(reason.partition(": %")[0].split())[:300]  # without the machine's own names
