"""What a check is asked about: a model, a parameter set, and where to look."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.model import Model, ParameterSet, channels
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.vectors import Vec, from_degrees

if TYPE_CHECKING:
    import numpy as np


Parameters = ParameterSet


class Case(NamedTuple):
    """One model with one parameter set (which may be a colour)."""

    model: Model
    p: Parameters
    theta_o_deg: Sequence[float]
    phi_o_deg: float = 0.0
    samplers: Sequence[str] | None = None
    tolerance: float | None = None  # instead of each claim's own
    free: tuple[str, ...] = ()  # parameters that a worst-case search may vary
    against: Model | None = None  # a model that it must equal
    seed: int = 0
    effort: float = 1.0  # in (0, 1], see `budget`
    viewer: Vec | None = None  # the viewer's direction exactly, instead of from its angles

    def budget(self, most: int, least: int = 1) -> int:
        """How many of `most` pairs, places, nodes, draws or parameter sets are looked at: all at
        effort 1, else their share, and `least` at least."""
        return most if self.effort == 1.0 else min(most, max(least, math.ceil(self.effort * most)))

    @property
    def sets(self) -> list[Parameters]:
        """One parameter set per channel."""
        return channels(self.p)

    @property
    def one(self) -> Parameters:
        """The parameter set of the first channel."""
        return self.sets[0]

    def wo(self, theta_deg: float) -> Vec:
        """The viewer's direction at a polar angle."""
        return self.viewer or from_degrees(theta_deg, self.phi_o_deg)

    def random(self, *names: object) -> np.random.Generator:
        """A NumPy generator for a purpose, from the seed and what it is for."""
        import numpy as np

        return np.random.default_rng(stream(self.seed, self.model.identity, *names))

    def tolerated(self, default: float) -> float:
        """The tolerance asked for, or the claim's own."""
        return default if self.tolerance is None else self.tolerance

    def where(self, **places: float) -> dict[str, Any]:
        """A place as findings give it, with the azimuth where it is not 0."""
        turned = {"phi_o_deg": self.phi_o_deg} if self.phi_o_deg else {}
        return {**places, **turned}


@functools.lru_cache(maxsize=64)
def pointwise(model: Model, p: Parameters) -> Pointwise:
    """The model's functions on arrays; one per parameter set."""
    return Pointwise(model, p)


def searched(model: Model, fixed: Mapping[str, object]) -> tuple[str, ...]:
    """Parameters that a worst-case search may vary: those nobody fixed and whose range is known.

    Weights of a mixture have no range: the sum of them is what its author chose.
    """
    weights = {f"{t.prefix}_weight" for t in model.terms}
    names = [n for n in model.Params._fields if n not in weights]  # type: ignore[attr-defined]
    asked = [n for n in names if not {n, model.labels.get(n, n)} & set(fixed)]
    return tuple(n for n in asked if search_range(model, n) is not None)


def search_range(model: Model, name: str) -> tuple[float, float] | None:
    """The range of a parameter over the sets the model is verified for, else its whole domain if
    that has ends. Sets that say the same again say nothing of a range."""
    if len(model.verified) == 1 or len(set(model.verified)) > 1:
        values = [float(getattr(p, name)) for p in model.verified if hasattr(p, name)]
        return (min(values), max(values)) if values and min(values) < max(values) else None
    ends = model.domain.get(name)
    return ends if ends and all(map(math.isfinite, ends)) else None
