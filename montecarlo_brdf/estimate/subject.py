"""What is integrated."""

from __future__ import annotations

from typing import Any, NamedTuple

from montecarlo_brdf.model import Model, ParameterSet, Prepared, channels


class Subject(NamedTuple):
    """What is integrated: a name for its streams, and K parameter sets."""

    identity: tuple[str, ...]
    sets: list[Prepared]


def subject_of(model: Model, p: ParameterSet) -> Subject:
    """A model with one parameter set, colours channel by channel."""
    return Subject(identity_of(model, p), [model.prepared(c) for c in channels(p)])


def identity_of(model: Model, p: ParameterSet) -> tuple[str, ...]:
    """What tells a case's stream from others."""
    return (model.name, *model.picks.values(), *map(repr, p))


def functions_of(model: Model) -> dict[str, Any]:
    """The functions that a model has, by the names under which integrands call them."""
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    return {k: v for k, v in bound.items() if v is not None}
