"""Radiance of many surface points at once: the kernel of pictures.

A point has a frame in the world (tangent, bitangent, normal) and a view direction in that frame.
The integrands are those of `scene.integrands`; only the sky is turned into each point's frame.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile.bind import Ints, Out, Reals, bound, hole
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import Numbers, Unpack, pack
from montecarlo_brdf.estimate.plan import Progress
from montecarlo_brdf.estimate.samplers import members_of
from montecarlo_brdf.sampling import points as point_sets
from montecarlo_brdf.sampling.points import replicate_key
from montecarlo_brdf.scene import integrands, skies
from montecarlo_brdf.scene.plan import Method, Work
from montecarlo_brdf.scene.radiance import Lit, method_name
from montecarlo_brdf.vectors import Vec, dot

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

POINTS: Any = hole()
INTEGRAND: Any = hole()
PARAMETERS: Any = hole()
INNER: Callable[..., Any] = hole()
CHANNELS: Any = hole()
PLACE = 12  # numbers per point: view, tangent, bitangent, normal
CHUNK = 2048  # points per call: progress, threads, Ctrl-C


class Placed(NamedTuple):
    """A sky with the frame it is seen from."""

    sky: Numbers
    tangent: Vec
    bitangent: Vec
    normal: Vec


def world(w: Vec, q: Placed) -> Vec:
    """A direction of the frame in the world."""
    t, b, n = q.tangent, q.bitangent, q.normal
    return (
        w[0] * t[0] + w[1] * b[0] + w[2] * n[0],
        w[0] * t[1] + w[1] * b[1] + w[2] * n[1],
        w[0] * t[2] + w[1] * b[2] + w[2] * n[2],
    )


def placed_value(w: Vec, q: Placed) -> float:
    """The sky's radiance or pdf in a direction of the frame."""
    value: float = INNER(world(w, q), q.sky)
    return value


def placed_sample(u1: float, u2: float, q: Placed) -> Vec:
    """A direction drawn from the sky, in the frame."""
    w = INNER(u1, u2, q.sky)
    return dot(w, q.tangent), dot(w, q.bitangent), dot(w, q.normal)


def pixels(ints: Ints, reals: Reals, out: Out) -> None:
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


def kernel_of(work: Work) -> tuple[Kernel, list[float]]:
    """The kernel of a planned work, and its parameters' numbers."""
    model, sky = work.model, skies.FUNCTIONS[type(work.sets[0][1])]
    names = {**members_of(model), "SKY": bound(placed_value, INNER=sky.radiance)}
    if sky.sample:
        names["SKY_SAMPLE"] = bound(placed_sample, INNER=sky.sample)
        names["SKY_PDF"] = bound(placed_value, INNER=sky.pdf)
    else:
        names |= {"SKY_SAMPLE": integrands.cosine_sample, "SKY_PDF": integrands.cosine_pdf}
    name = Method.COSINE if work.method is Method.ONE_VALUE else method_name(work)
    layout, numbers = pack([Lit(model.prepared(p), s) for p, s in work.sets], 0)
    made = kernel(
        model.name,
        pixels,
        POINTS=point_sets.sobol,
        INTEGRAND=bound(integrands.BY_METHOD[name], **names),
        PARAMETERS=Unpack(layout),
        CHANNELS=len(layout.places),
    )
    return made, numbers


def means(
    work: Work,
    places: Array,
    samples: int,
    key: int,
    threads: int,
    progress: Progress | None = None,
) -> tuple[Array, Array]:
    """Mean and its standard error per point and parameter set, for places (n, PLACE)."""
    import numpy as np

    call, numbers = kernel_of(work)
    starts = range(0, len(places), CHUNK)

    def one(start: int) -> Array:
        part = places[start : start + CHUNK]
        reals = np.concatenate([numbers, part.ravel()]).astype(np.float64)
        out = np.empty((len(part), len(work.sets), 2))
        call.on([len(part), len(numbers), samples, key >> 1, start], reals, out)
        if progress:
            progress(min(1.0, (start + CHUNK) / len(places)))
        return out

    with ThreadPoolExecutor(threads) as pool:
        found = np.concatenate(list(pool.map(one, starts)))
    spread = np.maximum(0.0, found[:, :, 1] - found[:, :, 0] ** 2)
    return found[:, :, 0], np.sqrt(spread / samples)
