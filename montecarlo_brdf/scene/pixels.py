"""Radiance of many surface points at once: the kernel of pictures.

A point has a frame in the world (tangent, bitangent, normal) and a view direction in that frame.
The integrands are those of `scene.integrands`; only the sky is turned into each point's frame.
"""

from __future__ import annotations

import functools
import types
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile import kernel
from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.kernel import compiled
from montecarlo_brdf.compile.layout import Layout, pack, unpacker
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate.subject import functions_of
from montecarlo_brdf.sampling import points as point_sets
from montecarlo_brdf.sampling.points import replicate_key
from montecarlo_brdf.scene import integrands, skies
from montecarlo_brdf.scene.radiance import Lit, weighted
from montecarlo_brdf.vectors import Vec, dot

POINTS: Any = None
INTEGRAND: Any = None
PARAMETERS: Any = None
INNER: Any = None
CHANNELS = 1
PLACE = 12  # numbers per point: view, tangent, bitangent, normal
CHUNK = 2048  # points per call: progress, threads, Ctrl-C


class Placed(NamedTuple):
    """A sky with the frame it is seen from."""

    sky: Any
    tangent: Vec
    bitangent: Vec
    normal: Vec


def world(w: Vec, q: Any) -> Vec:
    """A direction of the frame in the world."""
    t, b, n = q.tangent, q.bitangent, q.normal
    return (
        w[0] * t[0] + w[1] * b[0] + w[2] * n[0],
        w[0] * t[1] + w[1] * b[1] + w[2] * n[1],
        w[0] * t[2] + w[1] * b[2] + w[2] * n[2],
    )


def placed_value(w: Vec, q: Any) -> float:
    """The sky's radiance or pdf in a direction of the frame."""
    return INNER(world(w, q), q.sky)


def placed_sample(u1: float, u2: float, q: Any) -> Vec:
    """A direction drawn from the sky, in the frame."""
    w = INNER(u1, u2, q.sky)
    return dot(w, q.tangent), dot(w, q.bitangent), dot(w, q.normal)


def pixels(ints: Any, reals: Any, out: Any) -> None:
    """out[2 (j CHANNELS + k)] = mean and, next to it, mean square over `samples` at point j.

    ints = (points, place of the first in reals, samples, key, index of the first).
    """
    p = PARAMETERS(reals)
    for j in range(ints[0]):
        a = ints[1] + 12 * j
        wo = (reals[a], reals[a + 1], reals[a + 2])
        t = (reals[a + 3], reals[a + 4], reals[a + 5])
        b = (reals[a + 6], reals[a + 7], reals[a + 8])
        n = (reals[a + 9], reals[a + 10], reals[a + 11])
        key = replicate_key(u64(ints[3]), ints[4] + j)
        for k in range(CHANNELS):
            q = Lit(p[k].model, Placed(p[k].sky, t, b, n))
            total = 0.0
            squares = 0.0
            for i in range(ints[2]):
                x = INTEGRAND(POINTS(key, u64(i)), wo, q)
                total += x
                squares += x * x
            out[2 * (j * CHANNELS + k)] = total / ints[2]
            out[2 * (j * CHANNELS + k) + 1] = squares / ints[2]


class Recipe(NamedTuple):
    """All that a kernel of pixels is made of."""

    integrand: Callable[..., Any]
    functions: Mapping[str, Any]
    layout: Layout

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        content = kernel.fingerprint(self.layout)
        content.add(point_sets.sobol)
        content.add(self.integrand, self.functions)
        content.add(pixels)
        return content.hexdigest()

    def parts(self) -> Hashable:
        """Integrand, functions and layout."""
        return self.integrand, frozenset(self.functions.items()), self.layout

    def assemble(self, special: Specialiser) -> Callable[..., Any]:
        """The template with everything bound."""
        bound = {
            "POINTS": point_sets.sobol,
            "INTEGRAND": special.bind(self.integrand, self.functions),
            "PARAMETERS": unpacker(self.layout),
            "CHANNELS": len(self.layout.places),
        }
        return special.clone(pixels, bound)


def recipe_of(work: Any) -> tuple[Recipe, list[float]]:
    """The kernel of a planned work, and its parameters' numbers."""
    model, sky = work.model, skies.FUNCTIONS[type(work.sets[0][1])]
    functions = {**functions_of(model), "SKY": _bound(placed_value, sky.radiance)}
    if sky.sample:
        functions["SKY_SAMPLE"] = _bound(placed_sample, sky.sample)
        functions["SKY_PDF"] = _bound(placed_value, sky.pdf)
    else:
        functions |= {"SKY_SAMPLE": integrands.cosine_sample, "SKY_PDF": integrands.cosine_pdf}
    name = "weighted" if work.method == "own" and weighted(model) else work.method
    name = "cosine" if name == "one value" else name
    layout, numbers = pack([Lit(model.prepared(p), s) for p, s in work.sets], 0)
    return Recipe(getattr(integrands, name), functions, layout), numbers


@functools.cache
def _bound(template: Any, inner: Any) -> Any:
    scope = {**globals(), "INNER": inner}
    return types.FunctionType(template.__code__, scope, template.__name__)


def means(
    work: Any, places: Any, samples: int, key: int, threads: int, progress: Any = None
) -> tuple[Any, Any]:
    """Mean and its standard error per point and parameter set, for places (n, PLACE)."""
    import numpy as np

    recipe, numbers = recipe_of(work)
    kernel = compiled(work.model.name, recipe)
    starts = range(0, len(places), CHUNK)

    def one(start: int) -> Any:
        part = places[start : start + CHUNK]
        reals = np.concatenate([numbers, part.ravel()]).astype(np.float64)
        ints = np.array([len(part), len(numbers), samples, key >> 1, start], dtype=np.int64)
        out = np.empty((len(part), len(work.sets), 2))
        if kernel(ints.ctypes.data, reals.ctypes.data, out.ctypes.data) != 0:
            raise ModelError(f"model {work.model.name} raised an exception while it was sampled")
        if progress:
            progress(min(1.0, (start + CHUNK) / len(places)))
        return out

    with ThreadPoolExecutor(threads) as pool:
        found = np.concatenate(list(pool.map(one, starts)))
    spread = np.maximum(0.0, found[:, :, 1] - found[:, :, 0] ** 2)
    return found[:, :, 0], np.sqrt(spread / samples)
