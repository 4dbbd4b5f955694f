"""From the names that a model file defines to a Model: what they must be, and choices bound."""

from __future__ import annotations

import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.errors import ModelError, unknown
from montecarlo_brdf.model import (
    Limit,
    Lobe,
    Model,
    NoParams,
    Option,
    ParameterSet,
    parameter_type,
)

Namespace = Mapping[str, Any]


def build(name: str, namespace: Namespace, picks: Mapping[str, str], built_in: bool) -> Model:
    """A Model from the names defined in a model file, with one option picked per choice.

    Raises ModelError where a name does not stand for what it must.
    """
    check(name, namespace)
    choices = namespace.get("choices") or {}
    picks = {c: picks.get(c, next(iter(options))) for c, options in choices.items()}
    options = [_parts(c, choices[c][pick]) for c, pick in picks.items()]
    bound = _rebound(namespace, {k: v for o in options for k, v in o.functions.items()})
    params = _params_of(bound.get("Params") or NoParams, options, picks)
    domain = dict(bound.get("domain") or {})
    disclaims = dict(bound.get("disclaims") or {})
    for option in options:
        domain.update(option.domain)
        disclaims.update(option.disclaims)
    _check_domain(name, domain)
    if not choices:  # of which each brings parameters of its own
        _known(f"parameter of model {name}", "domain", domain, params._fields)
    given = {k: make(bound[k]) for k, make in MADE.items() if bound.get(k) is not None}
    return Model(
        name=name,
        doc=str(namespace.get("__doc__") or ""),
        Params=params,
        domain={k: v for k, v in domain.items() if k in params._fields},
        choices=choices,
        disclaims=disclaims,
        built_in=built_in,
        picks=picks,
        namespace=namespace,
        rebuild=lambda new: build(name, namespace, new, built_in),
        **given,
    )


class Rule(NamedTuple):
    """What a member must be, as a test and as the end of a sentence."""

    fits: Callable[[Any], bool]
    must: str


def _is(*kinds: type) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, kinds)


def _is_parameters(value: Any) -> bool:
    named = isinstance(value, type) and issubclass(value, tuple)
    defaults = getattr(value, "_field_defaults", {"none": None})
    return named and all(isinstance(v, (int, float)) for v in defaults.values())


def _is_lobe(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) == 2 and callable(value[1])


def _is_limits(value: Any) -> bool:
    pairs = isinstance(value, (list, tuple)) and all(
        isinstance(v, (list, tuple)) and len(v) == 2 for v in value
    )
    return pairs and all(isinstance(changes, Mapping) for changes, _ in value)


DICTIONARY = Rule(_is(Mapping), "a dictionary")
LIST = Rule(_is(list, tuple), "a list")
NAME = Rule(_is(str), "a name")
RULES = {
    "domain": DICTIONARY,
    "choices": DICTIONARY,
    "disclaims": DICTIONARY,
    "verified": LIST,
    "kinks": LIST,
    "same_as": NAME,
    "scales_with": NAME,
    "lossless": Rule(_is(bool, list, tuple), "True or a list of parameter sets"),
    "limits": Rule(_is_limits, "a list of (changed parameters, model)"),
    "albedo": Rule(callable, "a function (cos_theta_o, p)"),
    "lobe": Rule(_is_lobe, "(kind, function of p that returns a width)"),
    "Params": Rule(_is_parameters, "a NamedTuple of numbers"),
}
#: The arguments of the functions of the contract.
ARGUMENTS = {"f": "(wo, wi, p)", "sample": "(wo, u, p)", "pdf": "(wo, wi, p)", "prepare": "(p)"}
#: Member -> what a Model keeps of it, where the file has it.
MADE: dict[str, Callable[[Any], Any]] = {
    **dict.fromkeys((*ARGUMENTS, "albedo", "same_as", "scales_with"), lambda value: value),
    "verified": tuple,
    "kinks": tuple,
    "lossless": lambda value: value if isinstance(value, bool) else tuple(value),
    "isotropic": bool,
    "limits": lambda value: tuple(Limit(*pair) for pair in value),
    "lobe": lambda value: Lobe(*value),
}


def check(name: str, namespace: Namespace) -> None:
    """Raise ModelError for a member that is not what it must be: the only check of a model file."""
    for member, rule in RULES.items():
        value = namespace.get(member)
        if value is not None and not rule.fits(value):
            said = "" if member == "Params" else f", not {value!r}"
            raise ModelError(f"{member} of model {name} must be {rule.must}{said}")
    for category, options in (namespace.get("choices") or {}).items():
        _check_options(name, category, options)
    for member, arguments in ARGUMENTS.items():
        if member == "f" or namespace.get(member) is not None:
            _check_arguments(name, member, arguments, namespace.get(member))


def _check_options(name: str, category: str, options: Any) -> None:
    if not isinstance(options, Mapping) or not options:
        raise ModelError(f"choices of model {name} needs a dictionary of options for {category}")
    for pick, option in options.items():
        parts = option if isinstance(option, Mapping) else ()
        _known(f"part of an option of model {name}", f"{category}={pick}", parts, Parts._fields)


def _check_arguments(name: str, member: str, arguments: str, value: Any) -> None:
    function = getattr(value, "py_func", value)  # of what numba has compiled
    if not isinstance(function, types.FunctionType):
        raise ModelError(f"model {name} needs a function {member}{arguments}")
    if function.__code__.co_argcount != arguments.count(",") + 1:
        raise ModelError(f"{member} of model {name} must take the arguments {arguments}")


def _check_domain(name: str, domain: Mapping[str, Any]) -> None:
    """domain maps parameters to (low, high)."""
    for parameter, ends in domain.items():
        pair = isinstance(ends, (list, tuple)) and len(ends) == 2
        if not (pair and all(isinstance(e, (int, float)) for e in ends) and ends[0] <= ends[1]):
            raise ModelError(
                f"domain of model {name} must give (low, high) for {parameter}, not {ends!r}"
            )


def _known(kind: str, where: str, given: Iterable[str], allowed: tuple[str, ...]) -> None:
    for word in given:
        if word not in allowed:
            raise ModelError(f"{where}: {unknown(kind, word, allowed)}")


class Parts(NamedTuple):
    """An option in its long form: what it binds, brings, and adds to domain and disclaims."""

    functions: Mapping[str, Callable[..., Any]] = {}
    params: Mapping[str, float] = {}
    domain: Mapping[str, tuple[float, float]] = {}
    disclaims: Mapping[str, str] = {}


def _parts(category: str, option: Option) -> Parts:
    return Parts(**option) if isinstance(option, Mapping) else Parts({category: option})


def _rebound(namespace: Namespace, names: Mapping[str, Callable[..., Any]]) -> Namespace:
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
    own: type[ParameterSet], options: list[Parts], picks: Mapping[str, str]
) -> type[ParameterSet]:
    """The file's own Params, or for a model with choices a NamedTuple of its and their fields."""
    if not picks:
        return own
    extra = {k: v for option in options for k, v in option.params.items()}
    return parameter_type(
        dict.fromkeys((*own._fields, *extra)), {**own._field_defaults, **extra}, picks
    )


def members(namespace: Namespace) -> Iterator[str]:
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
