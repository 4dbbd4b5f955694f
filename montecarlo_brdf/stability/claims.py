"""What a precision must keep of a model: its digits, its sign, unit directions, finite weights."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Limit, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Model, Property
from montecarlo_brdf.stability.sampling import LENGTH_ROUNDINGS, UNUSABLE, Draws
from montecarlo_brdf.stability.stress import Found, Loss

#: Constants of a source are doubles: long double cannot be better.
DOUBLE = 2.0**-52
SEARCH = "search"
#: what must not become of f, and how it is called
BROKEN = {"nan": "NaN", "inf": "Inf", "negative": "negative"}


def claims(model: Model, loss: Loss) -> Iterator[Claim]:
    """The claims of one precision; each evaluates to what was measured."""
    own = loss.worst.own if loss.worst else 0.0
    yield _at_most("error of f", loss, own, loss.tolerance, *_shown(model, loss, loss.worst))
    kinds = dict(BROKEN)
    if Property.POSITIVITY in model.disclaims:
        del kinds["negative"]
    first = next((loss.first[k] for k in kinds if k in loss.first), None)
    broken = float(sum(loss.counts[k] for k in kinds))
    quantity = f"f is {', '.join(kinds.values())}"
    yield _at_most(quantity, loss, broken, 0.0, *_shown(model, loss, first))
    if loss.safe:
        yield _safe(loss, *loss.safe)
    if loss.draws:
        yield from _draws(loss, loss.draws)


def _at_most(
    quantity: str, loss: Loss, value: float, most: float, example: str | None,
    reproduce: str | None = None,
) -> ExactClaim:  # fmt: skip
    found = Exact(value, points=loss.points, example=example, reproduce=reproduce)
    return ExactClaim(
        quantity, {"precision": loss.precision}, Bound.AT_MOST, Reference(0.0, 0.0), most,
        lambda: found, property=None, estimator=SEARCH,
    )  # fmt: skip


def _shown(model: Model, loss: Loss, found: Found | None) -> tuple[str | None, str | None]:
    """What was found and the command that shows it again."""
    if found is None:
        return None, None
    values = f"{loss.precision} gives {found.value:.9g}, the truth is {found.truth:.9g}"
    return values, reproduction(model, loss.precision, found)


def reproduction(model: Model, precision: str, found: Found) -> str:
    """The command that evaluates this one point in every precision."""
    numbers = {n: repr(float(v)) for n, v in zip(found.p._fields, found.p, strict=True)}
    assignments = "".join(f" -p {n}={v}" for n, v in {**numbers, **model.picks}.items())
    point = ",".join(repr(float(x)) for x in (*found.wo, *found.wi))
    subject = f"--model {model.name}{assignments} --precision {precision}"
    return f"brdf-check stress {subject} --at {point}"


def _safe(loss: Loss, name: str, value: float) -> Limit:
    """From which value of the sharpness parameter on all errors are tolerable."""
    quantity = "largest safe n" if name == "n" else f"smallest safe {name}"
    note = "none is safe" if math.isnan(value) else None
    return Limit(quantity, {"precision": loss.precision}, value, loss.points, SEARCH, note)


def _draws(loss: Loss, draws: Draws) -> Iterator[ExactClaim]:
    limit = LENGTH_ROUNDINGS * max(loss.eps, DOUBLE)
    example = _drawn(draws.where.get("length"))
    yield _at_most("length of a sample - 1", loss, draws.length, limit, example)
    bad = sum(draws.counts.values())
    place = next((draws.where[k] for k in UNUSABLE if k in draws.where), None)
    quantity = "samples NaN, of pdf 0, of infinite weight"
    yield _at_most(quantity, loss, float(bad), 0.0, _drawn(place))


def _drawn(place: dict[str, Any] | None) -> str | None:
    if place is None:
        return None
    p = ", ".join(f"{n}={v:g}" for n, v in place["p"].items())
    return f"wo = {tuple(place['wo'])}, u = {tuple(place['u'])}" + (f", {p}" if p else "")
