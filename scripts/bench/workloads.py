"""What is computed: directional albedos that range from smooth to very sharp."""
from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from montecarlo_brdf import references
from montecarlo_brdf.compile import compiler
from montecarlo_brdf.compile.bind import bound
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model
from montecarlo_brdf.vectors import from_degrees


class Workload(NamedTuple):
    """One albedo of one model."""

    name: str
    model_name: str
    parameters: Mapping[str, float]
    theta_o_deg: float

    @property
    def model(self) -> Model:
        """The model."""
        return load(self.model_name)

    @property
    def p(self) -> Any:
        """Its parameter set."""
        return self.model.parameters(**self.parameters)

    @property
    def title(self) -> str:
        """'ggx alpha=0.3 at 60 degrees'."""
        values = ", ".join(f"{k}={v:g}" for k, v in self.parameters.items())
        return f"{self.model_name} {values} at {self.theta_o_deg:g}°"

    def truth(self) -> float:
        """The reference's value."""
        mu = from_degrees(self.theta_o_deg)[2]
        found = references.albedo(self.model_name, mu, **self.p._asdict(), **self.model.picks)
        assert found is not None
        return found.value


WORKLOADS = (
    Workload("W1", "lambert", {"albedo": 0.8}, 60.0),
    Workload("W2", "oren_nayar", {"albedo": 1.0, "sigma": 0.5}, 60.0),
    Workload("W3", "ggx", {"alpha": 0.3}, 60.0),
    Workload("W4", "ggx", {"alpha": 0.05}, 80.0),
    Workload("W5", "ggx", {"alpha": 0.01}, 85.0),
    Workload("W6", "phong", {"n": 1e5}, 75.0),
    Workload("W7", "ggx", {"alpha": 0.001}, 89.0),
)


class Integrand(NamedTuple):
    """The same integrand, compiled, in the forms that peers take."""

    at: Callable[..., float]  # f cos sin at (theta, phi)
    batch: Callable[..., Any]  # the same on arrays of any shape
    cosine: Callable[..., Any]  # f pi on arrays of numbers (u1, u2): cosine sampling
    loop: Callable[[int], float]  # the plain Monte Carlo loop that most people write


@functools.cache
def integrand(name: str) -> Integrand:
    """The integrand of a workload over theta in [0, pi/2] and phi in [0, pi], doubled."""
    import numpy as np

    work = next(w for w in WORKLOADS if w.name == name)
    model, wo = work.model, from_degrees(work.theta_o_deg)
    p = model.prepared(work.p)
    f = compiler.specialiser(compiler.compiled).bind(bound(model.f))

    def at(theta: float, phi: float) -> float:
        s, c = math.sin(theta), math.cos(theta)
        return 2.0 * f(wo, (s * math.cos(phi), s * math.sin(phi), c), p) * c * s

    one = compiler.compiled(at)

    def batch(theta: Any, phi: Any) -> Any:
        out = np.empty_like(theta)
        for i in range(theta.size):
            out.flat[i] = one(theta.flat[i], phi.flat[i])
        return out

    def cosine(u1: Any, u2: Any) -> Any:
        out = np.empty_like(u1)
        for i in range(u1.size):
            r, phi = math.sqrt(u1[i]), 2.0 * math.pi * u2[i]
            wi = (r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u1[i]))
            out[i] = f(wo, wi, p) * math.pi
        return out

    def loop(n: int) -> float:
        total = 0.0
        for _ in range(n):
            u1, phi = np.random.random(), 2.0 * math.pi * np.random.random()
            r = math.sqrt(u1)
            total += f(wo, (r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u1)), p)
        return total * math.pi / n

    fast = compiler.compiled
    return Integrand(one, fast(batch), fast(cosine), fast(loop))
