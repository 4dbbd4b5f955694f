"""Files of the BRDF Explorer: a header of parameters and a GLSL function BRDF(L, V, N, X, Y)."""

from __future__ import annotations

import re

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import TERM, Description, Parameter, Type

CALL = "BRDF(wi, wo, vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0))"
TYPES = {Type.NUMBER: "float", Type.SWITCH: "bool", Type.COLOUR: "vec3"}
BLOCK = r"^::begin {0}\s*\n(.*?)^::end {0}"
#: files by these names are factors of a BRDF, or tools
TERM_FILE = re.compile(r"(?:[dfg]_\w*|show\w*|schlick|compare)\.brdf")


def described(text: str, name: str, said: Description) -> tuple[Description, str]:
    """The description that a file's header is, and its shader with its lines kept."""
    if "::begin shader" not in text:
        raise Complaint("it has no shader: a BRDF Explorer file has `::begin shader`")
    header, first = _block(text, "parameters")
    shader, before = _block(text, "shader")
    said.parameters += _parameters(header, first)
    uniforms = "".join(f"uniform {TYPES[p.type]} {p.name};" for p in said.parameters)
    said.f = said.f or CALL
    if TERM_FILE.fullmatch(name):
        said.members["disclaims"] = dict(TERM) | said.members.get("disclaims", {})
    said.members.setdefault("isotropic", False)
    return said, uniforms + "\n" * before + shader


def _block(text: str, name: str) -> tuple[str, int]:
    """What stands between ::begin and ::end, and how many lines stand before it."""
    found = re.search(BLOCK.format(name), text, re.S | re.M)
    return (found[1], text.count("\n", 0, found.start(1))) if found else ("", 0)


def _parameters(header: str, first: int) -> list[Parameter]:
    found = []
    for number, line in enumerate(header.splitlines(), first + 1):
        words = line.split("#")[0].split()
        if words:
            found.append(_parameter(words, number))
    return found


def _parameter(words: list[str], line: int) -> Parameter:
    kind, name, values = words[0], words[1] if len(words) > 1 else "", words[2:]
    try:
        if kind == "float":
            low, high, default = map(float, values[:3])
            return Parameter(name, (default,), (low, high))
        if kind == "bool":
            return Parameter(name, (float(int(values[0]) != 0),), (0.0, 1.0), Type.SWITCH)
        if kind == "color" and len(values) >= 3:
            return Parameter(name, tuple(map(float, values[:3])), (0.0, 1.0), Type.COLOUR)
    except (ValueError, IndexError):
        pass
    raise Complaint(f"line {line}: write `float name low high default`, not {' '.join(words)!r}")
