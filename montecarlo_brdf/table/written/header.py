"""A header for C and C++, with checks of its own that a compiler makes.

Arrays have the first axis last, so that it runs fastest: table[j][i] is the texel (i, j). Halves
are 16-bit words, to be copied to the GPU as they are.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table.axes import Axis
from montecarlo_brdf.table.polynomial import Fit
from montecarlo_brdf.table.written.finished import Finished, Number, bound, rounded

INDICES = "ijk"
WIDTH = 96
LITERAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[fF]?")
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)


def write(table: Finished, name: str, number: Number, fit: Fit | None = None) -> bytes:
    """The file; `name` begins every identifier; with a polynomial also functions of it."""
    guard = f"{name.upper()}_H"
    half = number is Number.HALF
    lines = [*_comment(table), f"#ifndef {guard}", f"#define {guard}", ""]
    lines += ["#include <stdint.h>"] if half else ["#include <float.h>"]
    lines += ["", "#ifdef __cplusplus", f"#define {guard}_CHECK static_assert", "#else",
              f"#define {guard}_CHECK _Static_assert", "#endif", ""]  # fmt: skip
    sizes = ", ".join(f"{name.upper()}_{a.name.upper()}_SIZE = {a.size}" for a in table.axes)
    lines += [f"enum {{ {sizes} }};", ""]
    kind = "uint16_t" if half else "float"
    if half:
        lines.append(f'{guard}_CHECK(sizeof(uint16_t) == 2, "a half is a word of 16 bits");')
    else:
        lines.append(
            f'{guard}_CHECK(sizeof(float) == 4 && FLT_MANT_DIG == 24, "float is IEEE single");'
        )
    for quantity in table.values:
        lines += ["", *_array(table, name, quantity, number, kind), *_checks(table, name, quantity,
                  kind, guard)]  # fmt: skip
    for k, quantity in enumerate(table.values):
        if fit is None:
            break
        arguments = ", ".join(f"float {a.name}" for a in table.axes)
        lines += ["", f"/* a polynomial in place of {quantity} */",
                  f"static inline float {name}_{quantity}_fit({arguments})", "{",
                  *(f"    const float {x} = {text};" for x, text in fit.letters("f").items()),
                  f"    return {fit.text(k, 'f')};", "}"]  # fmt: skip
    lines += ["", f"#undef {guard}_CHECK", f"#endif /* {guard} */", ""]
    return "\n".join(lines).encode()


def _comment(table: Finished) -> list[str]:
    """What the arrays are."""
    order = "".join(f"[{INDICES[k]}]" for k in reversed(range(len(table.axes))))
    facts = table.facts
    lines = [f"{table.title}", f"made by: {facts['command']}", f"arrays are {order}, where"]
    for k, axis in enumerate(table.axes):
        lines.append(f"  {_told(axis, k)}"
                     f"  ({axis.placement})")  # fmt: skip
    lines.append(f"certified: {facts['confidence']:.6g} that no value is farther from the truth "
                 "than its _error")  # fmt: skip
    return ["/*", *(f" * {line.replace('*/', '* /')}" for line in lines), " */"]


def _told(axis: Axis, k: int) -> str:
    """'alpha = (j + 0.5)/64'."""
    name, equals, rest = axis.told().partition(" = ")
    return name + equals + re.sub(r"\bi\b", INDICES[k], rest)


def _array(
    table: Finished, name: str, quantity: str, number: Number, kind: str
) -> list[str]:
    sizes = [f"{name.upper()}_{a.name.upper()}_SIZE" for a in table.axes]
    inner = "".join(f"[{s}]" for s in reversed(sizes[:-1]))
    values = rounded(table.values[quantity].T, number)
    error = np.nextafter(np.float32(bound(table, quantity, number)), np.float32(np.inf))
    head = f"/* {quantity}, each within {name}_{quantity}_error */"
    return [head, f"static const float {name}_{quantity}_error = {literal(error)};",
            f"static const {kind} {name}_{quantity}[]{inner} = {{",
            *_body(values, number), "};"]  # fmt: skip


def _body(values: NDArray[np.floating], number: Number) -> list[str]:
    """Nested braces, the lines not too long."""
    if values.ndim > 1:
        return [line for row in values for line in ("{", *_body(row, number), "},")]
    words = [word(x) if number is Number.HALF else literal(x) for x in values]
    lines, line = [], ""
    for text in words:
        if len(line) + len(text) + 2 > WIDTH:
            lines.append(line.rstrip())
            line = ""
        line += f"{text}, "
    return [*lines, line.rstrip()]


def literal(value: np.floating) -> str:
    """A float with as many digits as tell it from all others."""
    if not np.isfinite(value):
        raise UserError("a C header has no literal for a value that is not finite")
    text = np.format_float_scientific(np.float32(value), unique=True, trim="0")
    return f"{text}f"


def word(value: np.floating) -> str:
    """The bits of a half."""
    if not np.isfinite(value):
        raise UserError("a half has no room for a value of the table")
    return f"0x{int(np.float16(value).view(np.uint16)):04x}"


def _checks(table: Finished, name: str, quantity: str, kind: str, guard: str) -> list[str]:
    """That no value was lost on the way to the compiler."""
    total = " * ".join(str(a.size) for a in table.axes)
    return [f'{guard}_CHECK(sizeof({name}_{quantity}) == {total} * sizeof({kind}), '
            f'"{name}_{quantity} has {total} values");']  # fmt: skip


def numbers(text: str) -> NDArray[np.float64]:
    """All numbers within the outermost braces of a C file's first array."""
    plain = COMMENT.sub(" ", text)
    start = re.search(r"=\s*\{", plain)
    if not start:
        raise UserError("it has no array: name[] = { ... }")
    depth, end = 0, start.end()
    for k in range(start.end() - 1, len(plain)):
        depth += (plain[k] == "{") - (plain[k] == "}")
        if depth == 0:
            end = k
            break
    found = [t.rstrip("fF") for t in LITERAL.findall(plain[start.end() : end])]
    return np.array(found, dtype=float)
