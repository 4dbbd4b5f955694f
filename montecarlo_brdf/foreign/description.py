"""What a shader's author says of it: comments `// brdf-check: key = value` in the shader itself.

Which expression is f, which are pdf and sample, what the parameters are and in which range.
docs/shaders.md explains every key.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.errors import unknown
from montecarlo_brdf.foreign.complaint import Complaint

LINE = re.compile(
    r"^[ \t]*(?://[/!]*|/\*+|\*)[ \t]*brdf-check:[ \t]*(.*?)(?:[ \t]+//.*|[ \t]*\*/)?[ \t]*$", re.M
)
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
VALUE = re.compile(
    rf"(?P<value>true|false|{NUMBER}|int\s*\(\s*-?\d+\s*\)|(?:colou?r|vec3|float3)\s*\([^)]*\))"
    rf"(?:\s+in\s+\[\s*(?P<low>{NUMBER})\s*,\s*(?P<high>{NUMBER})\s*\])?"
)
SUFFIX = re.compile(r"(?<=[\d.])[fF]\b")  # of a number
IDENTIFIER = re.compile(r"[A-Za-z]\w*")
MACRO = re.compile(r"[A-Za-z_]\w*(?:\([\w, ]*\))?")
CHANNELS = ("r", "g", "b")


class Type(StrEnum):
    """What a parameter is in the shader."""

    NUMBER = "float"
    WHOLE = "int"
    SWITCH = "bool"
    COLOUR = "colour"


class Cosine(StrEnum):
    """Whether f is multiplied by it."""

    EXCLUDED = "excluded"
    INCLUDED = "included"


class Measure(StrEnum):
    """What a pdf is a density over."""

    SOLID_ANGLE = "solid angle"
    PROJECTED = "projected"


class Language(StrEnum):
    """What a shader is written in."""

    GLSL = "glsl"
    HLSL = "hlsl"
    SLANG = "slang"
    EXPLORER = "brdf"


class Parameter(NamedTuple):
    """A parameter of the shader: default per channel, range."""

    name: str
    defaults: tuple[float, ...]
    ends: tuple[float, float] | None
    type: Type = Type.NUMBER

    def fields(self) -> dict[str, float]:
        """The numbers of a model that it becomes: one, or one per channel."""
        if self.type is not Type.COLOUR:
            return {self.name: self.defaults[0]}
        return {f"{self.name}_{c}": v for c, v in zip(CHANNELS, self.defaults, strict=True)}


class Description:
    """All that is said of a shader. (No dataclass: to import those takes a tenth of a
    translation.)"""

    def __init__(self) -> None:
        self.f = self.pdf = self.sample = self.weight = ""  # expressions
        self.before = self.stub = ""  # statements
        self.cosine, self.measure = Cosine.EXCLUDED, Measure.SOLID_ANGLE
        self.precision = "single"
        self.language: Language | None = None  # by the file's name
        self.parameters: list[Parameter] = []
        self.defines: dict[str, str] = {}
        self.folders: list[str] = []
        self.sources: list[str] = []
        self.lobe = ""  # "half vector: alpha"
        self.albedo = ""  # a formula of mu and parameters
        self.verified = ""  # "alpha = 0.3; alpha = 1"
        self.lossless = ""  # true, or the same
        self.limits = ""  # "alpha = 1: lambert"
        self.members: dict[str, Any] = {}  # of the model
        self.places: dict[str, str] = {}  # key -> file and line
        self.found: list[str] = []  # in words, what nobody said


class Statement(NamedTuple):
    """`key = value` and where it stands, as "my.glsl, line 3"."""

    text: str
    place: str


def statements(text: str, file: str) -> list[Statement]:
    """Those in a shader's comments."""
    return [
        Statement(match[1], f"{file}, line {text.count(chr(10), 0, match.start()) + 1}")
        for match in LINE.finditer(text)
    ]


def described(said: Iterable[Statement]) -> Description:
    """The description that statements make. Raises Complaint, beginning with the place."""
    found = Description()
    for one in said:
        try:
            _take(found, *one)
        except Complaint as error:
            raise Complaint(f"{one.place}: {error}", placed=True) from None
    if found.before and not found.before.rstrip().endswith((";", "}")):
        found.before += ";\n"
    return found


def _take(found: Description, statement: str, place: str) -> None:
    key, _, value = (part.strip() for part in statement.partition("="))
    name, _, named = (part.strip() for part in key.partition(" "))
    if not value and name != "define":
        raise Complaint(f"write `// brdf-check: key = value`, not {statement!r}")
    if name not in KEYS:
        raise Complaint(unknown("key", name, sorted(KEYS)))
    taken, needs_name = KEYS[name]
    if needs_name != bool(named):
        form = f"{name} NAME = value" if needs_name else f"{name} = value"
        raise Complaint(f"write `{form}`, not {statement!r}")
    found.places.setdefault(key, place)
    taken(found, named or name, value)


Taker = Callable[[Description, str, str], None]


def _expression(found: Description, key: str, value: str) -> None:
    if getattr(found, key):
        raise Complaint(f"key {key} is given twice")
    setattr(found, key, value.rstrip("; "))


def _before(found: Description, key: str, value: str) -> None:
    found.before += value + "\n"


def _stub(found: Description, key: str, value: str) -> None:
    found.stub += value + "\n"


def _parameter(found: Description, name: str, value: str) -> None:
    match = VALUE.fullmatch(SUFFIX.sub("", value))
    if not match or not IDENTIFIER.fullmatch(name):
        raise Complaint(f"write `param {name} = 0.3 in [0, 1]`, `= color(1, 0.7, 0.3)` or `= true`")
    if any(p.name == name for p in found.parameters):
        raise Complaint(f"param {name} is given twice")
    ends = (float(match["low"]), float(match["high"])) if match["low"] else None
    found.parameters.append(parameter(name, match["value"], ends))


def parameter(name: str, text: str, ends: tuple[float, float] | None) -> Parameter:
    """A parameter by its default as it is written."""
    if text in ("true", "false"):
        return Parameter(name, (float(text == "true"),), (0.0, 1.0), Type.SWITCH)
    if text.startswith("int"):
        return Parameter(name, (float(re.findall(NUMBER, text)[0]),), ends, Type.WHOLE)
    if "(" not in text:
        return Parameter(name, (float(text),), ends)
    numbers = re.findall(NUMBER, text.partition("(")[2])
    numbers = numbers * len(CHANNELS) if len(numbers) == 1 else numbers
    if len(numbers) != len(CHANNELS):
        raise Complaint(f"the colour {name} needs three numbers, not {text}")
    return Parameter(name, tuple(map(float, numbers)), ends, Type.COLOUR)


def _define(found: Description, name: str, value: str) -> None:
    if not MACRO.fullmatch(name):
        raise Complaint(f"write `define NAME = value`, not `define {name}`")
    found.defines[name] = value.strip('"')


def _include(found: Description, key: str, value: str) -> None:
    found.folders.append(value.strip('"'))


def _source(found: Description, key: str, value: str) -> None:
    found.sources.append(value.strip('"'))


def _one_of(kind: type[StrEnum]) -> Taker:
    def taken(found: Description, key: str, value: str) -> None:
        if value not in list(kind):
            raise Complaint(unknown(key, value, kind))
        setattr(found, key, kind(value))

    return taken


def _precision(found: Description, key: str, value: str) -> None:
    if value not in ("single", "double"):
        raise Complaint(unknown(key, value, ("single", "double")))
    found.precision = value


def _disclaims(found: Description, name: str, value: str) -> None:
    from montecarlo_brdf.model import PROPERTIES  # slow to import

    if name not in PROPERTIES:
        raise Complaint(unknown("property", name, PROPERTIES))
    found.members.setdefault("disclaims", {})[name] = value


def _switch(found: Description, key: str, value: str) -> None:
    if value not in ("true", "false"):
        raise Complaint(f"{key} must be true or false, not {value}")
    found.members[key] = value == "true"


def _term(found: Description, key: str, value: str) -> None:
    """A factor of a BRDF or a tool: of what energy promises it has nothing."""
    _switch(found, key, value)
    if found.members.pop(key):
        found.members["disclaims"] = TERM | found.members.get("disclaims", {})


def _word(found: Description, key: str, value: str) -> None:
    found.members[key] = value


def _sets(found: Description, key: str, value: str) -> None:
    """Parameter sets, which more lines may add to."""
    before = getattr(found, key)
    setattr(found, key, f"{before}; {value}" if before else value)


def _kinks(found: Description, key: str, value: str) -> None:
    found.members[key] = [one.strip() for one in value.split(",")]


TERM: Mapping[str, str] = {
    "energy": "a term of a BRDF, not one itself",
    "reciprocity": "a term of a BRDF, not one itself",
}
#: key -> what takes it, and whether a name follows it
KEYS: dict[str, tuple[Taker, bool]] = {
    "f": (_expression, False), "pdf": (_expression, False), "sample": (_expression, False),
    "weight": (_expression, False), "before": (_before, False), "param": (_parameter, True),
    "cosine": (_one_of(Cosine), False), "measure": (_one_of(Measure), False),
    "precision": (_precision, False), "define": (_define, True), "include": (_include, False),
    "source": (_source, False), "stub": (_stub, False), "disclaims": (_disclaims, True),
    "isotropic": (_switch, False), "lossless": (_sets, False), "term": (_term, False),
    "lobe": (_expression, False), "albedo": (_expression, False), "kinks": (_kinks, False),
    "verified": (_sets, False), "limits": (_sets, False), "language": (_one_of(Language), False),
    "same_as": (_word, False), "scales_with": (_word, False),
}  # fmt: skip
