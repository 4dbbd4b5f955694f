"""What the ladder of precisions found, as findings."""

from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf.judge.finding import Finding, Result
from montecarlo_brdf.stability.climb import Found
from montecarlo_brdf.stability.sampling import LENGTH_ROUNDINGS
from montecarlo_brdf.stability.stress import Outcome

#: Precisions that a model is held to unless it is asked for others by name.
PROMISED = ("float32", "float64")
#: Constants of a source are doubles: long double cannot be better.
DOUBLE = 2.0**-52
UNASKED = "measured, not promised: --precision {} makes it a claim"


def result(model: Any, outcomes: list[Outcome], promised: tuple[str, ...]) -> Result:
    """The findings of all precisions of one model; its curves are the heat maps."""
    findings = [f for o in outcomes for f in _findings(model, o, o.precision in promised)]
    heat: list[Any] = [o.heat for o in outcomes]
    return Result(model.name, dict(model.picks), "stability", findings, heat)


def _findings(model: Any, o: Outcome, promised: bool) -> list[Finding]:
    where = {"precision": o.precision}
    note = None if promised else UNASKED.format(o.precision)

    def at_most(
        quantity: str, value: float, limit: float, reason: str | None, repro: str | None
    ) -> Finding:
        held = value <= limit
        verdict = "pass" if held else ("fail" if promised else "known")
        said = None if held else "; ".join(s for s in (reason, note) if s)
        return Finding(
            quantity, where, verdict, "at most", value, 0.0, 0.0, limit,
            samples=o.points, estimator="search", note=said, reproduce=None if held else repro,
        )  # fmt: skip

    found = [at_most("error of f", _own(o), o.tolerance, *_worst(model, o, o.worst))]
    kinds = {"nan": "NaN", "inf": "Inf", "negative": "negative"}
    if "positivity" in model.disclaims:
        del kinds["negative"]
    broken = sum(o.counts[k] for k in kinds)
    first = next((o.first[k] for k in kinds if k in o.first), None)
    quantity = f"f is {', '.join(kinds.values())}"
    found.append(at_most(quantity, float(broken), 0.0, *_worst(model, o, first)))
    if o.safe:
        found.append(_safe(o, where))
    if o.draws:
        d = o.draws
        limit = LENGTH_ROUNDINGS * max(o.eps, DOUBLE)
        found.append(
            at_most("length of a sample - 1", d.length, limit, _drawn(d.where.get("length")), None)
        )
        bad = d.nan + d.unreachable + d.weightless
        place = next(
            (d.where[k] for k in ("nan", "unreachable", "weightless") if k in d.where), None
        )
        found.append(
            at_most(
                "samples NaN, of pdf 0, of infinite weight", float(bad), 0.0, _drawn(place), None
            )
        )
    return found


def _own(o: Outcome) -> float:
    return o.worst.own if o.worst else 0.0


def _safe(o: Outcome, where: dict[str, Any]) -> Finding:
    name, value = o.safe or ("", math.nan)
    none = "none is safe" if math.isnan(value) else None
    return Finding(f"smallest safe {name}" if name != "n" else "largest safe n", where,
                   "pass" if none is None else "known", value=value, stderr=0.0,
                   samples=o.points, estimator="search", note=none)  # fmt: skip


def _worst(model: Any, o: Outcome, found: Found | None) -> tuple[str | None, str | None]:
    """What was found and the command that shows it again."""
    if found is None:
        return None, None
    values = f"{o.precision} gives {found.value:.9g}, the truth is {found.truth:.9g}"
    return values, reproduction(model, o.precision, found)


def reproduction(model: Any, precision: str, found: Found) -> str:
    """The command that evaluates this one point in every precision."""
    numbers = {n: repr(float(v)) for n, v in zip(found.p._fields, found.p, strict=True)}
    assignments = "".join(f" -p {n}={v}" for n, v in {**numbers, **model.picks}.items())
    point = ",".join(repr(float(x)) for x in (*found.wo, *found.wi))
    return (
        f"brdf-check stress --model {model.name}{assignments} --precision {precision} --at {point}"
    )


def _drawn(place: dict[str, Any] | None) -> str | None:
    if place is None:
        return None
    p = ", ".join(f"{n}={v:g}" for n, v in place["p"].items())
    return f"wo = {tuple(place['wo'])}, u = {tuple(place['u'])}" + (f", {p}" if p else "")
