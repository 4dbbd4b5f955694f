"""A first look at a model by plain Python calls at a few directions, before anything is compiled.

It tells a user's mistake in one sentence, and what sampling can not see by itself: a lobe so
narrow that no sample hits it, and a divergence at the horizon that makes a variance infinite.
"""

from __future__ import annotations

import math
import numbers
from typing import Any

from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.loading import raised
from montecarlo_brdf.model import Model, ParameterSet, Prepared, channels
from montecarlo_brdf.vectors import Vec, from_degrees, mirrored

#: Ordinary directions and numbers: any of them must work for any model.
DIRECTIONS = (from_degrees(20.0, 0.0), from_degrees(50.0, 130.0), from_degrees(70.0, 250.0))
UNIFORMS = (0.3, 0.6, 0.4)


def check(model: Model, p: ParameterSet) -> None:
    """Raise ModelError unless f, sample and pdf return what the contract says."""
    model = model.of(p)
    for one in channels(p):
        ready = called(model, "prepare", model.prepared, one)
        if model.prepare and not _is_prepared(ready):
            must = f"a NamedTuple of numbers, and of tuples and arrays of such, not {_shown(ready)}"
            raise ModelError(f"prepare of model {model.name} must return {must}")
        for wo in DIRECTIONS:
            for wi in DIRECTIONS:
                evaluated(model, "f", wo, wi, ready)
        _check_repeats(model, ready)
        if model.sample:
            evaluated(model, "sample", DIRECTIONS[0], UNIFORMS, ready)
        if model.pdf:
            evaluated(model, "pdf", DIRECTIONS[0], DIRECTIONS[1], ready)
        if model.albedo:
            _number(model, "albedo", called(model, "albedo", model.albedo, 0.5, one))
        if model.lobe:
            called(model, "lobe", model.lobe.width, one)


def _check_repeats(model: Model, ready: Prepared) -> None:
    """A function that gives another value each time would be told as not reciprocal."""
    wo, wi = DIRECTIONS[:2]
    values = [number_from(model, "f", model.f, wo, wi, ready) for _ in range(3)]
    if len({v for v in values if not math.isnan(v)}) > 1:
        told = ", ".join(f"{v:.6g}" for v in values)
        raise ModelError(
            f"f of model {model.name} gives several values for the same directions ({told}): "
            "it may depend on nothing but wo, wi and p"
        )


def evaluated(model: Model, member: str, wo: Vec, other: Vec, ready: Prepared) -> None:
    """Raise ModelError unless f, pdf or sample returns what it must."""
    if member == "sample":
        for value in _drawn(model, ready, wo, other):
            _number(model, member, value)
    else:
        _number(model, member, called(model, member, getattr(model, member), wo, other, ready))


def _is_prepared(value: object, nested: bool = False) -> bool:
    if isinstance(value, tuple):
        return all(_is_prepared(v, nested=True) for v in value)
    return nested and (isinstance(value, numbers.Real) or _is_array(value))


def _is_array(value: object) -> bool:
    """Whether it is a NumPy array of real numbers."""
    kind = getattr(value, "dtype", None)
    return kind is not None and kind.kind in "fiu" and getattr(value, "size", 0) > 0


def _drawn(
    model: Model, ready: Prepared, wo: Vec = DIRECTIONS[0], u: Vec = UNIFORMS
) -> tuple[Any, ...]:
    """One result of `sample`, which the model has."""
    assert model.sample
    drawn = called(model, "sample", model.sample, wo, u, ready)
    if not isinstance(drawn, tuple) or len(drawn) not in (3, 4):
        raise ModelError(
            f"sample of model {model.name} must return (x, y, z) or (x, y, z, weight), "
            f"not {_shown(drawn)}"
        )
    return drawn


def called(model: Model, member: str, function: Function, *arguments: Any) -> Any:
    """The result, NaN where Python raises what compiled arithmetic does not."""
    try:
        value = function(*arguments)
        return math.nan if isinstance(value, complex) else value  # a power of a negative number
    except (ZeroDivisionError, OverflowError):
        return math.nan
    except ModelError:  # of a lobe: a sentence already
        raise
    except (Exception, SystemExit) as error:
        if "math domain error" in str(error):
            return math.nan
        file = model.namespace.get("__file__", "")
        few = member == "sample" and isinstance(error, IndexError)
        told = " (u has 3 numbers: u[0], u[1], u[2])" if few else ""
        raise ModelError(f"{member} of model {model.name} {raised(error, file)}{told}") from error


def _number(model: Model, member: str, value: object) -> None:
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        raise ModelError(
            f"{member} of model {model.name} must return a number, not {_shown(value)}"
        )


def _shown(value: object) -> str:
    kind = "None" if value is None else f"a value of type {type(value).__name__}"
    return f"{kind} of length {len(value)}" if isinstance(value, (tuple, list)) else kind


def returns_weight(model: Model) -> bool:
    """Whether `sample` returns its weight f cos / pdf as a fourth number."""
    if model.sample is None:
        return False
    defaults = model.verified[0] if model.verified else model.parameters()
    ready = model.prepared(channels(defaults)[0])
    return len(_drawn(model, ready)) == 4


def highest(model: Model, ready: Prepared, wo: Vec) -> tuple[float, float]:
    """The largest f and the largest f cos at the mirror direction, at wo, and 64 directions in the
    plane of incidence.

    An estimate whose total weight is not well above this value may have missed a lobe.
    """
    around = [from_degrees(89.5 * k / 32.0, 180.0 * half) for k in range(32) for half in (0, 1)]
    values = [(_value(model, wo, wi, ready), wi[2]) for wi in (mirrored(wo), wo, *around)]
    found = [(v, v * mu) for v, mu in values if math.isfinite(v)]
    return max((v for v, _ in found), default=0.0), max((v for _, v in found), default=0.0)


def horizon_exponent(model: Model, ready: Prepared, wo: Vec) -> float:
    """The s in f ~ mu_i^-s as wi nears the horizon, the largest over 16 azimuths.

    The m-th moment of f cos/pdf is finite under pdf ~ mu_i^c iff m (s - 1 + c) < 1 + c.
    """
    worst = 0.0
    for k in range(16):
        near, nearer = (_at_cosine(mu, 2.0 * math.pi * k / 16.0) for mu in (1e-6, 1e-8))
        a, b = _value(model, wo, near, ready), _value(model, wo, nearer, ready)
        if a > 0.0 and b > a and math.isfinite(b):
            worst = max(worst, math.log(b / a) / math.log(100.0))
    return worst


def _at_cosine(mu: float, phi: float) -> Vec:
    s = math.sqrt(1.0 - mu * mu)
    return s * math.cos(phi), s * math.sin(phi), mu


def _value(model: Model, wo: Vec, wi: Vec, ready: Prepared) -> float:
    return number_from(model, "f", model.f, wo, wi, ready)


def number_from(model: Model, member: str, function: Function, *arguments: Any) -> float:
    """What a function of a model returns, NaN where that is no number."""
    value = called(model, member, function, *arguments)
    return float(value) if isinstance(value, numbers.Real) else math.nan
