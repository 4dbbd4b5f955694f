"""What a shader's author says of it: comments `// brdf-check: key = value` in the shader itself.

Which expression is f, which are pdf and sample, what the parameters are and in which range.
docs/shaders.md explains every key.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.errors import unknown
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.model import PROPERTIES

LINE = re.compile(r"^[ \t]*//[ \t]*brdf-check:[ \t]*(.*?)[ \t]*$", re.M)
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
VALUE = re.compile(
    rf"(?P<value>true|false|{NUMBER}|color\s*\([^)]*\))"
    rf"(?:\s+in\s+\[\s*(?P<low>{NUMBER})\s*,\s*(?P<high>{NUMBER})\s*\])?"
)
IDENTIFIER = re.compile(r"[A-Za-z]\w*")
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


@dataclass
class Description:
    """All that is said of a shader."""

    f: str = ""
    pdf: str = ""
    sample: str = ""
    weight: str = ""
    before: str = ""
    cosine: Cosine = Cosine.EXCLUDED
    measure: Measure = Measure.SOLID_ANGLE
    precision: str = "single"
    parameters: list[Parameter] = field(default_factory=list)
    defines: dict[str, str] = field(default_factory=dict)
    folders: list[str] = field(default_factory=list)
    sources: list[str] = field(default_factory=list)
    stub: str = ""
    lobe: str = ""  # "half vector: alpha"
    albedo: str = ""  # a formula of mu and parameters
    members: dict[str, Any] = field(default_factory=dict)  # of the model
    places: dict[str, str] = field(default_factory=dict)  # key -> file and line


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
    return found


def _take(found: Description, statement: str, place: str) -> None:
    key, equals, value = (part.strip() for part in statement.partition("="))
    words = key.split()
    if not equals or not words or not value:
        raise Complaint(f"write `// brdf-check: key = value`, not {statement!r}")
    name = words[0]
    if name not in KEYS:
        raise Complaint(unknown("key", name, sorted(KEYS)))
    taken, named = KEYS[name]
    if named != (len(words) == 2) or len(words) > 2:
        form = f"{name} NAME = value" if named else f"{name} = value"
        raise Complaint(f"write `{form}`, not {statement!r}")
    found.places.setdefault(key, place)
    taken(found, words[-1], value)


Taker = Callable[[Description, str, str], None]


def _expression(found: Description, key: str, value: str) -> None:
    if getattr(found, key):
        raise Complaint(f"key {key} is given twice")
    setattr(found, key, value)


def _before(found: Description, key: str, value: str) -> None:
    found.before += value + "\n"


def _stub(found: Description, key: str, value: str) -> None:
    found.stub += value + "\n"


def _parameter(found: Description, name: str, value: str) -> None:
    match = VALUE.fullmatch(value)
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
    if not text.startswith("color"):
        return Parameter(name, (float(text),), ends)
    numbers = re.findall(NUMBER, text)
    if len(numbers) != len(CHANNELS):
        raise Complaint(f"the colour {name} needs three numbers, not {text}")
    return Parameter(name, tuple(map(float, numbers)), ends, Type.COLOUR)


def _define(found: Description, name: str, value: str) -> None:
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
    "isotropic": (_switch, False), "lossless": (_switch, False), "term": (_term, False),
    "lobe": (_expression, False), "albedo": (_expression, False), "kinks": (_kinks, False),
    "same_as": (_word, False), "scales_with": (_word, False),
}  # fmt: skip
