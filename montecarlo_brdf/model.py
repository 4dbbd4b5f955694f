"""The contract of a BRDF model: what a model file may say, and the object made from it.

A model file needs one function, `f(wo, wi, p)`, the BRDF in 1/sr without the cosine. Everything
else has a default: `Params`, `sample`, `pdf`, `prepare`, `domain`, `choices`, `disclaims`,
`verified`, `lossless`, `limits`, `albedo`, `same_as`, `scales_with`, `isotropic`, `lobe`, `kinks`.
The names and their meaning: docs/models.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError, unknown

Function = Callable[..., Any]


class Property(StrEnum):
    """What a model may disclaim: a claim of physics that the published model never made."""

    ENERGY = "energy"
    RECIPROCITY = "reciprocity"
    POSITIVITY = "positivity"
    ISOTROPY = "isotropy"
    REFERENCE = "reference"
    PDF = "pdf"


PROPERTIES = tuple(Property)


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
        """The same model with other choices; the rest keep their current pick.

        picks: an option per choice, as norm="n+8". Raises UserError for a name that is not offered.
        """
        for category, pick in picks.items():
            if category not in self.choices:
                raise UserError(unknown(f"choice of model {self.name}", category, self.choices))
            if pick not in self.choices[category]:
                raise UserError(unknown(category, pick, self.choices[category]))
        return self.rebuild({**self.picks, **picks}) if self.rebuild else self

    def parameters(self, **values: Any) -> Any:
        """A parameter set as a NamedTuple of floats, checked against the domain.

        values: numbers by name; a tuple of numbers makes a colour, one channel per number. Choices
        (`norm="n+8"`) may be given beside them. Raises UserError for an unknown name, or a value
        that is not a finite number of the domain.
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
        """The variant of this model that a parameter set belongs to.

        p: from `parameters`. Raises UserError if its choices are not this model's.
        """
        picks = getattr(type(p), "picks", self.picks)
        return self if picks == self.picks else self.variant(**picks)

    def prepared(self, p: Any) -> Any:
        """What `f`, `sample` and `pdf` get for a parameter set.

        p: from `parameters`, of one channel. Raises what the model's own `prepare` raises.
        """
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
