"""White furnace: how much of a constant light 1 is reflected, and is that what theory says?

Two claims per angle: A(wo) equals its reference (or, without one, the estimators agree with each
other), and A(wo) is at most 1. Estimated by uniform, cosine and the model's own sampler; those unfit
for a case are listed and not used. It cannot see: errors that a constant light averages out, and a
non-reciprocal model's R(wi) > 1.
"""
from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from typing import Any

from montecarlo_brdf import references
from montecarlo_brdf.checks import fitness
from montecarlo_brdf.checks.claim import (
    AGREEMENT_TOLERANCE,
    BOUND_TOLERANCE,
    Measurement,
    MeanClaim,
    Reference,
)
from montecarlo_brdf.integration.estimators import Plan, estimates, integrand_name, samplers_of
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.vectors import from_degrees

NAME = "furnace"


def claims(
    model: Model,
    p: Any,
    theta_o_deg: Sequence[float],
    phi_o_deg: float = 0.0,
    samplers: Sequence[str] | None = None,
    tolerance: float | None = None,
) -> Iterator[MeanClaim]:
    """The claims of the furnace test, two per angle and channel."""
    model = model.of(p)
    many = channels(p)
    for theta in theta_o_deg:
        measure = functools.cache(functools.partial(_measure, model, p, theta, phi_o_deg, samplers))
        for k, one in enumerate(many):
            where: dict[str, Any] = {"theta_o_deg": theta}
            where |= {"phi_o_deg": phi_o_deg} if phi_o_deg else {}
            where |= {"channel": k} if len(many) > 1 else {}
            truth = reference(model, one, theta, phi_o_deg)
            channel = functools.partial(_channel, measure, k)
            yield agreement(model, one, where, truth, tolerance, channel)
            yield MeanClaim(
                "A <= 1",
                where,
                "at most",
                Reference(1.0, 0.0, "bound", "energy conservation"),
                BOUND_TOLERANCE if tolerance is None else tolerance,
                channel,
                property="energy",
                unit=_units(model, one),
            )


def agreement(
    model: Model, one: Any, where: Any, truth: Reference | None, tolerance: float | None, measure: Any
) -> MeanClaim:
    """A equals its reference, or the estimators agree with each other."""
    scale = abs(truth.value) if truth else 1.0
    allowed = (AGREEMENT_TOLERANCE if tolerance is None else tolerance) * scale
    return MeanClaim("A", where, "equal", truth, allowed, measure, unit=_units(model, one))


def reference(model: Model, one: Any, theta_deg: float, phi_deg: float = 0.0) -> Reference | None:
    """The expected A: what the file declares, or our own reference for a built-in model."""
    mu = from_degrees(theta_deg)[2]
    if model.albedo:
        value = float(model.albedo(mu, one))
        return Reference(value, 0.0, "declared", f"albedo() of {model.name}")
    if model.terms:
        return _sum([(_weight(one, t), reference(t.model, t.parameters_of(one), theta_deg, phi_deg)) for t in model.terms])
    if not model.built_in:
        return None
    turned = {} if model.isotropic else {"phi_o": phi_deg * 0.017453292519943295}
    truth = references.albedo(model.name, mu, **one._asdict(), **model.picks, **turned)
    return Reference(*truth) if truth else None


def _weight(p: Any, term: Any) -> float:
    return float(getattr(p, f"{term.prefix}_weight"))


def _sum(parts: list[tuple[float, Reference | None]]) -> Reference | None:
    """The reference of a mixture: albedo is linear in f."""
    known = [(w, r) for w, r in parts if r is not None]
    if len(known) < len(parts):
        return None
    kinds = {r.kind for _, r in known}
    return Reference(
        sum(w * r.value for w, r in known),
        sum(w * r.error for w, r in known) + 1e-15,
        "closed form" if kinds == {"closed form"} else "independent",
        " + ".join(dict.fromkeys(r.source for _, r in known)),
    )


def curves(model: Model, p: Any, last: float, phi_deg: float) -> list[list[tuple[float, float]]]:
    """The reference at every degree up to `last`, per channel; nothing where there is none."""
    angles = [*(float(t) for t in range(90) if t < last), last]
    found = []
    for one in channels(p):
        truths = [(t, reference(model, one, t, phi_deg)) for t in angles]
        found.append([(t, truth.value) for t, truth in truths if truth])
    return [curve for curve in found if curve]


def _units(model: Model, one: Any) -> dict[str, float]:
    """What a hint may compare A with: the parameter that the model scales with."""
    names = [model.scales_with] if model.scales_with else list(one._fields)
    return {n: getattr(one, n) for n in names if getattr(one, n)}


def _channel(measure: Any, k: int, plan: Plan) -> list[Measurement]:
    return measure(plan)[k]


def _measure(
    model: Model, p: Any, theta: float, phi: float, samplers: Sequence[str] | None, plan: Plan
) -> list[list[Measurement]]:
    """All estimators of A in one pass over the points, per channel."""
    wo = from_degrees(theta, phi)
    chosen = [s for s in samplers_of(model) if samplers is None or s in samplers]
    names = [integrand_name(model, "albedo", s) for s in chosen]
    blind = [s for s in chosen if s in fitness.SCALE]
    if model.sample and model.pdf:
        names += [f"second_{s}" for s in blind]
    rows = estimates(model, p, wo, names, plan, (NAME,))
    result = []
    for row, one in zip(rows, channels(p), strict=True):
        sight = fitness.look(model, model.prepared(one), wo)
        seconds = dict(zip(blind, row[len(chosen) :]))
        result.append(
            [
                Measurement(s, e, fitness.reason_unfit(s, e, sight, seconds.get(s)))
                for s, e in zip(chosen, row)
            ]
        )
    return result
