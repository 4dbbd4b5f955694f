"""From the names that a model file defines to a Model: choices bound, the contract checked."""

from __future__ import annotations

import itertools
import math
import types
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.errors import ModelError, unknown
from montecarlo_brdf.model import Model, NoParams


def build(
    name: str, namespace: Mapping[str, Any], picks: Mapping[str, str], built_in: bool
) -> Model:
    """A Model from the names defined in a model file, with one option picked per choice."""
    choices = namespace.get("choices", {})
    picks = {c: picks.get(c, next(iter(options))) for c, options in choices.items()}
    options = [_option(c, choices[c][pick]) for c, pick in picks.items()]
    bound = _rebound(namespace, {k: v for o in options for k, v in o["functions"].items()})
    _check_params(name, bound.get("Params", NoParams))
    params = _params_of(bound, options, picks)
    domain = dict(bound.get("domain", {}))
    disclaims = dict(bound.get("disclaims", {}))
    for option in options:
        domain.update(option["domain"])
        disclaims.update(option["disclaims"])
    _check_arguments(name, bound)
    _check_domain(name, domain)
    if not choices:  # of which each brings parameters of its own
        _check_known(name, domain, params)
    optional = ("sample", "pdf", "prepare", "albedo", "same_as", "scales_with", "lobe")
    given: dict[str, Any] = {k: bound.get(k) for k in optional}
    return Model(
        name=name,
        doc=str(namespace.get("__doc__") or ""),
        f=bound["f"],
        Params=params,
        domain={k: v for k, v in domain.items() if k in params._fields},  # type: ignore[attr-defined]
        choices=choices,
        disclaims=disclaims,
        verified=tuple(bound.get("verified", ())),
        lossless=bound.get("lossless", False),
        isotropic=bool(bound.get("isotropic", True)),
        kinks=tuple(bound.get("kinks", ())),
        limits=tuple(bound.get("limits", ())),
        built_in=built_in,
        picks=picks,
        namespace=namespace,
        rebuild=lambda new: build(name, namespace, new, built_in),
        **given,
    )


def _option(category: str, option: Any) -> dict[str, Any]:
    """An option in its long form: functions to bind, parameters that it brings, their domain."""
    if not isinstance(option, Mapping):
        option = {"functions": {category: option}}
    return {"functions": {}, "params": {}, "domain": {}, "disclaims": {}, **option}


def _rebound(namespace: Mapping[str, Any], names: Mapping[str, Any]) -> Mapping[str, Any]:
    """A copy of a module in which `names` stand for the functions picked, in every function."""
    if not names:
        return namespace
    copy = {**namespace, **names}
    for key, value in list(copy.items()):
        if isinstance(value, types.FunctionType) and value.__globals__ is namespace:
            copy[key] = types.FunctionType(
                value.__code__, copy, value.__name__, value.__defaults__, value.__closure__
            )
    return copy


def _params_of(
    bound: Mapping[str, Any], options: list[dict[str, Any]], picks: Mapping[str, str]
) -> type:
    """The file's own Params, or for a model with choices a NamedTuple of its and their fields."""
    own = bound.get("Params", NoParams)
    if not picks:
        return own
    extra = dict(itertools.chain.from_iterable(o["params"].items() for o in options))
    fields = [(n, float) for n in (*own._fields, *(e for e in extra if e not in own._fields))]
    made = NamedTuple("Params", fields)  # type: ignore[misc]
    defaults = {**own._field_defaults, **extra}
    made.__new__.__defaults__ = tuple(float(defaults[n]) for n, _ in fields)
    made._field_defaults = {n: float(defaults[n]) for n, _ in fields}
    made.picks = dict(picks)  # type: ignore[attr-defined]
    return made


def _check_params(name: str, params: Any) -> None:
    """Params is a NamedTuple of numbers."""
    fields = getattr(params, "_fields", None)
    defaults = getattr(params, "_field_defaults", {})
    numbers = all(isinstance(v, (int, float)) for v in defaults.values())
    if not isinstance(params, type) or fields is None or not numbers:
        raise ModelError(f"Params of model {name} must be a NamedTuple of numbers")


def _check_domain(name: str, domain: Mapping[str, Any]) -> None:
    """domain maps a name to (low, high)."""
    for field_name, bounds in domain.items():
        try:
            low, high = map(float, bounds)
        except (TypeError, ValueError):
            low, high = math.nan, math.nan
        if not low <= high:
            raise ModelError(
                f"domain of model {name} must give {field_name} as (low, high), not {bounds!r}"
            )


def _check_known(name: str, domain: Mapping[str, Any], params: Any) -> None:
    """domain names parameters only."""
    for field_name in domain:
        if field_name not in params._fields:
            problem = unknown(f"parameter of model {name}", field_name, params._fields)
            raise ModelError(f"domain: {problem}")


def _check_arguments(name: str, bound: Mapping[str, Any]) -> None:
    """Every function of the contract takes the arguments that the contract says."""
    contract = {"f": "(wo, wi, p)", "sample": "(wo, u, p)", "pdf": "(wo, wi, p)", "prepare": "(p)"}
    for member, arguments in contract.items():
        function = getattr(bound.get(member), "py_func", bound.get(member))
        if function is None and member != "f":
            continue
        if not isinstance(function, types.FunctionType):
            raise ModelError(f"model {name} needs a function {member}{arguments}")
        if function.__code__.co_argcount != arguments.count(",") + 1:
            raise ModelError(f"{member} of model {name} must take the arguments {arguments}")


def members(namespace: Mapping[str, Any]) -> Iterator[str]:
    """Names in a file that could be a model: its own functions (wo, wi, p) and classes with f."""
    for key, value in namespace.items():
        own = getattr(value, "__module__", None) == namespace.get("__name__")
        if own and not key.startswith("_") and _could_be_model(key, value):
            yield key


def _could_be_model(key: str, value: Any) -> bool:
    if isinstance(value, type):
        return hasattr(value, "f")
    part_of_another = key.endswith(("_sample", "_pdf")) or key in ("sample", "pdf")
    three = isinstance(value, types.FunctionType) and value.__code__.co_argcount == 3
    return three and not part_of_another
