"""Instructions that compute: each gives the source of its result's numbers."""

from __future__ import annotations

from collections.abc import Callable

from montecarlo_brdf.foreign.code import Code
from montecarlo_brdf.foreign.kinds import Kind
from montecarlo_brdf.foreign.module import Operands
from montecarlo_brdf.foreign.opcodes import Op

#: from code and operands, of which the first two are the result's type and number
Rule = Callable[[Code, Operands], list[str]]


def each(pattern: str) -> Rule:
    """A pattern of operands, number by number."""

    def rule(code: Code, a: Operands) -> list[str]:
        operands = [code.value(x) for x in a[2:]]
        return [pattern.format(*row) for row in zip(*operands, strict=True)]

    return rule


def wrapped(pattern: str) -> Rule:
    """The same in whole numbers of 32 bits."""

    def rule(code: Code, a: Operands) -> list[str]:
        found = each(pattern)(code, a)
        return [in_range(text, code.module.types.scalar(a[0])) for text in found]

    return rule


def extended(low: str, high: str) -> Rule:
    """Two words of a result, as a struct of both."""

    def rule(code: Code, a: Operands) -> list[str]:
        kind = code.module.types.scalar(code.module.types[a[0]].parts[0])
        rows = list(zip(*map(code.value, a[2:4]), strict=True))
        lows = [in_range(low.format(*row), kind) for row in rows]
        return lows + [high.format(*row) for row in rows]

    return rule


def of_bits(pattern: str) -> Rule:
    """The same as `wrapped`, of vectors by places that are numbers."""

    def rule(code: Code, a: Operands) -> list[str]:
        operands = [code.value(x) for x in a[2:]]
        size = len(operands[0])
        rows = zip(*(x if len(x) == size else x * size for x in operands), strict=True)
        kind = code.module.types.scalar(a[0])
        return [in_range(pattern.format(*row), kind) for row in rows]

    return rule


def in_range(text: str, kind: Kind) -> str:
    """A whole number modulo 2^32, signed or not."""
    if kind is Kind.UNSIGNED:
        return f"({text}) & 0xFFFFFFFF"
    return f"signed({text})"


def dot(x: list[str], y: list[str]) -> str:
    """The source of x.y."""
    return " + ".join(f"{a} * {b}" for a, b in zip(x, y, strict=True))


def chosen(values: list[str], index: str) -> str:
    """One of some values by a number that varies."""
    text = values[-1]
    for k in range(len(values) - 2, -1, -1):
        text = f"({values[k]} if {index} == {k} else {text})"
    return text


def _extract(code: Code, a: Operands) -> list[str]:
    begin, kind = member_of(code, code.type_of(a[2]), a[3:])
    return code.value(a[2])[begin : begin + code.module.types.size(kind)]


def _insert(code: Code, a: Operands) -> list[str]:
    begin, kind = member_of(code, code.type_of(a[3]), a[4:])
    found = list(code.value(a[3]))
    found[begin : begin + code.module.types.size(kind)] = code.value(a[2])
    return found


def member_of(code: Code, kind: int, places: Operands) -> tuple[int, int]:
    """Where a member of a member begins, and its type."""
    begin = 0
    for place in places:
        further, kind = code.module.types.member(kind, place)
        begin += further
    return begin, kind


def _shuffle(code: Code, a: Operands) -> list[str]:
    both = [*code.value(a[2]), *code.value(a[3])]
    zero = code.module.numerals.zeros[code.module.types.scalar(a[0])]
    return [both[i] if i < len(both) else zero for i in a[4:]]


def _extract_at(code: Code, a: Operands) -> list[str]:
    return [chosen(code.value(a[2]), code.value(a[3])[0])]


def _insert_at(code: Code, a: Operands) -> list[str]:
    new, place = code.value(a[3])[0], code.value(a[4])[0]
    return [f"({new} if {place} == {k} else {x})" for k, x in enumerate(code.value(a[2]))]


def _scaled(code: Code, a: Operands) -> list[str]:
    scale = code.value(a[3])[0]
    return [f"{x} * {scale}" for x in code.value(a[2])]


def _matrix_times_vector(code: Code, a: Operands) -> list[str]:
    matrix, vector = code.value(a[2]), code.value(a[3])
    rows = code.module.types.size(a[0])
    return [dot(matrix[i::rows], vector) for i in range(rows)]


def _vector_times_matrix(code: Code, a: Operands) -> list[str]:
    vector, matrix = code.value(a[2]), code.value(a[3])
    n = len(vector)
    return [dot(vector, matrix[k : k + n]) for k in range(0, len(matrix), n)]


def _matrix_times_matrix(code: Code, a: Operands) -> list[str]:
    left, right = code.value(a[2]), code.value(a[3])
    result = code.module.types[a[0]]
    rows = code.module.types.size(result.parts[0])
    inner = len(left) // rows
    columns = [right[k : k + inner] for k in range(0, len(right), inner)]
    return [dot(left[i::rows], column) for column in columns for i in range(rows)]


def _transpose(code: Code, a: Operands) -> list[str]:
    matrix, columns = code.value(a[2]), code.module.types[code.type_of(a[2])].length
    rows = len(matrix) // columns
    return [matrix[c * rows + r] for r in range(rows) for c in range(columns)]


def _outer(code: Code, a: Operands) -> list[str]:
    return [f"{x} * {y}" for y in code.value(a[3]) for x in code.value(a[2])]


def _select(code: Code, a: Operands) -> list[str]:
    condition, yes, no = map(code.value, a[2:5])
    condition = condition * len(yes) if len(condition) == 1 else condition
    rows = zip(condition, yes, no, strict=True)
    return [f"{y} if {c} else {n}" for c, y, n in rows]


def _bitcast(code: Code, a: Operands) -> list[str]:
    old, new, values = code.kind(a[2]), code.module.types.scalar(a[0]), code.value(a[2])
    if old is Kind.FLOAT and new is not Kind.FLOAT:
        return [in_range(f"float_to_bits({x})", new) for x in values]
    if new is Kind.FLOAT and old is not Kind.FLOAT:
        return [f"bits_to_float({x})" for x in values]
    return [x if old is new else in_range(x, new) for x in values]


def _converted(code: Code, a: Operands) -> list[str]:
    return [code.module.numerals.converted(x) for x in code.value(a[2])]


def _shifted_right(code: Code, a: Operands) -> list[str]:
    found = [f"({x} & 0xFFFFFFFF) >> {y}" for x, y in zip(*map(code.value, a[2:4]), strict=True)]
    unsigned = code.module.types.scalar(a[0]) is Kind.UNSIGNED
    return found if unsigned else [f"signed({text})" for text in found]


def _as_it_is(code: Code, a: Operands) -> list[str]:
    return list(code.value(a[2]))


ORDERED = {"LESS_THAN": "<", "GREATER_THAN": ">", "LESS_THAN_EQUAL": "<=",
           "GREATER_THAN_EQUAL": ">="}  # fmt: skip
OPPOSITE = {"<": ">=", ">": "<=", "<=": ">", ">=": "<"}
RULES: dict[int, Rule] = {
    Op.F_ADD: each("{} + {}"), Op.F_SUB: each("{} - {}"), Op.F_MUL: each("{} * {}"),
    Op.F_DIV: each("{} / {}"), Op.F_NEGATE: each("-{}"),
    Op.F_MOD: each("modulo({}, {})"), Op.F_REM: each("remainder({}, {})"),
    Op.I_ADD: wrapped("{} + {}"), Op.I_SUB: wrapped("{} - {}"), Op.I_MUL: wrapped("{} * {}"),
    Op.S_NEGATE: wrapped("-{}"), Op.SHIFT_LEFT_LOGICAL: wrapped("{} << {}"),
    Op.NOT: wrapped("~{}"), Op.U_DIV: each("quotient({}, {})"), Op.S_DIV: each("quotient({}, {})"),
    Op.U_MOD: each("rest({}, {})"), Op.S_MOD: each("rest({}, {})"),
    Op.S_REM: each("{0} - {1} * quotient({0}, {1})"),
    Op.SHIFT_RIGHT_LOGICAL: _shifted_right, Op.SHIFT_RIGHT_ARITHMETIC: each("{} >> {}"),
    Op.BITWISE_OR: each("{} | {}"), Op.BITWISE_XOR: each("{} ^ {}"),
    Op.BITWISE_AND: each("{} & {}"),
    Op.I_EQUAL: each("{} == {}"), Op.I_NOT_EQUAL: each("{} != {}"),
    Op.F_ORD_EQUAL: each("{} == {}"), Op.F_UNORD_NOT_EQUAL: each("{} != {}"),
    Op.F_ORD_NOT_EQUAL: each("({0} < {1} or {0} > {1})"),
    Op.F_UNORD_EQUAL: each("not ({0} < {1} or {0} > {1})"),
    Op.LOGICAL_EQUAL: each("{} == {}"), Op.LOGICAL_NOT_EQUAL: each("{} != {}"),
    Op.LOGICAL_OR: each("{} or {}"), Op.LOGICAL_AND: each("{} and {}"),
    Op.LOGICAL_NOT: each("not {}"),
    Op.ANY: lambda code, a: [" or ".join(code.value(a[2]))],
    Op.ALL: lambda code, a: [" and ".join(code.value(a[2]))],
    Op.IS_NAN: each("{0} != {0}"), Op.IS_INF: each("abs({}) == INF"),
    Op.SELECT: _select, Op.BITCAST: _bitcast,
    Op.CONVERT_F_TO_S: each("whole({})"), Op.CONVERT_F_TO_U: wrapped("whole({})"),
    Op.CONVERT_S_TO_F: _converted, Op.CONVERT_U_TO_F: _converted,
    Op.U_CONVERT: _as_it_is, Op.S_CONVERT: _as_it_is, Op.F_CONVERT: _as_it_is,
    Op.COPY_OBJECT: _as_it_is, Op.COPY_LOGICAL: _as_it_is,
    Op.UNDEF: lambda code, a: code.module.types.zeros(a[0], code.module.numerals.zeros),
    Op.COMPOSITE_CONSTRUCT: lambda code, a: [x for part in a[2:] for x in code.value(part)],
    Op.COMPOSITE_EXTRACT: _extract, Op.COMPOSITE_INSERT: _insert,
    Op.VECTOR_SHUFFLE: _shuffle, Op.VECTOR_EXTRACT_DYNAMIC: _extract_at,
    Op.VECTOR_INSERT_DYNAMIC: _insert_at,
    Op.VECTOR_TIMES_SCALAR: _scaled, Op.MATRIX_TIMES_SCALAR: _scaled,
    Op.DOT: lambda code, a: [dot(*map(code.value, a[2:4]))],
    Op.MATRIX_TIMES_VECTOR: _matrix_times_vector, Op.VECTOR_TIMES_MATRIX: _vector_times_matrix,
    Op.MATRIX_TIMES_MATRIX: _matrix_times_matrix, Op.TRANSPOSE: _transpose,
    Op.OUTER_PRODUCT: _outer,
    Op.I_ADD_CARRY: extended("{} + {}", "({} + {}) >> 32"),
    Op.I_SUB_BORROW: extended("{} - {}", "({} - {}) >> 32 & 1"),
    Op.U_MUL_EXTENDED: extended("{} * {}", "high_word({}, {})"),
    Op.S_MUL_EXTENDED: extended("{} * {}", "high_word({}, {})"),
    Op.BIT_FIELD_INSERT: of_bits("with_field({}, {}, {}, {})"),
    Op.BIT_FIELD_U_EXTRACT: of_bits("field({}, {}, {})"),
    Op.BIT_FIELD_S_EXTRACT: of_bits("signed_field({}, {}, {})"),
    Op.BIT_REVERSE: of_bits("reversed_bits({})"), Op.BIT_COUNT: of_bits("bit_count({})"),
}  # fmt: skip
for _name, _sign in ORDERED.items():
    RULES |= {Op[f"{kind}_{_name}"]: each(f"{{}} {_sign} {{}}") for kind in ("S", "U", "F_ORD")}
    RULES[Op[f"F_UNORD_{_name}"]] = each(f"not {{}} {OPPOSITE[_sign]} {{}}")


def compute(code: Code, op: int, a: Operands) -> bool:
    """Write an instruction that computes; False for one that does not."""
    rule = RULES.get(op)
    if rule is not None:
        code.let(a[1], a[0], rule(code, a))
    return rule is not None
