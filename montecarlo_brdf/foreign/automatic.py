"""Which function of a shader is f, where its author does not say: the only one whose first two
arguments are called like a view and a light."""

from __future__ import annotations

import re
from typing import NamedTuple

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import Parameter
from montecarlo_brdf.foreign.scopes import bare

VIEWS = ["wo", "V", "v", "view", "viewDir", "viewDirection", "E", "eye"]
LIGHTS = ["wi", "L", "l", "light", "lightDir", "lightDirection"]
#: what other arguments are called, and what they are in an expression
FRAME = {"N": "n", "normal": "n", "H": "h", "halfVector": "h", "T": "t", "X": "t", "tangent": "t",
         "B": "b", "Y": "b", "bitangent": "b", "n": "n", "h": "h", "t": "t", "b": "b"}  # fmt: skip
FUNCTION = re.compile(
    r"\b(?:float3?|vec3|half3?)\s+(?P<name>\w+)\s*\((?P<arguments>[^(){}]*)\)\s*\{"
)
VECTOR = ("vec3", "float3", "half3")
OFFER = "say which function it is: // brdf-check: f = NAME(wo, wi, ...)"


class Found(NamedTuple):
    """A function: its name and its arguments by type and name."""

    name: str
    arguments: list[tuple[str, str]]

    def fits(self) -> bool:
        """Whether it takes a view and a light first."""
        first = self.arguments[:2]
        names = {n for _, n in first}
        vectors = len(first) == 2 and all(kind in VECTOR for kind, _ in first)
        return vectors and bool(names & set(VIEWS)) and bool(names & set(LIGHTS))


def call(text: str, parameters: list[Parameter]) -> str:
    """The call that f is. Raises Complaint where none fits, or several do."""
    found = [one for one in _functions(bare(text)) if one.fits()]
    if len(found) != 1:
        several = f"{', '.join(f.name for f in found)} all could be f" if found else "no f is named"
        raise Complaint(f"{several}; {OFFER}")
    known = {p.name for p in parameters}
    return f"{found[0].name}({', '.join(_argument(n, known) for _, n in found[0].arguments)})"


def _functions(code: str) -> list[Found]:
    return [Found(m["name"], _arguments(m["arguments"])) for m in FUNCTION.finditer(code)]


def _arguments(text: str) -> list[tuple[str, str]]:
    words = [one.split("=")[0].split() for one in text.split(",") if one.strip()]
    return [(w[-2], w[-1]) for w in words if len(w) > 1]


def _argument(name: str, known: set[str]) -> str:
    if name in VIEWS:
        return "wo"
    if name in LIGHTS:
        return "wi"
    if name in FRAME and name not in known:
        return FRAME[name]
    if name not in known:
        raise Complaint(f"add the parameter: // brdf-check: param {name} = 0.5 in [0, 1]")
    return name
