"""The source of one Python function as it is written: lines, names, and what values are called."""

from __future__ import annotations

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.kinds import Kind
from montecarlo_brdf.foreign.module import Function, Module

#: how names of variables begin that are written more than once
CHANGING = ("q", "g", "w", "o")


class Code:
    """Every value of the shader is a list of names or literals, one for each of its numbers."""

    def __init__(self, module: Module, function: Function) -> None:
        self.module, self.function = module, function
        self.lines: list[str] = []
        self.depth = 1
        self.types: dict[int, int] = {}
        self._values: dict[int, list[str]] = {}
        self._count = 0

    def put(self, text: str) -> None:
        """Add a line."""
        self.lines.append(" " * self.depth + text)

    def name(self, begin: str, number: int, kind: int) -> list[str]:
        """Names for the numbers of a value, and from here on the value itself."""
        size = self.module.types.size(kind)
        self._values[number] = [f"{begin}{number}_{i}" for i in range(size)]
        self.types[number] = kind
        return self._values[number]

    def let(self, number: int, kind: int, expressions: list[str]) -> None:
        """A value: what is no name yet, or one that may change, is given a name of its own."""
        names = []
        for i, text in enumerate(expressions):
            name = f"v{number}_{i}"
            if text.isidentifier() and not text.startswith(CHANGING):
                name = text
            else:
                self.put(f"{name} = {text}")
            names.append(name)
        self._values[number], self.types[number] = names, kind

    def once(self, text: str) -> str:
        """The name of a number that is used several times."""
        self._count += 1
        self.put(f"t{self._count} = {text}")
        return f"t{self._count}"

    def value(self, number: int) -> list[str]:
        """The names of a value's numbers."""
        if number in self._values:
            return self._values[number]
        if number in self.module.constants:
            return self.module.constants[number].numbers
        raise Complaint(f"a value of {self.module.name(self.function.number)} is not understood")

    def type_of(self, number: int) -> int:
        """The type of a value."""
        known = self.module.constants
        return self.types[number] if number in self.types else known[number].type

    def kind(self, number: int) -> Kind:
        """What the numbers of a value are."""
        return self.module.types.scalar(self.type_of(number))
