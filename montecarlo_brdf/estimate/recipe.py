"""Kernels of means: integrands at the points of a set, their moments per replicate."""
from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import Any, NamedTuple

from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.kernel import buffer, fingerprint
from montecarlo_brdf.compile.layout import Layout, unpacker
from montecarlo_brdf.compile.reach import takes_more
from montecarlo_brdf.estimate import charted, integrands, moments
from montecarlo_brdf.sampling import points as point_sets

Function = Callable[..., Any]

STEPS = {**integrands.STEPS, **charted.STEPS}
#: What a kernel calls its integrands.
NAMES = ("FIRST", "SECOND", "THIRD", "FOURTH", "FIFTH")


class Wrapped(NamedTuple):
    """An integrand that another one evaluates, as INSIDE, at points of its own."""

    outer: Function
    inner: Function


class Recipe(NamedTuple):
    """All that a kernel of means is made of."""

    points: str
    integrands: tuple[Function | Wrapped, ...]
    functions: Mapping[str, Function]  # what F, SAMPLE, PDF stand for in the integrands
    layout: Layout

    @property
    def channels(self) -> int:
        """Number of parameter sets."""
        return len(self.layout.places)

    def point_set(self) -> Function:
        """The points; of Sobol's only the coordinates that the integrands use."""
        if self.points == "sobol" and all(i in integrands.PLANE for i in self.integrands):
            choosing = takes_more(self.functions.get("SAMPLE"), 1, 2)
            return point_sets.sobol_plane if choosing else point_sets.sobol_pair
        found: Function = getattr(point_sets, self.points)
        return found

    def steps(self) -> tuple[Function, ...]:
        """From points to directions, if all integrands want the same of them and no more."""
        first, *others = {STEPS.get(i, ()) for i in self.integrands}
        return () if others else first

    def bound(self) -> Mapping[str, Function]:
        """What names in the integrands stand for."""
        return {**self.functions, **{step.__name__: integrands.as_made for step in self.steps()}}

    def _shape(self) -> Function:
        return moments.shaped if self.points in point_sets.SHAPES else moments.shapeless

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        content = fingerprint(self.layout)
        content.add((self.point_set(), self._shape(), self.steps()))
        for integrand in self.integrands:
            if isinstance(integrand, Wrapped):
                content.add(integrand.outer)
                integrand = integrand.inner
            content.add(integrand, self.bound())
        content.add((moments.moments, moments.advance, moments.store))
        content.add(len(self.integrands))
        return content.hexdigest()

    def parts(self) -> Hashable:
        """Points, functions and layout."""
        return self.points, self.integrands, frozenset(self.functions.items()), self.layout

    def assemble(self, special: Specialiser) -> Function:
        """The template `moments` with everything bound."""
        slots = [self._bound(special, i) for i in self.integrands]
        bound = {
            "POINTS": self.point_set(),
            **dict(zip(moments.STEP_NAMES, self._steps(special), strict=True)),
            "STEPS": len(self.steps()),
            "SHAPE": self._shape(),
            "STORE": _store(special, slots),
            "PARAMETERS": unpacker(self.layout),
            "BUFFER": buffer(moments.ROOM * self.channels * len(slots)),
            "ROW": buffer(moments.ROOM),
            "CHANNELS": self.channels,
            "SLOTS": len(slots),
        }
        return special.clone(moments.moments, bound)

    def _steps(self, special: Specialiser) -> list[Any]:
        """What takes each step for a block, and in place of those not needed something typed."""
        made = [special.bind(moments.advance, {"STEP": step}) for step in self.steps()]
        spare = special.bind(moments.advance, {"STEP": integrands.as_made})
        return [*made, *[spare] * (len(moments.STEP_NAMES) - len(made))]

    def _bound(self, special: Specialiser, integrand: Function | Wrapped) -> Any:
        if isinstance(integrand, Wrapped):
            inside = special.bind(integrand.inner, self.bound())
            return special.bind(integrand.outer, {"INSIDE": inside})
        return special.bind(integrand, self.bound())


def _store(special: Specialiser, integrands: list[Any]) -> Any:
    """A function that evaluates each integrand into its own slot."""
    if len(integrands) > len(NAMES):
        raise ValueError(f"{len(integrands)} integrands in one kernel; {len(NAMES)} are allowed")
    spare = [integrands[0]] * (len(NAMES) - len(integrands))  # typed, never called
    bound = dict(zip(NAMES, integrands + spare, strict=True))
    return special.bind(moments.store, {**bound, "SLOTS": len(integrands)})
