"""A template without its model: what calls the model's functions and its parameters are replaced by
names that are linked later, so that the rest is compiled once for all models.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from montecarlo_brdf.compile.bind import Bound, Called, Function, bound, hole, references, uses
from montecarlo_brdf.compile.external import Addresses, External, Kind
from montecarlo_brdf.compile.layout import Layout, Unpack, following, size_of

FUNCTION: Function = hole()
PARAMETERS: Function = hole()

ROOM = 16  # numbers of a parameter set at least, so that most models share outlines,
MOST = 256  # and at most: tables as parameters are loaded where they are used


def with_one(w, p):  # type: ignore[no-untyped-def]
    """A model's function of one direction, with its parameters' address."""
    return FUNCTION(w, PARAMETERS(p)[0])


def with_two(a, b, p):  # type: ignore[no-untyped-def]
    """One of two directions, or of a direction and numbers to draw another by."""
    return FUNCTION(a, b, PARAMETERS(p)[0])


class Outline(NamedTuple):
    """The functions of a model that a template calls and the layouts of its parameters, by the
    names under which they are linked."""

    template: Bound
    calls: dict[Called, str]
    layouts: dict[Layout, str]

    @property
    def room(self) -> int:
        """Numbers that each parameter set may have."""
        return max(ROOM, *(1 << (size_of(x.shape) - 1).bit_length() for x in self.layouts))

    def unit(self, call: Called) -> Bound:
        """A function of the model as it is linked."""
        (shape,) = {layout.shape for layout in self.layouts}
        form = with_two if call.vectors == 2 else with_one
        return bound(form, FUNCTION=call.function, PARAMETERS=Unpack(following(shape, 0)))

    def bare(self, returns: dict[Called, Kind]) -> Bound:
        """The template with names in place of the model, whose functions return these kinds."""
        return self._bare(self.template, returns)

    def _bare(self, one: Bound, returns: dict[Called, Kind]) -> Bound:
        return Bound(one.function, frozenset((n, self._at(v, returns)) for n, v in one.names))

    def _at(self, value: object, returns: dict[Called, Kind]) -> object:
        if isinstance(value, Bound):
            return self._bare(value, returns)
        if isinstance(value, Called):
            used = value in self.calls
            return External(self.calls[value], value.vectors, returns[value]) if used else None
        if isinstance(value, Unpack):
            layout = value.layout
            return Addresses(self.layouts[layout], self.room, len(layout.places))
        return value


def outlined(template: Bound) -> Outline | None:
    """What of a template belongs to a model; None if it cannot be told apart."""
    values = list(_values(template.function, dict(template.names)))
    calls = dict.fromkeys(v for v in values if isinstance(v, Called))
    layouts = dict.fromkeys(v.layout for v in values if isinstance(v, Unpack))
    shapes = {layout.shape for layout in layouts}
    if not calls or len(shapes) != 1 or size_of(*shapes) > MOST:
        return None
    return Outline(
        template,
        {call: f"montecarlo_brdf_model_{k}" for k, call in enumerate(calls)},
        {layout: f"montecarlo_brdf_parameters_{k}" for k, layout in enumerate(layouts)},
    )


def _values(function: Function, names: Mapping[str, object]) -> Iterator[object]:
    """All that a template uses, in an order that is the same in every process."""
    for value in references(function, names).values():
        yield value
        if isinstance(value, Bound):
            yield from _values(value.function, dict(value.names))
        elif uses(value, names):
            yield from _values(value, names)
