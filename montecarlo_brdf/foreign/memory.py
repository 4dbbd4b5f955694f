"""Variables and pointers: what they point to is a few Python variables, or an argument, or a table.

Our own entry reads and writes one buffer at constant places: these become the arguments and the
results. Anything else from outside that is read is told by its name.
"""

from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.foreign.arithmetic import chosen
from montecarlo_brdf.foreign.code import Code
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.kinds import Kind
from montecarlo_brdf.foreign.module import Constant, Module, Operands
from montecarlo_brdf.foreign.opcodes import Op

PRIVATE = 6  # storage of a module's own variables
INPUT, UNIFORM = 1, 2
BUFFERS = (UNIFORM, 12)
#: numbers from which on an array of constants becomes a table of the module
LARGE = 17


class Chain(NamedTuple):
    """A pointer into what another one points to."""

    base: int
    places: Operands


class Place(NamedTuple):
    """What a pointer points to: names; `chosen_by` chooses among several rows of them."""

    type: int
    rows: list[list[str]]
    chosen_by: str | None = None

    @property
    def names(self) -> list[str]:
        """Those of a pointer that is known."""
        return self.rows[0]


class Slot(NamedTuple):
    """A number of our own buffer."""

    number: int


class Row(NamedTuple):
    """Some numbers of a table, from a place that may vary."""

    table: str
    begin: str
    size: int
    kind: Kind


class Memory:
    """The variables of one function."""

    def __init__(self, code: Code, tables: dict[str, list[str]], outermost: bool) -> None:
        self.code, self.outermost = code, outermost
        self.arguments: set[int] = set()
        self.results: set[int] = set()
        self._tables = tables
        self._places: dict[int, Place | Chain] = {}
        self._constant = _constant_arrays(code)

    def constant(self) -> set[int]:
        """The variables that are tables."""
        return set(self._constant)

    def hold(self, number: int, kind: int, begin: str) -> list[str]:
        """Python variables for what a pointer points to."""
        names = [f"{begin}{number}_{i}" for i in range(self.code.module.types.size(kind))]
        self._places[number] = Place(kind, [names])
        return names

    def perform(self, op: int, a: Operands) -> bool:
        """Write an instruction on memory; False for another."""
        if op == Op.VARIABLE:
            self._declare(a)
        elif op in (Op.ACCESS_CHAIN, Op.IN_BOUNDS_ACCESS_CHAIN):
            self._places[a[1]] = Chain(a[2], a[3:])
        elif op == Op.LOAD:
            self.code.let(a[1], a[0], self.load(a[2]))
        elif op == Op.STORE:
            self.store(a[0], self.code.value(a[1]))
        elif op == Op.COPY_MEMORY:
            self.store(a[0], self.load(a[1]))
        else:
            return False
        return True

    def load(self, pointer: int) -> list[str]:
        """The numbers that a pointer points to."""
        place = self._place(pointer)
        if isinstance(place, Slot):
            self.arguments.add(place.number)
            return [f"a{place.number}"]
        if isinstance(place, Row):
            return self._looked_up(place)
        if place.chosen_by is None:
            return list(place.names)
        columns = zip(*place.rows, strict=True)
        return [chosen(list(column), place.chosen_by) for column in columns]

    def store(self, pointer: int, values: list[str]) -> None:
        """Write the assignments to what a pointer points to."""
        if pointer in self._constant:
            return
        place = self._place(pointer)
        if isinstance(place, Slot):
            self.results.add(place.number)
            self.code.put(f"o{place.number} = {values[0]}")
        elif isinstance(place, Row):
            raise Complaint("a constant array is written")
        else:
            self._assign(place, values)

    def names(self, pointer: int) -> list[str]:
        """The variables behind a pointer that is handed on."""
        place = self._place(pointer)
        if not isinstance(place, Place) or place.chosen_by is not None:
            raise Complaint("an element of an array is handed to an inout argument")
        return place.names

    def _assign(self, place: Place, values: list[str]) -> None:
        for k, row in enumerate(place.rows):
            for name, value in zip(row, values, strict=True):
                kept = f" if {place.chosen_by} == {k} else {name}" if place.chosen_by else ""
                self.code.put(f"{name} = {value}{kept}")

    def _declare(self, a: Operands) -> None:
        if a[1] in self._constant:
            return
        types = self.code.module.types
        kind = types[a[0]].parts[0]
        zeros = types.zeros(kind, self.code.module.numerals.zeros)
        initial = self.code.value(a[3]) if len(a) > 3 else zeros
        for name, value in zip(self.hold(a[1], kind, "w"), initial, strict=True):
            self.code.put(f"{name} = {value}")

    def _place(self, pointer: int) -> Place | Slot | Row:
        base, places = pointer, tuple[int, ...]()
        while isinstance(found := self._places.get(base), Chain):
            base, places = found.base, (*found.places, *places)
        if base in self._constant:
            return self._row(self._constant[base], places)
        if found is None:
            return self._slot(base, places)
        return self._inside(found, places)

    def _inside(self, place: Place, places: Operands) -> Place:
        """A member of what a pointer points to."""
        types, known = self.code.module.types, self.code.module.constants
        for number in places:
            if number in known:
                begin, kind = types.member(place.type, int(known[number].numbers[0]))
                size = types.size(kind)
                rows = [row[begin : begin + size] for row in place.rows]
                place = Place(kind, rows, place.chosen_by)
                continue
            kind, index = types[place.type].parts[0], self.code.value(number)[0]
            size, count = types.size(kind), types[place.type].length
            rows = [r[k : k + size] for r in place.rows for k in range(0, len(r), size)]
            if place.chosen_by is not None:
                index = self.code.once(f"{place.chosen_by} * {count} + {index}")
            place = Place(kind, rows, index)
        return place

    def _slot(self, base: int, places: Operands) -> Slot:
        """A number of our own buffer, or the complaint about anything else from outside."""
        module = self.code.module
        variable = module.variables.get(base)
        if variable is None:
            raise Complaint("a pointer is used that points to no variable")
        members = module.types[variable.type].parts
        ours = variable.storage in BUFFERS and module.types[variable.type].kind is Kind.STRUCT
        ours = ours and module.types[members[0]].kind is Kind.ENDLESS and self.outermost
        if ours and len(places) == 2 and places[1] in module.constants:
            return Slot(int(module.constants[places[1]].numbers[0]))
        raise Complaint(self._outside(base, places))

    def _outside(self, base: int, places: Operands) -> str:
        """In words, what is read from outside."""
        module = self.code.module
        variable = module.variables[base]
        first = module.constants.get(places[0]) if places else None
        member = module.members.get((variable.type, int(first.numbers[0]))) if first else None
        name = member or module.name(base)
        if module.types[variable.type].kind is Kind.OTHER:
            return f"the texture {name} is sampled: write a stub for it, or give it as a parameter"
        what = "an input of the stage" if variable.storage == INPUT else "a uniform"
        return f"{name} is read, {what}: make it a parameter by `param {name} = ...`"

    def _row(self, constant: Constant, places: Operands) -> Row:
        """Numbers of a constant array."""
        module, terms, kind = self.code.module, ["0"], constant.type
        for number in places:
            if number in module.constants:
                begin, kind = module.types.member(kind, int(module.constants[number].numbers[0]))
                terms.append(str(begin))
            else:
                inner = module.types[kind]
                index = f"min(max({self.code.value(number)[0]}, 0), {inner.length - 1})"
                kind = inner.parts[0]
                terms.append(f"{index} * {module.types.size(kind)}")
        size = module.types.size(kind)
        return Row(self._table(constant), " + ".join(terms), size, module.types.scalar(kind))

    def _table(self, constant: Constant) -> str:
        for name, numbers in self._tables.items():
            if numbers is constant.numbers:
                return name
        name = f"TABLE_{len(self._tables)}"
        self._tables[name] = constant.numbers
        return name

    def _looked_up(self, row: Row) -> list[str]:
        begin = self.code.once(row.begin)
        found = [f"{row.table}[{begin} + {k}]" for k in range(row.size)]
        whole = row.kind is not Kind.FLOAT
        return found if whole else [self.code.module.numerals.converted(x) for x in found]


def _constant_arrays(code: Code) -> dict[int, Constant]:
    """Large arrays that get a constant once and are only read."""
    module, types = code.module, code.module.types
    stored: dict[int, list[int]] = {}
    large: set[int] = set()
    for op, a in code.function.instructions():
        if op == Op.VARIABLE:
            kind = types[a[0]].parts[0]
            if types[kind].kind is Kind.ARRAY and types.size(kind) >= LARGE:
                large.add(a[1])
            if len(a) > 3:
                stored.setdefault(a[1], []).append(a[3])
        elif op == Op.STORE:
            stored.setdefault(a[0], []).append(a[1])
    single = {v: stored[v][0] for v in large if len(stored.get(v, [])) == 1}
    found = {v: module.constants[c] for v, c in single.items() if c in module.constants}
    return found | _constant_globals(code.module)


def _constant_globals(module: Module) -> dict[int, Constant]:
    """The same of the module's own arrays, which nobody writes."""
    every = [i for function in module.functions.values() for i in function.instructions()]
    written = {a[0] for op, a in every if op == Op.STORE}
    chains = (Op.ACCESS_CHAIN, Op.IN_BOUNDS_ACCESS_CHAIN)
    written |= {a[2] for op, a in every if op in chains and a[1] in written}
    found: dict[int, Constant] = {}
    for number, one in module.variables.items():
        large = one.storage == PRIVATE and module.types[one.type].kind is Kind.ARRAY
        if large and module.types.size(one.type) >= LARGE and number not in written:
            known = module.constants.get(one.initial or 0)
            found |= {number: known} if known else {}
    return found
