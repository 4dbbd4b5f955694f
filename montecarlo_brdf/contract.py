"""What the names of a model file must be, and the Model that they make, choices bound."""

from __future__ import annotations

import functools
import math
import numbers
import types
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.errors import ModelError, unknown
from montecarlo_brdf.model import (
    KINKS,
    PROPERTIES,
    Around,
    Limit,
    Lobe,
    Model,
    NoParams,
    ParameterSet,
    parameter_type,
)
from montecarlo_brdf.models import names

Namespace = Mapping[str, Any]


class Rule(NamedTuple):
    """What a member of a model file must be, as a test and in words, and what a Model keeps."""

    fits: Callable[[Any], bool]
    must: str
    make: Callable[[Any], Any] = lambda value: value


class Parts(NamedTuple):
    """An option of a choice: what it binds, brings, and adds to domain and disclaims."""

    functions: Mapping[str, Callable[..., Any]] = {}
    params: Mapping[str, float] = {}
    domain: Mapping[str, tuple[float, float]] = {}
    disclaims: Mapping[str, str] = {}


def _is(*kinds: type) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, kinds)


def _is_pair(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) == 2


def _is_number(value: Any) -> bool:
    real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    return real and math.isfinite(float(value))


def _is_function_of(count: int) -> Callable[[Any], bool]:
    """Whether something can be called with so many arguments, as far as it tells."""

    def fits(value: Any) -> bool:
        code = getattr(value, "__code__", None)
        return callable(value) and (code is None or code.co_argcount == count)

    return fits


def _are_from(allowed: Iterable[str]) -> Callable[[Any], bool]:
    names = [str(name) for name in allowed]
    return lambda value: all(isinstance(v, str) and v in names for v in value)


def _is_set(value: Any) -> bool:
    """Whether it is a parameter set, as `Params(albedo=1.0)`."""
    return isinstance(value, tuple) and hasattr(value, "_fields") and all(map(_is_number, value))


def _is_limit(value: Any) -> bool:
    if not (_is_pair(value) and isinstance(value[0], Mapping) and isinstance(value[1], str)):
        return False
    return all(isinstance(k, str) and _is_number(v) for k, v in value[0].items())


def _all(test: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, (list, tuple)) and all(map(test, value))


def _kind(value: Any) -> str:
    """'half vector', also of half_vector."""
    return str(value).replace("_", " ")


def _width(function: Callable[[Any], Any], p: Any) -> float:
    """What a lobe's function says. Raises ModelError if that is no number."""
    value = function(p)
    if not _is_number(value):
        raise ModelError(f"the width of a lobe must be a number, not {value!r}")
    return float(value)


def _is_parameters(value: Any) -> bool:
    defaults = getattr(value, "_field_defaults", None)
    named = isinstance(value, type) and issubclass(value, tuple) and defaults is not None
    return named and all(map(_is_default, (defaults or {}).values()))


def _is_default(value: Any) -> bool:
    """A number, or a colour's."""
    return all(isinstance(v, (int, float)) for v in _values(value))


def _values(default: Any) -> tuple[Any, ...]:
    return default if isinstance(default, tuple) else (default,)


DICTIONARY = Rule(_is(Mapping), "a dictionary, not {!r}", dict)
NAME = Rule(_is(str), "a name, not {!r}")
SETS = "parameter sets, as Params(albedo=1.0), not {!r}"
#: The functions of the contract and their arguments.
FUNCTIONS = {"f": "(wo, wi, p)", "sample": "(wo, u, p)", "pdf": "(wo, wi, p)", "prepare": "(p)"}
#: All other members.
MEMBERS = {
    "albedo": Rule(_is_function_of(2), "a function (cos_theta_o, p), not {!r}"),
    "Params": Rule(_is_parameters, "a NamedTuple of numbers"),
    "domain": DICTIONARY,
    "choices": DICTIONARY,
    "disclaims": Rule(
        lambda value: isinstance(value, Mapping) and _are_from(PROPERTIES)(value),
        f"a dictionary from some of {', '.join(PROPERTIES)} to a reason, not {{!r}}",
        dict,
    ),
    "verified": Rule(_all(_is_set), f"a list of {SETS}", tuple),
    "kinks": Rule(
        lambda value: isinstance(value, (list, tuple)) and _are_from(KINKS)(value),
        f"a list of some of {', '.join(KINKS)}, not {{!r}}",
        tuple,
    ),
    "same_as": NAME,
    "scales_with": NAME,
    "single": Rule(
        lambda value: isinstance(value, Mapping) and callable(value.get("f")),
        "a dictionary from f and pdf to functions, not {!r}",
        lambda value: lambda: value,
    ),
    "isotropic": Rule(_is(bool), "True or False, not {!r}"),
    "lossless": Rule(
        lambda value: isinstance(value, bool) or _all(_is_set)(value),
        f"True or a list of {SETS}",
        lambda value: value if isinstance(value, bool) else tuple(value),
    ),
    "limits": Rule(
        _all(_is_limit),
        "a list of (changed parameters, model), as ({{'alpha': 1.0}}, 'lambert'), not {!r}",
        lambda value: tuple(Limit(*pair) for pair in value),
    ),
    "lobe": Rule(
        lambda value: _is_pair(value) and _kind(value[0]) in list(Around) and callable(value[1]),
        f"(kind, function of p), a kind being one of {', '.join(Around)}, not {{!r}}",
        lambda value: Lobe(Around(_kind(value[0])), functools.partial(_width, value[1])),
    ),
}
#: What the parts of an option must be.
PARTS = {
    "functions": Rule(
        lambda value: isinstance(value, Mapping) and all(map(callable, value.values())),
        "a dictionary of functions, not {!r}",
    ),
    "params": Rule(
        lambda value: isinstance(value, Mapping) and all(map(_is_number, value.values())),
        "a dictionary of numbers, not {!r}",
    ),
    "domain": MEMBERS["domain"],
    "disclaims": MEMBERS["disclaims"],
}


def build(
    name: str, namespace: Namespace, picks: Mapping[str, str] = {}, built_in: bool = False
) -> Model:
    """A Model from the names defined in a model file, with one option picked per choice.

    Raises ModelError where a name does not stand for what it must.
    """
    given = _members_of(name, namespace)
    choices = given.get("choices", {})
    picks = {c: picks.get(c, next(iter(options))) for c, options in choices.items()}
    options = [_parts(c, choices[c][pick]) for c, pick in picks.items()]
    bound = _rebound(namespace, {k: v for o in options for k, v in o.functions.items()})
    given |= {k: bound[k] for k in (*FUNCTIONS, "albedo") if k in given}
    given["whole"] = _whole(given.get("Params", NoParams))
    given["Params"] = params = _params_of(given.get("Params", NoParams), options, picks)
    for member in ("domain", "disclaims"):
        added = [getattr(option, member) for option in options]
        given[member] = {k: v for each in (given.get(member, {}), *added) for k, v in each.items()}
    _check_domain(name, given["domain"])
    _check_names(name, given, (*params._fields, *_brought(choices)))
    given["domain"] = {k: v for k, v in given["domain"].items() if k in params._fields}
    _check_defaults(name, params, given["domain"])
    return Model(
        name=name,
        doc=str(namespace.get("__doc__") or ""),
        built_in=built_in,
        picks=picks,
        namespace=namespace,
        rebuild=lambda new: build(name, namespace, new, built_in),
        **given,
    )


def _whole(params: type[ParameterSet]) -> frozenset[str]:
    """Parameters that a file declares as int or bool: counts and switches."""
    kinds = {n: getattr(a, "__forward_arg__", a) for n, a in params.__annotations__.items()}
    return frozenset(n for n, a in kinds.items() if getattr(a, "__name__", a) in ("int", "bool"))


def _is_helper(member: str, value: object) -> bool:
    """Whether a file's own function happens to be called as a member that is none."""
    return isinstance(value, types.FunctionType) and member in MEMBERS and member != "albedo"


def _members_of(name: str, namespace: Namespace) -> dict[str, Any]:
    """The members that a file has. Raises ModelError for one that is not what it must be: the only
    check there is, for built-in files and others."""
    given: dict[str, Any] = {k: namespace.get(k) for k in (*MEMBERS, *FUNCTIONS)}
    given = {k: v for k, v in given.items() if v is not None and not _is_helper(k, v)}
    for member, rule in MEMBERS.items():
        if member in given and not rule.fits(given[member]):
            raise ModelError(f"{member} of model {name} must be {rule.must.format(given[member])}")
    given = {k: MEMBERS[k].make(v) if k in MEMBERS else v for k, v in given.items()}
    for category, options in given.get("choices", {}).items():
        _check_options(name, category, options)
    for member in FUNCTIONS:
        if member == "f" or member in given:
            _check_arguments(name, member, given.get(member))
    return given


def _check_options(name: str, category: str, options: Any) -> None:
    if not isinstance(options, Mapping) or not options:
        raise ModelError(f"choices of model {name} needs a dictionary of options for {category}")
    for pick, option in options.items():
        where = f"{category}={pick} of model {name}"
        if not isinstance(option, Mapping) and not callable(option):
            must = f"a function, or a dictionary with some of {', '.join(PARTS)}"
            raise ModelError(f"{where} must be {must}, not {option!r}")
        parts = option if isinstance(option, Mapping) else {}
        _known("part of an option", where, parts, Parts._fields)
        for part, value in parts.items():
            if not PARTS[part].fits(value):
                raise ModelError(f"{part} of {where} must be {PARTS[part].must.format(value)}")


def _check_arguments(name: str, member: str, value: Any) -> None:
    function, arguments = getattr(value, "py_func", value), FUNCTIONS[member]
    if not isinstance(function, types.FunctionType):
        raise ModelError(f"model {name} needs a function {member}{arguments}")
    if function.__code__.co_argcount != arguments.count(",") + 1:
        raise ModelError(f"{member} of model {name} must take the arguments {arguments}")


def _check_domain(name: str, domain: Mapping[str, Any]) -> None:
    for parameter, ends in domain.items():
        numbers = _is_pair(ends) and all(isinstance(e, (int, float)) for e in ends)
        if not (numbers and ends[0] <= ends[1]):
            raise ModelError(
                f"domain of model {name} must give (low, high) for {parameter}, not {ends!r}"
            )


def _brought(choices: Mapping[str, Any]) -> list[str]:
    """Parameters that any option of any choice brings."""
    options = [o for picks in choices.values() for o in picks.values() if isinstance(o, Mapping)]
    return [name for option in options for name in option.get("params", {})]


def _check_names(name: str, given: Mapping[str, Any], parameters: tuple[str, ...]) -> None:
    """Every parameter and model that a member names is one."""
    lossless = given.get("lossless")
    named = {
        "domain": [*given["domain"]],
        "scales_with": [given["scales_with"]] if "scales_with" in given else [],
        "limits": [n for limit in given.get("limits", ()) for n in limit.changes],
        "verified": [n for p in given.get("verified", ()) for n in p._fields],
        "lossless": [n for p in lossless for n in p._fields] if isinstance(lossless, tuple) else [],
    }
    for member, words in named.items():
        _known(f"parameter of model {name}", member, words, parameters)
    models = {"limits": [limit.model for limit in given.get("limits", ())]}
    models["same_as"] = [given["same_as"]] if "same_as" in given else []
    for member, words in models.items():
        plain = [word for word in words if word.isidentifier()]  # no path, no mixture
        _known("model", f"{member} of model {name}", plain, tuple(names()))


def _check_defaults(name: str, params: type[ParameterSet], domain: Mapping[str, Any]) -> None:
    for parameter, default in params._field_defaults.items():
        low, high = domain.get(parameter, (-math.inf, math.inf))
        for value in (v for v in _values(default) if not low <= v <= high):
            outside = f"{parameter}={value:g} of model {name} lies outside its domain"
            raise ModelError(f"the default {outside} [{low:g}, {high:g}]")


def _known(kind: str, where: str, given: Iterable[str], allowed: tuple[str, ...]) -> None:
    for word in given:
        if word not in allowed:
            raise ModelError(f"{where}: {unknown(kind, word, allowed)}")


def _parts(category: str, option: Any) -> Parts:
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
