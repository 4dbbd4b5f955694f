"""Which functions of a shader are f, pdf and sample, where its author does not say: the only ones
whose names and arguments fit."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import Description
from montecarlo_brdf.foreign.scopes import bare

VIEWS = ["wo", "V", "v", "view", "viewDir", "viewDirection", "E", "eye"]
LIGHTS = ["wi", "L", "l", "light", "lightDir", "lightDirection"]
RANDOM = ["u", "xi", "Xi", "rnd", "rand", "random", "uv", "r", "U", "u01"]
#: what other arguments are called, and what they are in an expression
FRAME = {"N": "n", "normal": "n", "H": "h", "halfVector": "h", "T": "t", "X": "t", "tangent": "t",
         "B": "b", "Y": "b", "bitangent": "b", "n": "n", "h": "h", "t": "t", "b": "b"}  # fmt: skip
FUNCTION = re.compile(
    r"\b(?P<kind>float[23]?|vec3|half3?)\s+(?P<name>\w+)\s*\((?P<arguments>[^(){}]*)\)\s*\{"
)
LINE = re.compile(r'^#line (\d+) "(.*)"$', re.M)
VECTOR = ("vec3", "float3", "half3")
PLAIN = ("float", "half", "int", "uint", "bool", *VECTOR)
OFFER = "say which function it is: // brdf-check: f = NAME(wo, wi, ...)"


class Argument(NamedTuple):
    """Of a function; `optional` if it has a default."""

    kind: str
    name: str
    optional: bool


class Function(NamedTuple):
    """A function: where it stands, what it gives, its arguments by type and name."""

    place: str
    kind: str
    name: str
    arguments: list[Argument]

    def vectors(self, count: int | None = None) -> list[str]:
        """The names of its arguments that are directions, of the first so many."""
        return [one.name for one in self.arguments[:count] if one.kind in VECTOR]

    def evaluates(self, names: list[str]) -> bool:
        """Whether a view and a light are among these arguments."""
        return bool({*names} & {*VIEWS}) and bool({*names} & {*LIGHTS})

    def draws(self) -> bool:
        """Whether it makes a direction of a view and random numbers."""
        vectors, random = self.vectors(), any(
            n in RANDOM and k in (*VECTOR, "vec2", "float2") for k, n, _ in self.arguments
        )
        one_side = bool({*vectors} & {*VIEWS}) and not {*vectors} & {*LIGHTS}
        return self.kind in VECTOR and random and one_side and "sample" in self.name.lower()

    def is_density(self) -> bool:
        """Whether it calls itself one."""
        return "pdf" in self.name.lower() and self.kind not in VECTOR

    def call(self, known: set[str]) -> str:
        """The expression that calls it. Raises Complaint for an argument that nothing is."""
        given = []
        for kind, name, optional in self.arguments:
            if optional and name not in known:
                break
            given.append(_argument(kind, name, known))
        return f"{self.name}({', '.join(given)})"


def bind(text: str, path: str, said: Description) -> None:
    """Name f, and pdf and sample if both are there. Raises Complaint where no f fits, or several.

    text: the shader with its includes; said: gets expressions, and sentences about them.
    """
    functions, known = list(_functions(bare(text), path)), {p.name for p in said.parameters}
    _take(said, "f", _only(functions), known)
    densities = [one for one in functions if one.is_density() and one.evaluates(one.vectors())]
    samplers = [one for one in functions if one.draws()]
    if len(densities) == len(samplers) == 1 and not (said.pdf or said.sample):
        try:
            calls = densities[0].call(known), samplers[0].call(known)
        except Complaint:  # of f it would be an error; a sampler can be left out
            return
        for key, one, _ in zip(("pdf", "sample"), (densities[0], samplers[0]), calls, strict=True):
            _take(said, key, one, known)


def _take(said: Description, key: str, one: Function, known: set[str]) -> None:
    setattr(said, key, one.call(known))
    said.found.append(f"{key} = {getattr(said, key)}, from {one.place}")


def _only(functions: list[Function]) -> Function:
    """The function that is f: a view and a light come first, or at least before anything else that
    is a direction, or somewhere."""
    values = [one for one in functions if not one.is_density()]
    first = [one for one in values if one.evaluates(one.vectors(2))]
    early = [one for one in values if one.evaluates(one.vectors()[:2])]
    some = [one for one in values if one.evaluates(one.vectors())]
    found = first or early or some
    if len(found) != 1:
        names = ", ".join(dict.fromkeys(one.name for one in found))
        raise Complaint(f"{f'{names} all could be f' if found else 'no f is named'}; {OFFER}")
    return found[0]


def _functions(code: str, path: str) -> Iterator[Function]:
    for match in FUNCTION.finditer(code):
        arguments = _arguments(match["arguments"])
        yield Function(_place(code, match.start(), path), match["kind"], match["name"], arguments)


def _place(code: str, at: int, path: str) -> str:
    """The author's file and line."""
    lines = list(LINE.finditer(code, 0, at))
    number, file, begin = 1, path, 0
    if lines:
        number, file, begin = int(lines[-1][1]), lines[-1][2], lines[-1].end() + 1
    return f"{file}, line {number + code.count(chr(10), begin, at)}"


def _arguments(text: str) -> list[Argument]:
    parts = [one.partition("=") for one in text.split(",") if one.strip()]
    words = [(left.split(), bool(equals)) for left, equals, _ in parts]
    return [Argument(w[-2], w[-1], optional) for w, optional in words if len(w) > 1]


def _argument(kind: str, name: str, known: set[str]) -> str:
    if name in known:
        return name
    if name in VIEWS and kind in VECTOR:
        return "wo"
    if name in LIGHTS and kind in VECTOR:
        return "wi"
    if name in FRAME and kind in VECTOR:
        return FRAME[name]
    if name in RANDOM and kind not in PLAIN[:5]:
        return "u" if kind in VECTOR else "u.xy"
    if kind not in PLAIN:
        raise Complaint(
            f"its function takes a {kind}: fill it by // brdf-check: before = {kind} {name}; ..., "
            f"and {OFFER}"
        )
    value = "color(0.5, 0.5, 0.5)" if kind in VECTOR else "0.5"
    raise Complaint(f"add the parameter: // brdf-check: param {name} = {value} in [0, 1]")
