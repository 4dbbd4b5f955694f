"""Another model to compare with, under the names that this one's parameters have.

Written "ggx_anisotropic(alpha_x=ax, alpha_y=ay)": their parameter, then ours or a number. Without
it parameters of equal names belong together; one of ours that theirs lacks would be compared with
nothing and is refused.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model, ParameterSet, parameter_type

SPEC = re.compile(r"(?P<name>[^()]+)\((?P<pairs>[^()]*)\)")
#: their parameter -> ours, or a number
Mapped = Mapping[str, str | float]


def counterpart(spec: str, model: Model, given: Collection[str] = ()) -> Model:
    """The model `spec` as a function of the parameters of `model`.

    given: parameters whose values somebody chose, which theirs may lack. Raises UserError for what
    is unknown, and for parameters of ours without a counterpart.
    """
    match = SPEC.fullmatch(spec.strip())
    if not match:
        other = load(spec)
        _check_all(model, other, {}, given)
        return other
    other = load(match["name"].strip())
    return renamed(other, model, _pairs(match["pairs"]), given)


def renamed(other: Model, model: Model, mapped: Mapped, given: Collection[str] = ()) -> Model:
    """`other` with some of its parameters under our names, or at a number."""
    ours, theirs = named(model), named(other)
    for their, our in mapped.items():
        if their not in theirs:
            raise UserError(unknown(f"parameter of model {other.name}", their, theirs))
        if isinstance(our, str) and our not in ours:
            raise UserError(unknown(f"parameter of model {model.name}", our, ours))
    _check_all(model, other, mapped, given)
    fixed = {theirs[n]: v for n, v in mapped.items() if not isinstance(v, str)}
    names = {theirs[n]: ours[v] for n, v in mapped.items() if isinstance(v, str)}
    names = {n: names.get(n, n) for n in other.Params._fields if n not in fixed}
    defaults = {names[n]: v for n, v in other.Params._field_defaults.items() if n in names}

    def original(p: ParameterSet) -> ParameterSet:
        values = {**fixed, **{n: getattr(p, name) for n, name in names.items()}}
        return other.Params._make(values[n] for n in other.Params._fields)

    said = ", ".join(f"{k}={v}" for k, v in mapped.items())
    width = other.lobe.width if other.lobe else lambda p: 0.0  # never called
    lobe = other.lobe and other.lobe._replace(width=lambda p: width(original(p)))
    return Model(
        f"{other.name}({said})", other.doc, other.f, sample=other.sample, pdf=other.pdf,
        prepare=lambda p: other.prepared(original(p)), lobe=lobe, kinks=other.kinks,
        Params=parameter_type(names.values(), defaults, other.picks), isotropic=other.isotropic,
        domain={names[n]: ends for n, ends in other.domain.items() if n in names},
        whole=frozenset(names[n] for n in other.whole if n in names),
        picks=other.picks, namespace=other.namespace,
    )  # fmt: skip


def named(model: Model) -> dict[str, str]:
    """The fields of a model's parameters by the names that they go by."""
    return {model.labels.get(n, n): n for n in model.Params._fields}


def _check_all(model: Model, other: Model, mapped: Mapped, given: Collection[str]) -> None:
    known = {*mapped.values(), *(n for n in named(other) if n not in mapped)}
    alone = [n for n in named(model) if n not in known and n not in given]
    if alone:
        free = [n for n in named(other) if n not in {*mapped, *named(model)}] or [*named(other)]
        example = f'"{other.name}({free[0] if free else "name"}={alone[0]})"'
        raise UserError(
            f"{', '.join(alone)} of model {model.name} has no counterpart in {other.name} "
            f"({', '.join(named(other)) or 'no parameters'}): write {example}, or fix it by -p"
        )


def _pairs(text: str) -> dict[str, str | float]:
    found: dict[str, str | float] = {}
    for pair in filter(None, (part.strip() for part in text.split(","))):
        their, equals, our = (word.strip() for word in pair.partition("="))
        if not equals or not their or not our:
            raise UserError(f'a counterpart is written "ggx(alpha=roughness)", not {pair!r}')
        found[their] = _value(our)
    return found


def _value(word: str) -> str | float:
    try:
        value = float(word)
    except ValueError:
        return word
    return value if math.isfinite(value) else word
