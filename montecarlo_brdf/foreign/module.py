"""From the words of SPIR-V to types, constants, variables and functions."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.kinds import Kind, Type, Types
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.opcodes import Op

MAGIC = 0x07230203
HEADER = 5  # words
Operands = tuple[int, ...]


class Instruction(NamedTuple):
    """One instruction: what it does and the words after that."""

    op: int
    a: Operands


class Constant(NamedTuple):
    """A value that is known: its type and the source of its numbers."""

    type: int
    numbers: list[str]


class Variable(NamedTuple):
    """A global variable: its type, where it is stored, and the number of its first value."""

    type: int
    storage: int
    initial: int | None


class Function:
    """A function: its result's type, blocks of instructions by label."""

    def __init__(self, number: int, result: int) -> None:
        self.number, self.result = number, result
        self.parameters: list[tuple[int, int]] = []  # (number, type)
        self.blocks: dict[int, list[Instruction]] = {}

    def instructions(self) -> Iterator[Instruction]:
        """All of them."""
        for block in self.blocks.values():
            yield from block


def words_of(binary: bytes) -> tuple[int, ...]:
    """The 32-bit words of a module."""
    words = struct.unpack(f"<{len(binary) // 4}I", binary[: len(binary) // 4 * 4])
    if len(words) < HEADER or words[0] != MAGIC:
        raise Complaint("its compiler gave no SPIR-V")
    return words


def instructions(words: tuple[int, ...]) -> Iterator[tuple[int, Operands]]:
    """(number, operands) of every instruction, in their order."""
    place = HEADER
    while place < len(words):
        count, op = words[place] >> 16, words[place] & 0xFFFF
        if count == 0:
            raise Complaint("its compiler gave damaged SPIR-V")
        yield op, words[place + 1 : place + count]
        place += count


def text_of(words: Operands) -> str:
    """A string that is packed into words."""
    return struct.pack(f"<{len(words)}I", *words).split(b"\0")[0].decode(errors="replace")


class Module:
    """A shader as SPIR-V has it."""

    def __init__(self, binary: bytes, numerals: Numerals) -> None:
        self.numerals = numerals
        self.types = Types()
        self.constants: dict[int, Constant] = {}
        self.variables: dict[int, Variable] = {}
        self.functions: dict[int, Function] = {}
        self.names: dict[int, str] = {}
        self.members: dict[tuple[int, int], str] = {}
        self.entry = 0
        self._inside: Function | None = None
        self._block: list[Instruction] | None = None
        for op, a in instructions(words_of(binary)):
            self._take(op, a)

    def name(self, number: int) -> str:
        """What the author calls it."""
        return self.names.get(number, "a value")

    def _take(self, op: int, a: Operands) -> None:
        if op in (Op.LINE, Op.NO_LINE):
            return
        if op == Op.FUNCTION:
            self._inside = self.functions[a[1]] = Function(a[1], a[0])
        elif op == Op.FUNCTION_END:
            self._inside = self._block = None
        elif self._inside is None:
            self._declare(op, a)
        elif op == Op.FUNCTION_PARAMETER:
            self._inside.parameters.append((a[1], a[0]))
        elif op == Op.LABEL:
            self._block = self._inside.blocks[a[0]] = []
        elif self._block is not None:
            self._block.append(Instruction(op, a))

    def _declare(self, op: int, a: Operands) -> None:
        """What stands before the functions."""
        if op == Op.NAME:
            self.names[a[0]] = text_of(a[1:])
        elif op == Op.MEMBER_NAME:
            self.members[a[0], a[1]] = text_of(a[2:])
        elif op == Op.ENTRY_POINT:
            self.entry = a[1]
        elif op == Op.VARIABLE:
            pointed = self.types[a[0]].parts[0]
            self.variables[a[1]] = Variable(pointed, a[2], a[3] if len(a) > 3 else None)
        elif Op.TYPE_VOID <= op <= Op.TYPE_FUNCTION:
            self.types[a[0]] = self._type(op, a)
        elif op in CONSTANTS:
            self.constants[a[1]] = Constant(a[0], self._numbers(op, a))

    def _type(self, op: int, a: Operands) -> Type:
        if op == Op.TYPE_INT:
            return Type(Kind.SIGNED if a[2] else Kind.UNSIGNED, width=a[1])
        if op == Op.TYPE_FLOAT:
            return Type(Kind.FLOAT, width=a[1])
        if op == Op.TYPE_ARRAY:
            return Type(Kind.ARRAY, (a[1],), int(self.constants[a[2]].numbers[0]))
        if op == Op.TYPE_POINTER:
            return Type(Kind.POINTER, (a[2],), storage=a[1])
        if op == Op.TYPE_STRUCT:
            return Type(Kind.STRUCT, a[1:])
        if op in (Op.TYPE_VECTOR, Op.TYPE_MATRIX):
            return Type(Kind.VECTOR if op == Op.TYPE_VECTOR else Kind.MATRIX, (a[1],), a[2])
        return Type(PLAIN.get(op, Kind.OTHER), a[1:2])

    def _numbers(self, op: int, a: Operands) -> list[str]:
        """The source of a constant's numbers."""
        if op in (Op.CONSTANT_TRUE, Op.SPEC_CONSTANT_TRUE):
            return ["True"]
        if op in (Op.CONSTANT_FALSE, Op.SPEC_CONSTANT_FALSE):
            return ["False"]
        if op == Op.CONSTANT_COMPOSITE:
            return [x for part in a[2:] for x in self.constants[part].numbers]
        if op in (Op.CONSTANT_NULL, Op.UNDEF):
            return self.types.zeros(a[0], self.numerals.zeros)
        return [self.numerals.literal(self.types[a[0]], a[2:])]


PLAIN: dict[int, Kind] = {
    Op.TYPE_VOID: Kind.VOID, Op.TYPE_BOOL: Kind.BOOL, Op.TYPE_RUNTIME_ARRAY: Kind.ENDLESS,
}  # fmt: skip
CONSTANTS = {
    Op.CONSTANT_TRUE, Op.CONSTANT_FALSE, Op.CONSTANT, Op.CONSTANT_COMPOSITE, Op.CONSTANT_NULL,
    Op.SPEC_CONSTANT_TRUE, Op.SPEC_CONSTANT_FALSE, Op.SPEC_CONSTANT, Op.UNDEF,
}  # fmt: skip
