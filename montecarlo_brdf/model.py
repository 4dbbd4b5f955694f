"""The contract of a BRDF model: what a model file may say, and the object made from it.

A model file needs one function, `f(wo, wi, p)`, the BRDF in 1/sr without the cosine. Everything
else has a default: `Params`, `sample`, `pdf`, `prepare`, `domain`, `choices`, `disclaims`,
`verified`, `lossless`, `limits`, `albedo`, `same_as`, `scales_with`, `isotropic`, `lobe`, `kinks`.
The names and their meaning: docs/models.md.
"""

from __future__ import annotations

import itertools
import math
import types
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from montecarlo_brdf.errors import ModelError, UserError, unknown

Function = Callable[..., Any]

#: What a model may disclaim: a claim of physics that the published model never made.
PROPERTIES = ("energy", "reciprocity", "positivity", "isotropy", "reference", "pdf")


class NoParams(NamedTuple):
    """The parameters of a model that has none."""


@dataclass(frozen=True, eq=False)
class Model:
    """A BRDF with everything that is known about it. Make one with `load`."""

    name: str
    doc: str
    f: Function
    Params: type = NoParams
    sample: Function | None = None
    pdf: Function | None = None
    prepare: Function | None = None
    domain: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    choices: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    disclaims: Mapping[str, str] = field(default_factory=dict)
    verified: tuple[Any, ...] = ()
    lossless: Any = False
    albedo: Function | None = None
    same_as: str | None = None
    scales_with: str | None = None
    isotropic: bool = True
    lobe: Any = None
    kinks: tuple[str, ...] = ()
    limits: tuple[Any, ...] = ()  # (changed parameters, the model that it becomes)
    built_in: bool = False
    picks: Mapping[str, str] = field(default_factory=dict)
    labels: Mapping[str, str] = field(default_factory=dict)  # field -> name, where they differ
    terms: tuple[Any, ...] = ()  # of a mixture
    namespace: Mapping[str, Any] = field(default_factory=dict, repr=False)
    rebuild: Function | None = field(default=None, repr=False)  # picks -> the variant

    def variant(self, **picks: str) -> Model:
        """The same model with other choices; the rest keep their current pick."""
        for category, pick in picks.items():
            if category not in self.choices:
                raise UserError(unknown(f"choice of model {self.name}", category, self.choices))
            if pick not in self.choices[category]:
                raise UserError(unknown(category, pick, self.choices[category]))
        if self.rebuild:
            return self.rebuild({**self.picks, **picks})  # type: ignore[no-any-return]
        return build(self.name, self.namespace, {**self.picks, **picks}, self.built_in)

    def parameters(self, **values: Any) -> Any:
        """A parameter set as a NamedTuple of floats, checked against the domain.

        Choices (`norm="n+8"`) may be given beside numbers. A tuple of numbers makes a colour: one
        channel per number. Raises UserError for an unknown name, or a value that is not a finite
        number of the domain.
        """
        picks = {k: values.pop(k) for k in list(values) if k in self.choices}
        model = self.variant(**picks) if picks else self
        names = model.Params._fields  # type: ignore[attr-defined]
        fields = {model.labels.get(n, n): n for n in names}
        for name in values:
            if name not in fields:
                allowed = (*fields, *self.choices)
                raise UserError(unknown(f"parameter of model {self.name}", name, allowed))
        checked = {fields[n]: model._checked(fields[n], v) for n, v in values.items()}
        defaults = getattr(model.Params, "_field_defaults", {})
        missing = [n for n in names if n not in checked and n not in defaults]
        if missing:
            raise UserError(f"model {self.name} needs a value for {', '.join(missing)}")
        floats = {n: float(v) for n, v in defaults.items()}
        return model.Params(**{**floats, **checked})

    def of(self, p: Any) -> Model:
        """The variant of this model that the parameter set `p` belongs to."""
        picks = getattr(type(p), "picks", self.picks)
        return self if picks == self.picks else self.variant(**picks)

    def prepared(self, p: Any) -> Any:
        """What `f`, `sample` and `pdf` get for the parameter set `p`."""
        return self.prepare(p) if self.prepare else p

    def _checked(self, name: str, value: Any) -> Any:
        if isinstance(value, (tuple, list)):
            return tuple(self._checked(name, v) for v in value)
        low, high = self.domain.get(name, (-math.inf, math.inf))
        allowed = f"a number in [{low:g}, {high:g}]" if name in self.domain else "a finite number"
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if isinstance(value, bool) or not (math.isfinite(number) and low <= number <= high):
            name = self.labels.get(name, name)
            raise UserError(f"{name} of model {self.name} must be {allowed}, not {value!r}")
        return number


def channels(p: Any) -> list[Any]:
    """The parameter sets of a colour, one per channel; a plain set is its own only channel."""
    widths = {len(v) for v in p if isinstance(v, tuple)}
    if len(widths) > 1:
        raise UserError(
            f"colours of one model need the same number of channels, not {sorted(widths)}"
        )
    count = widths.pop() if widths else 1
    return [type(p)(*(v[k] if isinstance(v, tuple) else v for v in p)) for k in range(count)]


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
