"""GLSL's library of functions, by their numbers in "GLSL.std.450"; HLSL and Slang use it too."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from montecarlo_brdf.foreign.arithmetic import dot
from montecarlo_brdf.foreign.code import Code
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.module import Operands

#: source of a result's numbers from code and the arguments' numbers
Rule = Callable[[Code, list[list[str]]], list[str]]
POWER = 26


def each(pattern: str) -> Rule:
    """A pattern of arguments, number by number."""
    return lambda code, args: [pattern.format(*row) for row in zip(*args, strict=True)]


def power(code: Code, args: list[list[str]]) -> list[str]:
    """x^y of x < 0 is undefined: NaN, as where it is exp2(y log2 x), except where the exponent is
    written as a whole number, which drivers turn into products."""
    return [
        f"{x} ** {y}" if is_whole(y) else f"power({x}, {y})" for x, y in zip(*args, strict=True)
    ]


def is_whole(text: str) -> bool:
    """Whether it is the literal of a whole number."""
    try:
        return float(text.removeprefix("F(").strip("()")).is_integer()
    except ValueError:
        return False


def length(code: Code, args: list[list[str]]) -> list[str]:
    """|x|."""
    return [f"sqrt({dot(args[0], args[0])})"]


def distance(code: Code, args: list[list[str]]) -> list[str]:
    """|x - y|."""
    between = [code.once(f"{x} - {y}") for x, y in zip(*args, strict=True)]
    return [f"sqrt({dot(between, between)})"]


def cross(code: Code, args: list[list[str]]) -> list[str]:
    """x cross y."""
    x, y = args
    return [f"{x[i]} * {y[j]} - {y[i]} * {x[j]}" for i, j in ((1, 2), (2, 0), (0, 1))]


def normalize(code: Code, args: list[list[str]]) -> list[str]:
    """x/|x|."""
    scale = code.once(f"inverse_root({dot(args[0], args[0])})")
    return [f"{x} * {scale}" for x in args[0]]


def faceforward(code: Code, args: list[list[str]]) -> list[str]:
    """n, or -n where the reference looks along i."""
    n, i, reference = args
    along = code.once(dot(reference, i))
    zero = code.module.numerals.real(0.0)
    return [f"({x} if {along} < {zero} else -{x})" for x in n]


def reflect(code: Code, args: list[list[str]]) -> list[str]:
    """i - 2 (n.i) n."""
    i, n = args
    twice = code.once(f"{code.module.numerals.real(2.0)} * ({dot(n, i)})")
    return [f"{x} - {twice} * {y}" for x, y in zip(i, n, strict=True)]


def refract(code: Code, args: list[list[str]]) -> list[str]:
    """The refracted direction, 0 where everything is reflected."""
    i, n, (eta,) = args
    one, zero = code.module.numerals.real(1.0), code.module.numerals.real(0.0)
    along = code.once(dot(n, i))
    k = code.once(f"{one} - {eta} * {eta} * ({one} - {along} * {along})")
    normal = code.once(f"{eta} * {along} + sqrt({k} if {k} > {zero} else {zero})")
    rows = zip(i, n, strict=True)
    return [f"({zero} if {k} < {zero} else {eta} * {x} - {normal} * {y})" for x, y in rows]


def cofactor(m: list[str], p: int, q: int, r: int, s: int) -> str:
    """One minor of a matrix of 3 columns."""
    return f"({m[p]} * {m[q]} - {m[r]} * {m[s]})"


def parts(code: Code, args: list[list[str]]) -> list[str]:
    """What is behind the point, and what is before it."""
    whole = [f"truncated({x})" for x in args[0]]
    return [f"{x} - {w}" for x, w in zip(args[0], whole, strict=True)] + whole


def mantissa(code: Code, args: list[list[str]]) -> list[str]:
    """m and e of m 2^e."""
    powers = [code.once(f"binary_exponent({x})") for x in args[0]]
    return [f"scaled({x}, -{e})" for x, e in zip(args[0], powers, strict=True)] + powers


PAIRS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


def minors(code: Code, m: list[str], first: int) -> dict[tuple[int, int], str]:
    """Those of two columns of a mat4, by rows."""
    return {
        (i, j): code.once(cofactor(m, first + i, first + 4 + j, first + j, first + 4 + i))
        for i, j in PAIRS
    }


def laplace(left: dict[tuple[int, int], str], right: dict[tuple[int, int], str]) -> str:
    """The determinant of a mat4 by the minors of its halves."""
    signs = zip(PAIRS, ("", "- ", "+ ", "+ ", "- ", "+ "), reversed(PAIRS), strict=True)
    return " ".join(f"{sign}{left[one]} * {right[other]}" for one, sign, other in signs)


def inverse_of_four(code: Code, m: list[str]) -> list[str]:
    """Of a mat4: its adjugate by the minors of its halves, over its determinant."""
    left, right = minors(code, m, 0), minors(code, m, 8)
    over = code.once(f"{code.module.numerals.real(1.0)} / ({laplace(left, right)})")
    found = [""] * 16
    for column in range(4):  # of m: the row of the inverse
        beside, across = (column ^ 1), (right if column < 2 else left)
        for row in range(4):
            a, b, c = (r for r in range(4) if r != row)
            x, y, z = (m[4 * beside + r] for r in (a, b, c))
            inside = f"{x} * {across[b, c]} - {y} * {across[a, c]} + {z} * {across[a, b]}"
            sign = "-" if (row + column) % 2 else ""
            found[4 * row + column] = f"{sign}({inside}) * {over}"
    return found


def determinant(code: Code, args: list[list[str]]) -> list[str]:
    """Of 2, 3 or 4 columns."""
    m = args[0]
    if len(m) == 4:
        return [f"{m[0]} * {m[3]} - {m[2]} * {m[1]}"]
    if len(m) == 16:
        return [laplace(minors(code, m, 0), minors(code, m, 8))]
    first, second, third = (cofactor(m, *minor) for minor in MINORS[:3])
    return [f"{m[0]} * {first} + {m[3]} * {second} + {m[6]} * {third}"]


MINORS = ((4, 8, 7, 5), (7, 2, 1, 8), (1, 5, 4, 2), (6, 5, 3, 8), (0, 8, 6, 2), (3, 2, 0, 5),
          (3, 7, 6, 4), (6, 1, 0, 7), (0, 4, 3, 1))  # fmt: skip


def inverse(code: Code, args: list[list[str]]) -> list[str]:
    """Of 2, 3 or 4 columns."""
    m = args[0]
    if len(m) == 16:
        return inverse_of_four(code, m)
    over = code.once(f"{code.module.numerals.real(1.0)} / ({determinant(code, args)[0]})")
    if len(m) == 4:
        return [f"{m[3]} * {over}", f"-{m[1]} * {over}", f"-{m[2]} * {over}", f"{m[0]} * {over}"]
    return [f"{cofactor(m, *minor)} * {over}" for minor in MINORS]


MIN, MAX, CLAMP = each("({1} if {1} < {0} else {0})"), each("({1} if {0} < {1} else {0})"), each(
    "clamp({}, {}, {})"
)
FUNCTIONS: dict[int, Rule] = {
    1: each("nearest({})"), 2: each("nearest({})"), 3: each("truncated({})"), 4: each("abs({})"),
    5: each("abs({})"), 6: each("sign({})"), 7: each("whole_sign({})"), 8: each("lower({})"),
    9: each("-lower(-{})"), 10: each("{0} - lower({0})"), 11: each("radians({})"),
    12: each("degrees({})"), 13: each("sin({})"), 14: each("cos({})"), 15: each("tan({})"),
    16: each("asin({})"), 17: each("acos({})"), 18: each("atan({})"), 19: each("sinh({})"),
    20: each("cosh({})"), 21: each("tanh({})"), 22: each("asinh({})"), 23: each("acosh({})"),
    24: each("atanh({})"), 25: each("atan2({}, {})"), POWER: power, 27: each("exp({})"),
    28: each("log({})"), 29: each("exp2({})"), 30: each("log2({})"), 31: each("sqrt({})"),
    32: each("inverse_root({})"), 33: determinant, 34: inverse, 36: parts,
    37: MIN, 38: MIN, 39: MIN,
    40: MAX, 41: MAX, 42: MAX, 43: CLAMP, 44: CLAMP, 45: CLAMP, 46: each("mix({}, {}, {})"),
    48: each("step({}, {})"), 49: each("smoothstep({}, {}, {})"), 50: each("{} * {} + {}"),
    52: mantissa, 53: each("scaled({}, {})"),
    66: length, 67: distance, 68: cross, 69: normalize, 70: faceforward, 71: reflect, 72: refract,
    73: each("lowest_bit({})"), 74: each("highest_bit({})"), 75: each("highest_bit({})"),
    79: MIN, 80: MAX, 81: CLAMP,
}  # fmt: skip


#: what is not known, by its name
OTHERS = {
    54: "packSnorm4x8", 55: "packUnorm4x8", 56: "packSnorm2x16",
    57: "packUnorm2x16", 58: "packHalf2x16", 59: "packDouble2x32", 60: "unpackSnorm2x16",
    61: "unpackUnorm2x16", 62: "unpackHalf2x16", 63: "unpackSnorm4x8", 64: "unpackUnorm4x8",
    65: "unpackDouble2x32", 76: "interpolateAtCentroid", 77: "interpolateAtSample",
    78: "interpolateAtOffset",
}  # fmt: skip


#: functions that give a second result by a pointer, and those that give both in a struct
POINTED = {35: 36, 51: 52}


def call(code: Code, a: Operands) -> Iterator[tuple[int, list[str]]]:
    """Write the call of a function of the library; what it stores, and where."""
    if a[3] in POINTED:
        found = FUNCTIONS[POINTED[a[3]]](code, [code.value(a[4])])
        half = len(found) // 2
        code.let(a[1], a[0], found[:half])
        yield a[5], found[half:]
        return
    rule = FUNCTIONS.get(a[3])
    if rule is None:
        name = OTHERS.get(a[3], f"function {a[3]} of GLSL's library")
        raise Complaint(f"{name} is used, which is not known")
    code.let(a[1], a[0], rule(code, [code.value(x) for x in a[4:]]))
