"""Mixtures: f = sum of weight_k f_k, any number of models, by name: "0.6 lambert + 0.4 ggx".

Sampling picks one term by u[2], in proportion to the weights, with the full mixture pdf. Parameters
are named after their model, "ggx.alpha"; weights are parameters too, "ggx.weight". That the weights
add up to at most 1 is a claim about the surface, not a condition for evaluating it.
"""

from __future__ import annotations

import math
import re
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.model import Model, ParameterSet, Prepared, Term, parameter_type
from montecarlo_brdf.models._cosine import sample as cosine_sample
from montecarlo_brdf.sampling.warps import pdf_hemisphere_cosine
from montecarlo_brdf.vectors import Vec

Plain = Callable[..., Any]

FIRST: Any = None  # bound to the functions of one term
REST: Any = None  # and to the mixture of the terms after it


class Last(NamedTuple):
    """Prepared parameters of the last term."""

    weight: float
    first: Prepared


class Node(NamedTuple):
    """Prepared parameters of a term and of those after it; `choose` is the chance to sample it."""

    weight: float
    choose: float
    first: Prepared
    rest: Last | Node


def f(wo: Vec, wi: Vec, p: Node) -> float:
    """weight f_1 + the rest."""
    value: float = p.weight * FIRST(wo, wi, p.first) + REST(wo, wi, p.rest)
    return value


def f_last(wo: Vec, wi: Vec, p: Last) -> float:
    """weight f_n."""
    value: float = p.weight * FIRST(wo, wi, p.first)
    return value


def sample(wo: Vec, u: Vec, p: Node) -> Vec:
    """This term with probability `choose`, else one after it; u[2] is stretched to be used
    again."""
    if u[2] < p.choose:
        w = FIRST(wo, (u[0], u[1], u[2] / p.choose), p.first)
        return w[0], w[1], w[2]
    rest: Vec = REST(wo, (u[0], u[1], (u[2] - p.choose) / (1.0 - p.choose)), p.rest)
    return rest


def sample_last(wo: Vec, u: Vec, p: Last) -> Vec:
    """The last term."""
    w = FIRST(wo, u, p.first)
    return w[0], w[1], w[2]


def pdf(wo: Vec, wi: Vec, p: Node) -> float:
    """The density of the whole mixture."""
    density: float = p.choose * FIRST(wo, wi, p.first) + (1.0 - p.choose) * REST(wo, wi, p.rest)
    return density


def pdf_last(wo: Vec, wi: Vec, p: Last) -> float:
    """The density of the last term."""
    density: float = FIRST(wo, wi, p.first)
    return density


def cosine_pdf(wo: Vec, wi: Vec, p: Prepared) -> float:
    """For a term without a sampler."""
    return pdf_hemisphere_cosine(wi)


def parts(spec: str) -> list[tuple[float, str]] | None:
    """[(weight, model), ...] of "0.6 lambert + 0.4 ggx"; None if `spec` is not a mixture."""
    pieces = [piece.strip() for piece in spec.split(" + ")]
    found = [re.fullmatch(r"(?:(\S+)\s+)?(\S+)", piece) for piece in pieces]
    if len(pieces) == 1 and not (found[0] and _is_number(found[0].group(1))):
        return None  # also "my brdf.py", a path with a blank
    if not all(found):
        raise UserError(f'a mixture is written "0.6 lambert + 0.4 ggx", not {spec!r}')
    return [(_weight(m.group(1), spec), m.group(2)) for m in found if m]


def _is_number(text: str | None) -> bool:
    try:
        return text is not None and math.isfinite(float(text))
    except ValueError:
        return False


def _weight(text: str | None, spec: str) -> float:
    try:
        value = 1.0 if text is None else float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value >= 0.0):
        raise UserError(
            f"the weights of a mixture are numbers of at least 0, not {text!r} in {spec!r}"
        )
    return value


def mixture(terms: Sequence[tuple[float, Model]], name: str) -> Model:
    """The weighted sum of models as a model."""
    return _assembled(_named(terms), name)


def _named(terms: Sequence[tuple[float, Model]]) -> tuple[Term, ...]:
    """Terms with distinct prefixes: a model that comes twice is ggx and ggx_2."""
    seen: dict[str, int] = {}
    named = []
    for weight, model in terms:
        stem = re.sub(r"\W", "_", model.identity.removesuffix(".py"))
        seen[stem] = seen.get(stem, 0) + 1
        prefix = stem if seen[stem] == 1 else f"{stem}_{seen[stem]}"
        named.append(Term(prefix, model, weight))
    return tuple(named)


def _assembled(terms: tuple[Term, ...], name: str) -> Model:
    choices = {f"{t.prefix}.{c}": options for t in terms for c, options in t.model.choices.items()}
    picks = {f"{t.prefix}.{c}": pick for t in terms for c, pick in t.model.picks.items()}
    parameters = list(_parameters(terms))
    defaults = {field: default for field, _, default, _ in parameters}
    samplers = [(t.model.sample, t.model.pdf) if t.model.pdf else (None, None) for t in terms]
    return Model(
        name=name,
        doc=f"{name}: a mixture, f = "
        + " + ".join(f"{t.prefix}.weight f_{t.prefix}" for t in terms),
        f=_chain([t.model.f for t in terms], f, f_last),
        Params=parameter_type(defaults, defaults, picks),
        sample=_chain([s or cosine_sample for s, _ in samplers], sample, sample_last),
        pdf=_chain([d or cosine_pdf for _, d in samplers], pdf, pdf_last),
        prepare=lambda p: _prepared(terms, p),
        domain={field: ends for field, _, _, ends in parameters if ends},
        choices=choices,
        whole=frozenset(f"{t.prefix}_{name}" for t in terms for name in t.model.whole),
        disclaims={k: f"{t.prefix}: {v}" for t in terms for k, v in t.model.disclaims.items()},
        isotropic=all(t.model.isotropic for t in terms),
        picks=picks,
        labels={field: name for field, name, _, _ in parameters},
        terms=terms,
        rebuild=lambda new: _assembled(_varied(terms, new), name),
    )


def _varied(terms: tuple[Term, ...], picks: Mapping[str, str]) -> tuple[Term, ...]:
    """The terms with other choices."""

    def own(t: Term) -> dict[str, str]:
        return {c: picks[f"{t.prefix}.{c}"] for c in t.model.choices}

    return tuple(t._replace(model=t.model.variant(**own(t))) for t in terms)


def _chain(functions: Sequence[Plain], link: Plain, last: Plain) -> Plain:
    """The functions of all terms in one: each link binds one and the chain after it."""
    chained = _bound(last, FIRST=functions[-1])
    for function in reversed(functions[:-1]):
        chained = _bound(link, FIRST=function, REST=chained)
    return chained


def _bound(template: Plain, **names: Plain) -> Plain:
    return types.FunctionType(template.__code__, {**globals(), **names}, template.__name__)


def _parameters(terms: tuple[Term, ...]) -> Iterator[tuple[str, str, float, Any]]:
    """(field, name, default, range or None) of the weights, then of each term's parameters."""
    for t in terms:
        yield f"{t.prefix}_weight", f"{t.prefix}.weight", t.weight, (0.0, 1e6)
    for t in terms:
        for name, default in t.model.parameters()._asdict().items():
            yield f"{t.prefix}_{name}", f"{t.prefix}.{name}", default, t.model.domain.get(name)


def _prepared(terms: tuple[Term, ...], p: ParameterSet) -> Last | Node:
    """The chain of prepared parameters, built from its end."""
    weights = [getattr(p, f"{t.prefix}_weight") for t in terms]
    ready = [t.model.prepared(t.parameters_of(p)) for t in terms]
    chain: Last | Node = Last(weights[-1], ready[-1])
    total = weights[-1]
    for weight, first in zip(reversed(weights[:-1]), reversed(ready[:-1]), strict=True):
        total += weight
        chain = Node(weight, weight / total if total > 0.0 else 0.0, first, chain)
    return chain
