"""The one place that says how functions are compiled.

Import of numba costs more than everything else together, so it happens inside the functions here
and nowhere at import time.
"""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

#: Reassociation is what lets a sum vectorise; `nnan` and `ninf` are left out on purpose: with them
#: `isfinite(1/0)` is True and a NaN in a BRDF goes unseen.
FASTMATH = ("afn", "arcp", "contract", "nsz", "reassoc")


def options(strict: bool = False) -> dict[str, Any]:
    """Compile options; strict=True forbids every floating-point rewrite."""
    return {"error_model": "numpy", "fastmath": False if strict else set(FASTMATH)}


def compiled(function: Callable[..., Any], strict: bool = False) -> Any:
    """`function` as a numba dispatcher with our options (and never numba's own file cache)."""
    import numba

    return numba.njit(**options(strict))(function)
