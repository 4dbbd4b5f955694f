"""One entry out of a module that has several: compiled together, each is a program of its own."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.module import HEADER, Operands, instructions, text_of, words_of
from montecarlo_brdf.foreign.opcodes import Op

One = tuple[int, Operands]
#: what is said of a value that may be gone
ABOUT = (Op.NAME, Op.DECORATE)
GIVING_NOTHING = (Op.STORE, Op.COPY_MEMORY, Op.BRANCH, Op.BRANCH_CONDITIONAL, Op.SWITCH, Op.RETURN,
                  Op.RETURN_VALUE, Op.KILL, Op.UNREACHABLE, Op.SELECTION_MERGE, Op.LOOP_MERGE,
                  Op.LINE, Op.NO_LINE, Op.FUNCTION_END)  # fmt: skip


def alone(binary: bytes, name: str) -> bytes:
    """The module with the function `name`, which has no arguments, in the place of its main, and
    without any other that this does not reach."""
    words = words_of(binary)
    every = list(instructions(words))
    ids = {text_of(a[1:]): a[0] for op, a in every if op == Op.NAME}
    if f"{name}(" not in ids:
        raise Complaint("its compiler gave no names")
    functions = dict(_functions(every))
    kept = _reached(functions, ids[f"{name}("])
    main = next(a[1] for op, a in every if op == Op.ENTRY_POINT)
    first = next(k for k, (op, _) in enumerate(every) if op == Op.FUNCTION)
    head = [_renamed(one, main, ids[f"{name}("]) for one in every[:first]]
    body = [one for number, lines in functions.items() if number in kept for one in lines]
    gone = [one for number, lines in functions.items() if number not in kept for one in lines]
    given = (a[:1] if op == Op.LABEL else a[1:2] for op, a in gone if op not in GIVING_NOTHING)
    lost = {number for one in given for number in one}
    head = [(op, a) for op, a in head if op not in ABOUT or a[0] not in lost]
    out = list(words[:HEADER])
    for op, a in (*head, *body):
        out += ((len(a) + 1) << 16 | op, *a)
    return struct.pack(f"<{len(out)}I", *out)


def _functions(every: list[One]) -> Iterator[tuple[int, list[One]]]:
    """The instructions of each function by its number."""
    lines: list[One] = []
    for op, a in every:
        lines = [] if op == Op.FUNCTION else lines
        lines.append((op, a))
        if op == Op.FUNCTION_END:
            yield lines[0][1][1], lines


def _reached(functions: dict[int, list[One]], first: int) -> set[int]:
    """What a function calls, itself included."""
    found, waiting = set[int](), {first}
    while waiting:
        found.add(number := waiting.pop())
        waiting |= {a[2] for op, a in functions[number] if op == Op.FUNCTION_CALL} - found
    return found


def _renamed(one: One, main: int, entry: int) -> One:
    """What is said of main, said of the entry."""
    op, a = one
    if op == Op.ENTRY_POINT:
        return op, (a[0], entry, *a[2:])
    return (op, (entry, *a[1:])) if op == Op.EXECUTION_MODE and a[0] == main else one
