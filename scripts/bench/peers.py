"""What one could use instead: each peer as a function from a workload to runs at growing effort.

A run is a function of a seed that returns the albedo; deterministic peers ignore the seed. A peer
that is not installed raises ImportError.
"""
from __future__ import annotations

import functools
import glob
import math
import os
import re
from collections.abc import Callable, Iterator
from typing import Any

from bench.workloads import Workload, integrand

Run = Callable[[int], float]
Runs = Iterator[tuple[str, Run]]

TOLERANCES = tuple(10.0**-k for k in range(2, 12))
SIZES = tuple(1 << k for k in range(10, 21, 2))
HALF_PI = 0.5 * math.pi


def numpy_monte_carlo(work: Workload) -> Runs:
    """numpy.random, cosine sampling."""
    import numpy as np

    cosine = integrand(work.name).cosine

    def run(n: int, seed: int) -> float:
        u = np.random.default_rng(seed).random((2, n))
        return float(cosine(u[0], u[1]).mean())

    yield from ((f"N = {n}", functools.partial(run, n)) for n in SIZES)


def naive_numba(work: Workload) -> Runs:
    """A plain loop with np.random, math.sqrt, math.sin and math.cos under njit."""
    loop = integrand(work.name).loop

    def run(n: int, seed: int) -> float:
        return loop(n)

    yield from ((f"N = {n}", functools.partial(run, n)) for n in SIZES)


def scipy_sobol(work: Workload) -> Runs:
    """scipy.stats.qmc.Sobol with Owen scrambling, cosine sampling."""
    from scipy.stats import qmc

    cosine = integrand(work.name).cosine

    def run(n: int, seed: int) -> float:
        u = qmc.Sobol(2, rng=seed).random(n)
        return float(cosine(u[:, 0].copy(), u[:, 1].copy()).mean())

    yield from ((f"N = {n}", functools.partial(run, n)) for n in SIZES)


def _double(f: Any, e: float, seed: int) -> float:
    from scipy.integrate import dblquad

    return float(dblquad(f, 0.0, math.pi, 0.0, HALF_PI, epsabs=0.0, epsrel=e)[0])


def scipy_dblquad(work: Workload) -> Runs:
    """scipy.integrate.dblquad with a compiled function called through Python."""
    at = integrand(work.name).at
    for e in TOLERANCES:
        yield f"epsrel {e:g}", functools.partial(_double, at, e)


def scipy_dblquad_compiled(work: Workload) -> Runs:
    """scipy.integrate.dblquad with a LowLevelCallable: no Python in the inner loop."""
    import numba
    from scipy import LowLevelCallable

    at = integrand(work.name).at
    signature = numba.float64(numba.intc, numba.types.CPointer(numba.float64))
    call = LowLevelCallable(numba.cfunc(signature)(lambda n, x: at(x[0], x[1])).ctypes)
    for e in TOLERANCES:
        yield f"epsrel {e:g}", functools.partial(_double, call, e)


def scipy_cubature(work: Workload) -> Runs:
    """scipy.integrate.cubature, vectorised, Gauss-Kronrod 21."""
    from scipy.integrate import cubature

    batch = integrand(work.name).batch

    def run(e: float, seed: int) -> float:
        f = lambda x: batch(x[:, 0].copy(), x[:, 1].copy())  # noqa: E731
        found = cubature(f, [0.0, 0.0], [HALF_PI, math.pi], rtol=e, atol=0.0, rule="gk21")
        return float(found.estimate)

    yield from ((f"rtol {e:g}", functools.partial(run, e)) for e in TOLERANCES)


def cubepy_adaptive(work: Workload) -> Runs:
    """cubepy.integrate, vectorised, Genz-Malik."""
    import cubepy
    import numpy as np

    batch = integrand(work.name).batch
    low, high = np.array([0.0, 0.0]), np.array([HALF_PI, math.pi])

    def flat(theta: Any, phi: Any) -> Any:
        return batch(np.ascontiguousarray(theta), np.ascontiguousarray(phi))

    def run(e: float, seed: int) -> float:
        return float(np.ravel(cubepy.integrate(flat, low, high, rtol=e, atol=0.0)[0])[0])

    yield from ((f"rtol {e:g}", functools.partial(run, e)) for e in TOLERANCES)


def vegas_adaptive(work: Workload) -> Runs:
    """vegas: adaptive importance and stratified sampling."""
    import numpy as np
    import vegas

    batch = integrand(work.name).batch
    f = vegas.lbatchintegrand(lambda x: batch(x[:, 0].copy(), x[:, 1].copy()))

    def run(n: int, seed: int) -> float:
        np.random.seed(seed)
        made = vegas.Integrator([[0.0, HALF_PI], [0.0, math.pi]])
        return float(made(f, nitn=10, neval=n // 10).mean)

    yield from ((f"N = {n}", functools.partial(run, n)) for n in SIZES)


def mitsuba_llvm(work: Workload) -> Runs:
    """Mitsuba 3, LLVM variant: its own GGX (separable Smith, float32) and its own sampler."""
    if work.model_name != "ggx":
        raise ImportError("no such BSDF in Mitsuba")
    if not (libraries := llvm_libraries()):
        raise ImportError("no LLVM 17 or later: with 15 and 16 Dr.Jit aborts the process")
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", libraries[-1])
    import drjit as dr
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    alpha = work.parameters["alpha"]
    bsdf = mi.load_dict(
        {"type": "roughconductor", "alpha": alpha, "distribution": "ggx", "material": "none"}
    )

    def run(n: int, seed: int) -> float:
        si = dr.zeros(mi.SurfaceInteraction3f, n)
        theta = math.radians(work.theta_o_deg)
        si.wi = mi.Vector3f(math.sin(theta), 0.0, math.cos(theta))
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, n)
        _, value = bsdf.sample(mi.BSDFContext(), si, sampler.next_1d(), sampler.next_2d())
        return float(dr.mean(mi.Float64(value[0]))[0])

    yield from ((f"N = {n}", functools.partial(run, n)) for n in SIZES)


def llvm_libraries() -> list[str]:
    """Shared libraries of LLVM 17 or later."""
    found = glob.glob("/usr/lib/*/libLLVM*.so*")
    version = {n: re.search(r"LLVM[-.so]*(\d+)", n) for n in found}
    return sorted(n for n, v in version.items() if v and int(v.group(1)) >= 17)


PEERS = {
    "numpy": numpy_monte_carlo,
    "naive numba": naive_numba,
    "scipy Sobol": scipy_sobol,
    "dblquad": scipy_dblquad,
    "dblquad LowLevelCallable": scipy_dblquad_compiled,
    "cubature": scipy_cubature,
    "cubepy": cubepy_adaptive,
    "vegas": vegas_adaptive,
    "mitsuba llvm": mitsuba_llvm,
}
