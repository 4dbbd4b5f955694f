"""What GLSL's functions are in single precision: those of `runtime`, with every number a float32
and every operation rounded as a shader's is."""

from __future__ import annotations

import types

from numpy import float32

from montecarlo_brdf.foreign import runtime

__all__ = runtime.__all__  # noqa: PLE0605

STRICT = True  # compiled without any rewriting


def _functions() -> dict[str, object]:
    """The same code, which finds float32 where it asks for F."""
    names = {n: v for n, v in vars(runtime).items() if not n.startswith("__")}
    names |= {"F": float32, "STRICT": STRICT, "__name__": __name__}
    names |= {"INF": float32(runtime.INF), "NAN": float32(runtime.NAN), "LARGE": float32(1 << 23)}
    for name, value in list(names.items()):
        if isinstance(value, types.FunctionType) and value.__module__ == runtime.__name__:
            names[name] = types.FunctionType(value.__code__, names, name)
    return names


globals().update(_functions())
