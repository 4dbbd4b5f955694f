"""The functions of a model that a shader's expressions make, and what each is given.

An entry reads six numbers, wo and wi (or the uniforms u), then the parameters, and writes its
result after them.
"""

from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.foreign.description import Description, Parameter, Type

DIRECTIONS = 6  # numbers before the parameters


class Entry(NamedTuple):
    """A function of the model: its name, its expression, and what the result is made by."""

    name: str
    expression: str
    maker: str  # bc_colour, bc_direction

    @property
    def drawing(self) -> bool:
        """Whether it is given uniforms in place of wi."""
        return self.name in ("sample", "weight")


def directions(one: Entry, kind: str) -> dict[str, str]:
    """The names that an expression may use besides the parameters; of wi and u one is given."""
    first, second = (f"{kind}(bc[{k}], bc[{k + 1}], bc[{k + 2}])" for k in (0, 3))
    given = {
        "wo": first, "wi": f"{kind}(0, 0, 1)" if one.drawing else second,
        "u": second if one.drawing else f"{kind}(0.5, 0.5, 0.5)",
        "n": f"{kind}(0, 0, 1)", "t": f"{kind}(1, 0, 0)", "b": f"{kind}(0, 1, 0)",
        "h": "normalize(wo + wi)",
    }  # fmt: skip
    return {name: f"{kind} {name} = {text};" for name, text in given.items()}


def entries(said: Description) -> list[Entry]:
    """Those that a description has."""
    made = {"f": "bc_colour", "pdf": "bc_number", "sample": "bc_direction", "weight": "bc_number"}
    return [Entry(k, getattr(said, k), m) for k, m in made.items() if getattr(said, k)]


def places(parameters: list[Parameter]) -> list[tuple[Parameter, int]]:
    """Where each parameter's first number is among the entry's."""
    found, place = [], DIRECTIONS
    for one in parameters:
        found.append((one, place))
        place += len(one.defaults)
    return found


def end(parameters: list[Parameter]) -> int:
    """The place of the first result."""
    return DIRECTIONS + sum(len(p.defaults) for p in parameters)


def value(one: Parameter, place: int, colour: str) -> str:
    """The parameter in the shader's language; `colour` is its type of three numbers."""
    if one.type is Type.COLOUR:
        return f"{colour}(bc[{place}], bc[{place + 1}], bc[{place + 2}])"
    if one.type is Type.SWITCH:
        return f"(bc[{place}] != 0.0)"
    if one.type is Type.WHOLE:
        return f"int(bc[{place}])"
    return f"bc[{place}]"
