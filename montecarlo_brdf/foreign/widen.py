"""Doubles for the floats of a module, before anything is folded: folding is double then too."""

from __future__ import annotations

import struct
from collections.abc import Mapping

from montecarlo_brdf.foreign.constants import meant
from montecarlo_brdf.foreign.module import HEADER, Operands, instructions, words_of
from montecarlo_brdf.foreign.numerals import number
from montecarlo_brdf.foreign.opcodes import Op


def widened(binary: bytes, literals: Mapping[float, float]) -> bytes:
    """The same module with all floats double, and constants as the numbers that they stand for."""
    words = words_of(binary)
    out, narrow = list(words[:HEADER]), dict[int, int]()
    for op, a in instructions(words):
        if op == Op.TYPE_FLOAT:
            narrow[a[0]] = a[1]
            a = (a[0], 64, *a[2:])
        elif op in (Op.CONSTANT, Op.SPEC_CONSTANT) and narrow.get(a[0], 64) < 64:
            a = (*a[:2], *_double(meant(number(narrow[a[0]], a[2:]), literals)))
        elif op == Op.F_CONVERT:
            op = Op.COPY_OBJECT
        out += _packed(op, a)
    return struct.pack(f"<{len(out)}I", *out)


def _double(value: float) -> Operands:
    return struct.unpack("<2I", struct.pack("<d", value))


def _packed(op: int, a: Operands) -> Operands:
    return ((len(a) + 1) << 16 | op, *a)
