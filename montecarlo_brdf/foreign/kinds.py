"""The types of a shader, flattened: a vec3 is three numbers, a struct those of its members."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import NamedTuple

from montecarlo_brdf.foreign.complaint import Complaint


class Kind(StrEnum):
    """What a type is."""

    FLOAT = "float"
    SIGNED = "int"
    UNSIGNED = "uint"
    BOOL = "bool"
    VECTOR = "vector"
    MATRIX = "matrix"
    ARRAY = "array"
    ENDLESS = "array without length"
    STRUCT = "struct"
    POINTER = "pointer"
    VOID = "void"
    OTHER = "texture"


SCALARS = (Kind.FLOAT, Kind.SIGNED, Kind.UNSIGNED, Kind.BOOL)
ROWS = (Kind.VECTOR, Kind.MATRIX, Kind.ARRAY)


class Type(NamedTuple):
    """A type; `parts` are the numbers of the types that it is made of."""

    kind: Kind
    parts: tuple[int, ...] = ()
    length: int = 0  # of a vector, a matrix in columns, an array
    width: int = 32
    storage: int = 0  # of what a pointer points to


class Types(dict[int, Type]):
    """All types of a module by number."""

    def size(self, number: int) -> int:
        """How many numbers a value has."""
        one = self[number]
        if one.kind in SCALARS:
            return 1
        if one.kind in ROWS:
            return one.length * self.size(one.parts[0])
        if one.kind is Kind.STRUCT:
            return sum(map(self.size, one.parts))
        if one.kind is Kind.VOID:
            return 0
        raise Complaint(f"a value of type {one.kind} is used, which no number can stand for")

    def member(self, number: int, index: int) -> tuple[int, int]:
        """Where a member begins among the numbers of a value, and its type."""
        one = self[number]
        if one.kind is Kind.STRUCT:
            return sum(map(self.size, one.parts[:index])), one.parts[index]
        return index * self.size(one.parts[0]), one.parts[0]

    def scalar(self, number: int) -> Kind:
        """The kind of the numbers that a vector, a matrix or an array is made of."""
        one = self[number]
        return self.scalar(one.parts[0]) if one.kind in ROWS else one.kind

    def zeros(self, number: int, zero: Mapping[Kind, str]) -> list[str]:
        """The source of a value that is 0 throughout."""
        one = self[number]
        if one.kind in SCALARS:
            return [zero[one.kind]]
        if one.kind in ROWS:
            return self.zeros(one.parts[0], zero) * one.length
        return [z for part in one.parts for z in self.zeros(part, zero)]
