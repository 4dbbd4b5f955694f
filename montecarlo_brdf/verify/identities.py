"""Identities of the hemisphere that everything else rests on, each estimated like any other number.

What a constant 1, a power of the cosine, a Lambert surface and a light that is not constant must
integrate to. Sources: Nicodemus et al. 1977 (reflectance); Pharr, Jakob, Humphreys, 4e, 4.1.
"""
from __future__ import annotations

import functools
import math
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.plan import Plan, Progress
from montecarlo_brdf.estimate.quantity import Quantity, integrand
from montecarlo_brdf.estimate.samplers import Subject
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Kind, MeanClaim, Reference
from montecarlo_brdf.judge.finding import Bound, Command, Report, Result
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import NORMAL, Vec, from_degrees
from montecarlo_brdf.verify.question import SAMPLES, Settings, decided, reported

NAME = Command.IDENTITIES
#: irradiance of the light 1 + 2 cos(theta): pi a + 2 pi b / 3 with a = 1, b = 2
IRRADIANCE = math.pi + 4.0 * math.pi / 3.0


def identities(
    *, points: str = "sobol", samples: int = SAMPLES, seed: int = 0, threads: int | None = None,
    tolerance: float | None = None, progress: Progress | None = None,
) -> Report:  # fmt: skip
    """The identities of the hemisphere, each estimated and judged.

    points: "sobol", "independent", "stratified" or "lattice". samples: the most that an identity
    may take, 1 to 2^40. seed: 0 to 2^64 - 1. threads: 1 to 1024, None for all processors; no result
    depends on it. tolerance: relative, in [0, 1); None for 1e-4. progress: is called with the
    fraction done.

    Returns a Report with one Result. Raises UserError for a bad value.
    """
    settings = Settings.of(points, samples, seed, threads, tolerance)
    started = time.perf_counter()
    found = list(claims(AGREEMENT_TOLERANCE if tolerance is None else tolerance))
    findings = decided(found, settings.plan, {}, count=len(found), progress=progress)
    told = {"tolerance": tolerance, **settings.told()}
    return reported(NAME, told, [Result("", {}, NAME, findings)], started)


class Power(NamedTuple):
    """Of `cosine_power`."""

    n: float = 0.0


class Albedo(NamedTuple):
    """Of Lambert's surface."""

    albedo: float = 0.8


def cosine_power(w: Vec, p: Power) -> float:
    """cos(theta)^n for whole n."""
    value = 1.0
    for _ in range(int(p.n)):
        value *= w[2]
    return value


def lambert(wo: Vec, wi: Vec, p: Albedo) -> float:
    """Lambert's BRDF."""
    return p.albedo / math.pi


def lit_lambert(wo: Vec, wi: Vec, p: Albedo) -> float:
    """Lambert's BRDF times the light 1 + 2 cos(theta_i)."""
    return p.albedo / math.pi * (1.0 + 2.0 * wi[2])


def lit_share(wo: Vec, wi: Vec, p: Albedo) -> float:
    """The same per irradiance, so that its flux is Phi_out / Phi_in."""
    return p.albedo * (1.0 + 2.0 * wi[2]) / IRRADIANCE


class Identity(NamedTuple):
    """A number with its exact value and how it is estimated."""

    quantity: str
    function: Callable[..., float]
    p: Power | Albedo
    of: Quantity
    sampler: Sampler
    exact: float
    why: str
    where: dict[str, Any] = {}
    fixed: Vec = NORMAL
    bound: Bound = Bound.EQUAL


def listed() -> Iterator[Identity]:
    """All identities."""
    uniform = Quantity.HEMISPHERE, Sampler.UNIFORM
    cosine = Quantity.HEMISPHERE, Sampler.COSINE
    yield Identity("int dw", cosine_power, Power(0.0), *uniform, 2.0 * math.pi, "solid angle")
    projected = "projected hemisphere"
    yield Identity("int cos dw", cosine_power, Power(1.0), *uniform, math.pi, projected)
    for n in (2, 5, 20):
        exact = 2.0 * math.pi / (n + 1)
        yield Identity(f"int cos^{n} dw", cosine_power, Power(n), *uniform, exact, "2 pi/(n + 1)")
    yield Identity("area of the unit disk", cosine_power, Power(1.0), *cosine, math.pi, "its lift")
    for theta in (0.0, 45.0, 85.0):
        yield Identity(
            "L_o of Lambert under L = 1 + 2 cos", lit_lambert, Albedo(), Quantity.ALBEDO,
            Sampler.UNIFORM, 0.8 / math.pi * IRRADIANCE, "the same from every direction",
            {"theta_o_deg": theta}, from_degrees(theta),
        )  # fmt: skip
    yield Identity(
        "Phi_out/Phi_in under L = 1 + 2 cos", lit_share, Albedo(), Quantity.BIHEMISPHERICAL,
        Sampler.UNIFORM, 0.8, "the albedo under any light",
    )  # fmt: skip
    yield Identity(
        "A of f = C_d = 1/pi", lambert, Albedo(1.0), Quantity.ALBEDO, Sampler.UNIFORM, 1.0,
        "the largest constant BRDF: C_d <= 1/pi", bound=Bound.AT_MOST,
    )  # fmt: skip


def claims(tolerance: float) -> Iterator[MeanClaim]:
    """One claim per identity; tolerance: relative."""
    for identity in listed():
        yield MeanClaim(
            identity.quantity, identity.where, identity.bound,
            Reference(identity.exact, 0.0, Kind.CLOSED_FORM, identity.why),
            tolerance * identity.exact, functools.partial(_measure, identity),
        )  # fmt: skip


def _measure(identity: Identity, plan: Plan) -> list[Measurement]:
    subject = Subject(NAME, (NAME, identity.quantity), [identity.p])
    mean = integrand(identity.of, identity.sampler, {"F": identity.function})
    row = evaluate(subject, identity.fixed, [mean], plan, (NAME,))[0]
    return [Measurement(identity.sampler, row[0])]
