"""A shader's entry and all that it calls as Python functions of numbers.

Pointers that functions are given, and global variables, are more arguments and more results: all
functions are pure, and any number of threads may run them.
"""

from __future__ import annotations

from montecarlo_brdf.foreign import arithmetic, library
from montecarlo_brdf.foreign.code import Code
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.flow import Flow
from montecarlo_brdf.foreign.kinds import Kind
from montecarlo_brdf.foreign.memory import PRIVATE, Memory
from montecarlo_brdf.foreign.module import Function, Instruction, Module, Operands
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.opcodes import Op

DERIVATIVES = range(Op.D_PDX, Op.FWIDTH_COARSE + 1)
IMAGES = range(Op.SAMPLED_IMAGE, Op.IMAGE_QUERY_LEVELS + 1)
#: instructions that touch a variable
TOUCHING = (Op.LOAD, Op.STORE, Op.ACCESS_CHAIN, Op.IN_BOUNDS_ACCESS_CHAIN, Op.FUNCTION_CALL,
            Op.COPY_MEMORY)  # fmt: skip

RESULTS = "return RESULTS"  # of the entry, until all are known


class Source:
    """Python functions, the entry last; what the entry takes and gives; tables."""

    def __init__(self, binary: bytes, name: str, numerals: Numerals) -> None:
        self.name = name
        self.module = Module(binary, numerals)
        self.tables: dict[str, list[str]] = {}
        self._texts: list[str] = []
        self._written: dict[int, Writer] = {}
        self._globals: dict[int, set[int]] = {}
        entry = self.writer(self.module.entry)
        self.arguments = sorted(entry.memory.arguments)
        self.results = sorted(entry.memory.results)
        self.text = "\n".join(self._texts)

    def writer(self, number: int) -> Writer:
        """A function, written before whatever calls it."""
        if number not in self._written:
            self._written[number] = writer = Writer(self, self.module.functions[number])
            self._texts.append(writer.write())
        return self._written[number]

    def globals_of(self, number: int) -> set[int]:
        """The module's own variables that a function and those it calls touch."""
        if number not in self._globals:
            found: set[int] = set()
            for op, a in self.module.functions[number].instructions():
                if op == Op.FUNCTION_CALL:
                    found |= self.globals_of(a[2])
                if op in TOUCHING:
                    found |= {x for x in a if self._is_own(x)}
            self._globals[number] = found
        return self._globals[number]

    def _is_own(self, number: int) -> bool:
        variable = self.module.variables.get(number)
        return variable is not None and variable.storage == PRIVATE


class Writer:
    """One function."""

    def __init__(self, source: Source, function: Function) -> None:
        self.source, self.function, self.module = source, function, source.module
        self.outermost = function.number == self.module.entry
        self.name = source.name if self.outermost else f"{source.name}_{function.number}"
        self.code = Code(self.module, function)
        self.memory = Memory(self.code, source.tables, self.outermost)
        self.own = sorted(source.globals_of(function.number) - self.memory.constant())
        self.parameters: list[str] = []
        self.given_back: list[str] = []  # what pointers and globals hold in the end

    def write(self) -> str:
        """The source."""
        self._arguments()
        self._globals()
        flow = Flow(self.code, self._perform, self._leave)
        flow.write()
        if self.outermost:
            self.parameters = [f"a{k}" for k in sorted(self.memory.arguments)]
        zero = self.module.numerals.real(0.0)
        first = [f" o{k} = {zero}" for k in sorted(self.memory.results)]
        first += [" jump = 0"] if flow.jumps else []
        head = f"def {self.name}({', '.join(self.parameters)}):"
        results = _returned([f"o{k}" for k in sorted(self.memory.results)])
        body = [line.replace(RESULTS, results) for line in self.code.lines]
        return "\n".join([head, *first, *body, ""])

    def _arguments(self) -> None:
        for number, kind in self.function.parameters:
            one = self.module.types[kind]
            if one.kind is Kind.POINTER:
                names = self.memory.hold(number, one.parts[0], "q")
                self.given_back += names
                self.code.types[number] = kind
            else:
                names = self.code.name("p", number, kind)
            self.parameters += names

    def _globals(self) -> None:
        for number in self.own:
            variable = self.module.variables[number]
            names = self.memory.hold(number, variable.type, "g")
            if not self.outermost:
                self.parameters += names
                self.given_back += names
                continue
            zeros = self.module.types.zeros(variable.type, self.module.numerals.zeros)
            initial = self.code.value(variable.initial) if variable.initial else zeros
            for name, value in zip(names, initial, strict=True):
                self.code.put(f"{name} = {value}")

    def _leave(self, last: Instruction) -> None:
        """A return, or what stands for it."""
        if self.outermost:
            self.code.put(RESULTS)
            return
        if last.op == Op.KILL:
            raise Complaint("discard is used: return 0 in its place")
        values = self.code.value(last.a[0]) if last.op == Op.RETURN_VALUE else []
        if last.op == Op.UNREACHABLE:
            zeros = self.module.numerals.zeros
            values = self.module.types.zeros(self.function.result, zeros)
        self.code.put(_returned([*values, *self.given_back]))

    def _perform(self, op: int, a: Operands) -> None:
        if arithmetic.compute(self.code, op, a) or self.memory.perform(op, a):
            return
        if op == Op.EXT_INST:
            for pointer, values in library.call(self.code, a):
                self.memory.store(pointer, values)
        elif op == Op.FUNCTION_CALL:
            self._call(a)
        elif op in DERIVATIVES:
            raise Complaint("a derivative (dFdx, ddx) is used: give its value as a parameter")
        elif op in IMAGES:
            raise Complaint("a texture is sampled: write a stub for the function that does")
        else:
            raise Complaint(f"instruction {op} of SPIR-V is used, which is not known")

    def _call(self, a: Operands) -> None:
        called = self.source.writer(a[2])
        given, back = list[str](), list[str]()
        for (_, kind), argument in zip(called.function.parameters, a[3:], strict=True):
            if self.module.types[kind].kind is Kind.POINTER:
                back += self.memory.names(argument)
                given += self.memory.load(argument)
            else:
                given += self.code.value(argument)
        for number in called.own:
            given += self.memory.names(number)
            back += self.memory.names(number)
        results = self.code.name("v", a[1], a[0])
        left = "".join(f"{name}, " for name in [*results, *back])
        self.code.put(f"{left}{'= ' if left else ''}{called.name}({', '.join(given)})")


def _returned(values: list[str]) -> str:
    return f"return ({''.join(f'{v}, ' for v in values)})"
