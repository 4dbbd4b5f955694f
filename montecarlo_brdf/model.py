"""The contract of a BRDF model: what a model file may say, and the object made from it.

A model file needs one function, `f(wo, wi, p)`, the BRDF in 1/sr without the cosine. Everything
else has a default: `Params`, `sample`, `pdf`, `prepare`, `domain`, `choices`, `disclaims`,
`verified`, `lossless`, `limits`, `albedo`, `same_as`, `scales_with`, `isotropic`, `lobe`, `kinks`.
The names and their meaning: docs/models.md.
"""

from __future__ import annotations

import math
import re
from collections import namedtuple
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple, cast

from montecarlo_brdf.compile.layout import Numbers
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.vectors import Vec

#: A NamedTuple of numbers, or of tuples of numbers: a colour, one number per channel.
ParameterSet = NamedTuple
#: The last argument of f, sample and pdf: what `prepare` makes of a parameter set, or the set
#: itself. Its type is the model's own.
Prepared = Numbers
#: f and pdf, both in 1/sr: (wo, wi, p) -> number.
Function = Callable[[Vec, Vec, Prepared], float]
#: (wo, three uniform numbers, p) -> (x, y, z) or (x, y, z, weight).
Sampler = Callable[[Vec, Vec, Prepared], tuple[float, ...]]
#: What a choice offers: a function, or a mapping with functions, params, domain and disclaims.
Option = Callable[..., Any] | Mapping[str, Mapping[str, Any]]


class Property(StrEnum):
    """What a model may disclaim: a claim of physics that the published model never made."""

    ENERGY = "energy"
    RECIPROCITY = "reciprocity"
    POSITIVITY = "positivity"
    ISOTROPY = "isotropy"
    REFERENCE = "reference"
    PDF = "pdf"


PROPERTIES = tuple(Property)
#: what a parameter that is whole may be called
SWITCHES = {"false": 0.0, "true": 1.0}
#: where f may not be smooth
KINKS = ("mu_i=mu_o", "cos_phi=0")


class NoParams(NamedTuple):
    """The parameters of a model that has none."""


class Around(StrEnum):
    """Where a model's lobe sits."""

    MIRROR = "mirror"
    HALF_VECTOR = "half vector"


class Lobe(NamedTuple):
    """Where a model's lobe sits, and how wide it is: a GGX width."""

    around: Around
    width: Callable[[Any], float]


class Limit(NamedTuple):
    """Parameters to change, and the name of the model that this one becomes."""

    changes: Mapping[str, float]
    model: str


class Term(NamedTuple):
    """One model of a mixture; its parameters are the mixture's fields that start with `prefix`."""

    prefix: str
    model: Model
    weight: float

    def parameters_of(self, p: ParameterSet) -> ParameterSet:
        """The term's own parameter set within the mixture's."""
        return self.model.Params._make(getattr(p, f) for f in self.fields())

    def fields(self) -> list[str]:
        """The mixture's fields that are this term's parameters, in its own order."""
        return [f"{self.prefix}_{n}" for n in self.model.Params._fields]


@dataclass(frozen=True, eq=False)
class Model:
    """A BRDF with everything that is known about it. Make one with `load`."""

    name: str
    doc: str
    f: Function
    Params: type[ParameterSet] = NoParams
    sample: Sampler | None = None
    pdf: Function | None = None
    prepare: Callable[[Any], Prepared] | None = None
    domain: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    choices: Mapping[str, Mapping[str, Option]] = field(default_factory=dict)
    disclaims: Mapping[str, str] = field(default_factory=dict)
    verified: tuple[ParameterSet, ...] = ()
    whole: frozenset[str] = frozenset()  # parameters that are counts or switches
    lossless: bool | tuple[ParameterSet, ...] = False  # True: whatever the parameters
    albedo: Callable[[float, Any], float] | None = None  # of cos(theta_o) and a parameter set
    same_as: str | None = None
    scales_with: str | None = None
    isotropic: bool = True
    lobe: Lobe | None = None
    kinks: tuple[str, ...] = ()
    limits: tuple[Limit, ...] = ()
    built_in: bool = False
    picks: Mapping[str, str] = field(default_factory=dict)
    labels: Mapping[str, str] = field(default_factory=dict)  # field -> name, where they differ
    terms: tuple[Term, ...] = ()  # of a mixture
    single: Callable[[], Mapping[str, Function]] | None = field(default=None, repr=False)
    namespace: Mapping[str, Any] = field(default_factory=dict, repr=False)
    rebuild: Callable[[Mapping[str, str]], Model] | None = field(default=None, repr=False)

    @property
    def identity(self) -> str:
        """The name without folders: what is drawn for a file does not depend on where it lies."""
        if not self.terms:
            return self.name if self.built_in else re.split(r"[/\\]|^merl:", self.name)[-1]
        name = self.name
        for one in sorted((t.model for t in self.terms), key=lambda m: -len(m.name)):
            name = name.replace(one.name, one.identity)  # longest first: b/a/x.py holds a/x.py
        return name

    def variant(self, **picks: str) -> Model:
        """The same model with other choices; the rest keep their current pick.

        picks: an option per choice, as norm="n+8". Raises UserError for a name that is not offered.
        """
        for category, pick in picks.items():
            if category not in self.choices:
                raise UserError(unknown(f"choice of model {self.name}", category, self.choices))
            if pick not in self.choices[category]:
                options = self.choices[category]
                raise UserError(unknown(category, pick, options), about=category)
        return self.rebuild({**self.picks, **picks}) if self.rebuild else self

    def parameters(self, **values: Any) -> Any:
        """A parameter set as a NamedTuple of floats, checked against the domain.

        values: numbers by name; a tuple of numbers makes a colour, one channel per number. Choices
        (`norm="n+8"`) may be given beside them. Raises UserError for an unknown name, or a value
        that is not a finite number of the domain.
        """
        picks = {k: values.pop(k) for k in list(values) if k in self.choices}
        model = self.variant(**picks) if picks else self
        names = model.Params._fields
        fields = {model.labels.get(n, n): n for n in names}
        for name in values:
            if name not in fields:
                allowed = (*fields, *self.choices)
                raise UserError(unknown(f"parameter of model {self.name}", name, allowed))
        checked = {fields[n]: model._checked(fields[n], v) for n, v in values.items()}
        defaults = model.Params._field_defaults
        missing = [n for n in names if n not in checked and n not in defaults]
        if missing:
            raise UserError(f"model {self.name} needs a value for {', '.join(missing)}")
        floats = {n: _floats(v) for n, v in defaults.items()}
        values = {**floats, **checked}
        return model.Params._make(values[n] for n in names)

    def of(self, p: ParameterSet) -> Model:
        """The variant of this model that a parameter set belongs to.

        p: from `parameters`. Raises UserError if its choices are not this model's.
        """
        picks = getattr(type(p), "picks", self.picks)
        return self if picks == self.picks else self.variant(**picks)

    def prepared(self, p: ParameterSet) -> Prepared:
        """What `f`, `sample` and `pdf` get for a parameter set.

        p: from `parameters`, of one channel. Raises what the model's own `prepare` raises.
        """
        return self.prepare(p) if self.prepare else p

    def _checked(self, name: str, value: Any) -> Any:
        if isinstance(value, (tuple, list)):
            return tuple(self._checked(name, v) for v in value)
        low, high = self.domain.get(name, (-math.inf, math.inf))
        whole = name in self.whole
        try:
            number = float(SWITCHES.get(str(value).lower(), value) if whole else value)
        except (TypeError, ValueError):
            number = math.nan
        fits = math.isfinite(number) and low <= number <= high
        if not fits or (number % 1.0 != 0.0 if whole else isinstance(value, bool)):
            allowed = "a whole number" if whole else "a number"
            allowed += f" in [{low:g}, {high:g}]" if name in self.domain else ""
            allowed = "a finite number" if allowed == "a number" else allowed
            name = self.labels.get(name, name)
            sentence = f"{name} of model {self.name} must be {allowed}, not {value!r}"
            raise UserError(sentence, about=name)
        return number


def _floats(value: Any) -> Any:
    return tuple(map(float, value)) if isinstance(value, tuple) else float(value)


def parameter_type(
    fields: Iterable[str], defaults: Mapping[str, float], picks: Mapping[str, str]
) -> type[ParameterSet]:
    """A NamedTuple of floats that knows to which variant of its model it belongs."""
    made = cast(Any, namedtuple("Params", fields, defaults=map(_floats, defaults.values())))  # type: ignore
    made.picks = dict(picks)
    return cast(type[ParameterSet], made)


def channels(p: ParameterSet) -> list[Any]:
    """The parameter sets of a colour, one per channel; a plain set is its own only channel."""
    widths = {len(v) for v in p if isinstance(v, tuple)}
    if len(widths) > 1:
        raise UserError(
            f"colours of one model need the same number of channels, not {sorted(widths)}"
        )
    count = widths.pop() if widths else 1
    return [p._make(v[k] if isinstance(v, tuple) else v for v in p) for k in range(count)]
