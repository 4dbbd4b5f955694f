"""How numbers are written: doubles for floats, or floats rounded as the shader's are."""

from __future__ import annotations

import struct
from typing import NamedTuple

from montecarlo_brdf.foreign import constants
from montecarlo_brdf.foreign.kinds import Kind, Type

SPECIAL = {"inf": "INF", "-inf": "-INF", "nan": "NAN"}


class Numerals(NamedTuple):
    """The source of literals; `single`: each is made a float32."""

    single: bool

    def real(self, value: float) -> str:
        """A number of the shader's."""
        text = repr(value)
        text = SPECIAL.get(text, text)
        if self.single:
            return text if text in SPECIAL.values() else f"F({text})"
        return f"({text})" if text.startswith("-") else text

    def converted(self, source: str) -> str:
        """A whole number as one of the shader's."""
        return f"F({source})"

    @property
    def zeros(self) -> dict[Kind, str]:
        """0 of every kind."""
        return {
            Kind.FLOAT: self.real(0.0), Kind.SIGNED: "0", Kind.UNSIGNED: "0", Kind.BOOL: "False",
        }  # fmt: skip

    def literal(self, kind: Type, words: tuple[int, ...]) -> str:
        """The source of a constant from its words."""
        if kind.kind is Kind.FLOAT:
            value = number(kind.width, words)
            return self.real(constants.shortest(value) if kind.width == 32 else value)
        if kind.kind is Kind.SIGNED and words[0] >> 31:
            return f"({words[0] - (1 << 32)})"
        return str(words[0])


def number(width: int, words: tuple[int, ...]) -> float:
    """The number in one word or two."""
    if width == 64:
        return float(struct.unpack("<d", struct.pack("<2I", *words[:2]))[0])
    if width == 16:
        return float(struct.unpack("<e", struct.pack("<I", words[0])[:2])[0])
    return float(struct.unpack("<f", struct.pack("<I", words[0]))[0])
