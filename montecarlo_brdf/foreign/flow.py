"""Structured control flow of SPIR-V as Python's: if, while, break, continue.

A loop, and a switch as a loop of one trip, is a `while True`. A jump that leaves two of them at
once sets `jump` and breaks; after the inner one the outer asks for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from montecarlo_brdf.foreign.code import Code
from montecarlo_brdf.foreign.module import Instruction, Operands
from montecarlo_brdf.foreign.opcodes import Op

#: instructions that end a block
ENDS = (Op.BRANCH, Op.BRANCH_CONDITIONAL, Op.SWITCH, Op.RETURN, Op.RETURN_VALUE, Op.KILL,
        Op.UNREACHABLE)  # fmt: skip
Stops = frozenset[int]
NOWHERE: Stops = frozenset()


class Loop:
    """A loop or a switch that is open: the labels where it ends, goes on, and begins."""

    def __init__(self, merge: int, goes_on: int | None, head: int | None) -> None:
        self.merge, self.goes_on, self.head = merge, goes_on, head
        self.pending: dict[int, int] = {}  # label outside -> number of the jump

    def labels(self) -> tuple[int | None, ...]:
        """Where a jump of it may lead."""
        return self.merge, self.goes_on, self.head


class Flow:
    """Writes the blocks of a function; `perform` writes an instruction, `leave` a return."""

    def __init__(
        self,
        code: Code,
        perform: Callable[[int, Operands], None],
        leave: Callable[[Instruction], None],
    ) -> None:
        self._code, self._perform, self._leave = code, perform, leave
        self._blocks = code.function.blocks
        self._loops: list[Loop] = []
        self.jumps: dict[int, int] = {}

    def write(self) -> None:
        """All blocks, from the first."""
        for op, a in self._code.function.instructions():
            if op == Op.PHI:
                self._code.name("h", a[1], a[0])
        self._region(next(iter(self._blocks)), NOWHERE)

    def _region(self, label: int, stops: Stops) -> None:
        """What follows from a block until one of the stops."""
        following: int | None = label
        while following is not None and following not in stops:
            loop = _first(self._blocks[following], Op.LOOP_MERGE)
            if loop and not (self._loops and self._loops[-1].head == following):
                self._open(Loop(loop[0], loop[1], following))
                self._region(following, frozenset([loop[0]]))
                self._close()
                following = loop[0]
            else:
                following = self._block(following, stops)

    def _block(self, label: int, stops: Stops) -> int | None:
        """One block and what branches from it; where control goes on, None if nowhere."""
        block = self._blocks[label]
        for op, a in block:
            if op not in (*ENDS, Op.PHI, Op.LOOP_MERGE, Op.SELECTION_MERGE):
                self._perform(op, a)
        last, merge = block[-1], _first(block, Op.SELECTION_MERGE)
        if last.op == Op.BRANCH:
            return None if self._edge(label, last.a[0], stops) else last.a[0]
        if last.op == Op.BRANCH_CONDITIONAL:
            return self._condition(label, last.a, merge[0] if merge else None, stops)
        if last.op == Op.SWITCH:
            assert merge
            return self._switch(label, last.a, merge[0], stops)
        self._leave(last)
        return None

    def _condition(self, label: int, a: Operands, merge: int | None, stops: Stops) -> int | None:
        inner = stops | ({merge} if merge is not None else set())
        self._code.put(f"if {self._code.value(a[0])[0]}:")
        self._arm(label, a[1], inner)
        self._code.put("else:")
        self._arm(label, a[2], inner)
        return merge

    def _switch(self, label: int, a: Operands, merge: int, stops: Stops) -> int:
        selector, inner = self._code.value(a[0])[0], stops | {merge}
        self._open(Loop(merge, None, None))
        tests = list(_cases(a, selector))
        for n, (case, test) in enumerate(tests):
            self._code.put(f"{'elif' if n else 'if'} {test}:")
            self._arm(label, case, inner - {case})
        if tests:
            self._code.put("else:")
            self._arm(label, a[1], inner)
        elif not self._edge(label, a[1], inner):
            self._region(a[1], inner)
        if not self._has_left():
            self._code.put("break")
        self._close()
        return merge

    def _has_left(self) -> bool:
        """Whether the last line leaves the loop that is open."""
        last = self._code.lines[-1]
        here = len(last) - len(last.lstrip()) == self._code.depth
        return here and last.strip() in ("break", "continue")

    def _open(self, loop: Loop) -> None:
        self._code.put("while True:")
        self._code.depth += 1
        self._loops.append(loop)

    def _close(self) -> None:
        loop = self._loops.pop()
        self._code.depth -= 1
        for target, number in loop.pending.items():
            self._code.put(f"if jump == {number}:")
            self._code.depth += 1
            self._code.put("jump = 0")
            self._jump(target)
            self._code.depth -= 1

    def _arm(self, label: int, to: int, stops: Stops) -> None:
        """One side of a branch, indented."""
        self._code.depth += 1
        before = len(self._code.lines)
        if not self._edge(label, to, stops):
            self._region(to, stops)
        if len(self._code.lines) == before:
            self._code.put("pass")
        self._code.depth -= 1

    def _edge(self, label: int, to: int, stops: Stops) -> bool:
        """Give the target's phis their values; True where control leaves this region."""
        self._phis(label, to)
        jumps = any(to in loop.labels() for loop in self._loops)
        merges = {loop.merge for loop in self._loops}
        if jumps and (to not in stops or to in merges):
            self._jump(to)
            return True
        return to in stops

    def _jump(self, to: int) -> None:
        """Go to where a loop or a switch ends or goes on."""
        loop = self._loops[-1]
        if to == loop.head:
            self._code.put("continue")
        elif to == loop.goes_on:
            loop.goes_on = None
            self._region(to, NOWHERE)
            loop.goes_on = to
        elif to == loop.merge:
            self._code.put("break")
        else:
            number = self.jumps.setdefault(to, len(self.jumps) + 1)
            self._code.put(f"jump = {number}")
            self._code.put("break")
            loop.pending[to] = number

    def _phis(self, label: int, to: int) -> None:
        names, values = list[str](), list[str]()
        for op, a in self._blocks[to]:
            if op == Op.PHI:
                for value, source in zip(a[2::2], a[3::2], strict=True):
                    if source == label:
                        names += self._code.value(a[1])
                        values += self._code.value(value)
        if names:
            self._code.put(f"{', '.join(names)} = {', '.join(values)}")


def _first(block: list[Instruction], op: int) -> Operands | None:
    return next((i.a for i in block if i.op == op), None)


def _cases(a: Operands, selector: str) -> Iterator[tuple[int, str]]:
    """Every label of a switch but the default's, and when it is gone to."""
    pairs = list(zip(a[2::2], a[3::2], strict=True))
    for label in dict.fromkeys(label for _, label in pairs if label != a[1]):
        values = [value - (value >> 31 << 32) for value, to in pairs if to == label]
        yield label, " or ".join(f"{selector} == {value}" for value in values)
