"""A surface: lobes with a weight and parameters per channel, f_c = sum of weight_c f(params_c).

Lobes come from `model` and parameters, or from a list of lobes; a model that is a mixture is taken
apart into its terms, so that each can be planned for itself.
"""

from __future__ import annotations

import dis
import functools
import types
from typing import NamedTuple

from montecarlo_brdf.model import Model, ParameterSet, channels
from montecarlo_brdf.scene.colour import Colour, spread

Parameters = ParameterSet


class Lobe(NamedTuple):
    """One model of a surface; weights and parameter sets have one entry per channel."""

    name: str
    weights: Colour
    model: Model
    sets: tuple[Parameters, ...]


class Surface(NamedTuple):
    """All lobes."""

    lobes: tuple[Lobe, ...]

    @property
    def isotropic(self) -> bool:
        """Whether turning about the normal changes nothing."""
        return all(lobe.model.isotropic for lobe in self.lobes)

    @property
    def constant(self) -> bool:
        """Whether f is the same for every pair of directions."""
        return all(ignores_directions(lobe.model) for lobe in self.lobes)


def lobes_of(model: Model, p: ParameterSet, weights: Colour, count: int) -> list[Lobe]:
    """The lobes of a model with a parameter set (colours allowed), spread over `count` channels."""
    sets = spread(tuple(channels(p)), count)
    model = model.of(p)
    if not model.terms:
        return [Lobe(model.identity, weights, model, sets)]
    found = []
    for term in model.terms:
        own = [getattr(s, f"{term.prefix}_weight") for s in sets]
        shares = tuple(w * share for w, share in zip(weights, own, strict=True))
        found.append(Lobe(term.prefix, shares, term.model, tuple(map(term.parameters_of, sets))))
    return found


def ignores_directions(model: Model) -> bool:
    """Whether f never looks at wo and wi: then it is a constant, proven by its code."""
    return _ignores_first_two(getattr(model.f, "py_func", model.f).__code__)


@functools.lru_cache(maxsize=256)
def _ignores_first_two(code: types.CodeType) -> bool:
    """Whether a function never loads its first two arguments; asked for every lobe of a plan."""
    directions = set(code.co_varnames[:2])
    loads = {
        i.argval
        for i in dis.get_instructions(code)
        if i.opname.startswith(("LOAD_FAST", "LOAD_DEREF"))
    }
    used = {name for v in loads for name in (v if isinstance(v, tuple) else (v,))}
    return not (used & directions) and not code.co_cellvars
