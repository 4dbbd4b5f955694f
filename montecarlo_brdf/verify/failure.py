"""Where a model's code raises. Machine code tells no more than that it did: plain Python says what
and where, at the parameters that were asked and directions of all kinds."""

from __future__ import annotations

import contextlib
import itertools
import random
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.errors import ModelError, Raised
from montecarlo_brdf.estimate import probe
from montecarlo_brdf.model import Model, ParameterSet, channels
from montecarlo_brdf.sampling.warps import random_hemisphere
from montecarlo_brdf.vectors import Vec, from_degrees, mirrored

if TYPE_CHECKING:
    from montecarlo_brdf.scene.surface import Lobe

PATIENCE = 2.0  # seconds of looking
RANDOM = 2000  # pairs of directions, beside the chosen ones
POLAR = (0.0, 20.0, 45.0, 60.0, 75.0, 80.0, 85.0, 89.0, 89.5, 89.9, 89.999, 89.999999)
AZIMUTHS = (0.0, 180.0, 90.0, 37.0, 250.0)
#: the second argument of every function
NAMES = {"f": "wi", "pdf": "wi", "sample": "u"}
#: numbers of a sampler at the ends of their range and inside
ENDS = (0.0, 1.0 - 2.0**-53, 0.5, 2.0**-53)


@contextlib.contextmanager
def located(
    model: Model, sets: Callable[[], Iterable[ParameterSet]], theta_o_deg: Sequence[float] = ()
) -> Iterator[None]:
    """If the model raises in a block, say what it raises and where: a ModelError."""
    try:
        yield
    except Raised as error:
        raise found(model, sets(), theta_o_deg) or error from error


def of_case(case: Case) -> contextlib.AbstractContextManager[None]:
    """The same for a case and the parameters that its searches look at."""

    def sets() -> Iterator[ParameterSet]:
        return itertools.chain(parameters.sets(case), parameters.extremes(case))

    return located(case.model, sets, case.theta_o_deg)


@contextlib.contextmanager
def of_lobes(lobes: Iterable[Lobe]) -> Iterator[None]:
    """The same for the lobes of a surface."""
    with contextlib.ExitStack() as all_of_them:
        for lobe in lobes:
            all_of_them.enter_context(located(lobe.model, lambda lobe=lobe: lobe.sets))  # type: ignore[misc]
        yield


def found(
    model: Model, sets: Iterable[ParameterSet], theta_o_deg: Sequence[float]
) -> ModelError | None:
    """What the model raises at the first place where it does."""
    until = time.monotonic() + PATIENCE
    for p in itertools.chain.from_iterable(map(channels, sets)):
        ready = probe.called(model, "prepare", model.prepared, p)
        for member, wo, other in _trials(model, theta_o_deg):
            try:
                probe.evaluated(model, member, wo, other, ready)
            except ModelError as error:
                where = f"wo = {_shown(wo)}, {NAMES[member]} = {_shown(other)}"
                return ModelError(f"{error} at {where}")
            if time.monotonic() > until:
                return None
    return None


def _trials(model: Model, theta_o_deg: Sequence[float]) -> Iterator[tuple[str, Vec, Vec]]:
    """(member, wo, its second argument)."""
    views = [from_degrees(theta) for theta in dict.fromkeys((*theta_o_deg, *POLAR))]
    for wo, wi in _pairs(views):
        yield "f", wo, wi
        if model.pdf:
            yield "pdf", wo, wi
    if model.sample:
        yield from (("sample", wo, u) for wo, u in _draws(views))


def _pairs(views: Sequence[Vec]) -> Iterator[tuple[Vec, Vec]]:
    lights = [from_degrees(theta, phi) for theta in POLAR for phi in AZIMUTHS]
    for wo in views:
        yield from ((wo, wi) for wi in (mirrored(wo), wo, *lights))
    chance = random.Random(0)
    for _ in range(RANDOM):
        yield _direction(chance), _direction(chance)


def _draws(views: Sequence[Vec]) -> Iterator[tuple[Vec, Vec]]:
    for wo in views:
        yield from ((wo, (a, b, c)) for a, b, c in itertools.product(ENDS, repeat=3))
    chance = random.Random(0)
    for _ in range(RANDOM):
        yield _direction(chance), (chance.random(), chance.random(), chance.random())


def _direction(chance: random.Random) -> Vec:
    return random_hemisphere(chance.random(), chance.random())


def _shown(numbers: Vec) -> str:
    return f"({', '.join(map(_number, numbers))})"


def _number(x: float) -> str:
    """A few digits, all where they would say 0 or 1 of what is not."""
    few = f"{x:.6g}"
    return few if float(few) not in (0.0, 1.0, -1.0) or float(few) == x else repr(x)
