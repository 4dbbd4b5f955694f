"""How numba generates the functions of a kernel: each is kept as generated and linked only once.

Left to itself numba optimises a function, turns it into machine code, and does both again in
every function that calls it. A kernel is a tower of small functions that are all inlined into one
loop, so that this is most of LLVM's work and none of its use. Here a function's code waits as a
`Part` until a kernel is linked from all parts that it reaches.
"""

from __future__ import annotations

import functools
import types
from collections.abc import Iterator
from typing import Any


@functools.cache
def pipeline() -> Any:
    """numba's own pipeline but for its last step: the code becomes a part, not a program."""
    from numba import _dynfunc  # type: ignore[attr-defined]
    from numba.core import codegen, compiler, compiler_machinery, typed_passes, untyped_passes

    _skip_linear_algebra()

    class Part(codegen.JITCodeLibrary):  # type: ignore[misc]
        """The code of one function."""

        def add_llvm_module(self, module: Any) -> None:
            self._final_module.link_in(module)

        def finalize(self) -> None:
            self._finalized = True

    def handle(library: Any, fndesc: Any, env: Any) -> Any:
        """By what numba knows a compiled function; nothing calls it."""
        name = fndesc.qualname.split(".")[-1]
        return _dynfunc.make_function(fndesc.lookup_module(), name, "", 0, env, (library,))

    def stored(context: Any, builder: Any, kind: Any, array: Any) -> Any:
        """A table in the code itself, of any size: numba would keep the address of a large one,
        which means nothing to the next process that finds the code on disk."""
        context.allow_dynamic_globals = False
        try:
            return type(context).make_constant_array(context, builder, kind, array)
        finally:
            context.allow_dynamic_globals = True

    @compiler_machinery.register_pass(mutates_CFG=True, analysis_only=False)
    class Lowering(typed_passes.NativeLowering):  # type: ignore[misc]
        _name = "lowering_to_a_part"

        def run_pass(self, state: Any) -> bool:
            state.library = Part(state.targetctx.codegen(), state.func_id.func_qualname)
            context = state.targetctx  # this function's own
            context.get_executable = handle
            context.make_constant_array = functools.partial(stored, context)
            return bool(super().run_pass(state))

    class Compiler(compiler.CompilerBase):  # type: ignore[misc]
        def needless(self) -> set[Any]:
            """Steps that change nothing in this function."""
            nested = any(isinstance(c, types.CodeType) for c in self.state.func_id.code.co_consts)
            arrays = typed_passes.NopythonRewrites  # makes array expressions one loop
            return {arrays} if nested else {arrays, untyped_passes.InlineClosureLikes}

        def define_pipelines(self) -> list[Any]:
            usual = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
            manager = compiler_machinery.PassManager("parts")
            swap = {typed_passes.NativeLowering: Lowering}
            kept = [step for step in usual.passes if step[0] not in self.needless()]
            manager.passes = [(swap.get(step, step), told) for step, told in kept]
            manager.finalize()
            return [manager]

    return Compiler


def _skip_linear_algebra() -> None:
    """Keep numba from importing scipy.linalg just to see whether it is there: it is, and it takes
    half as long as numba itself. A function that needs it still imports it."""
    from numba.np import linalg

    check = linalg.ensure_blas
    linalg.ensure_blas = lambda: None
    try:
        from numba.np import arraymath
    finally:
        linalg.ensure_blas = check
    arraymath.ensure_blas = check  # type: ignore[attr-defined]


def linked(library: Any, name: str, entry: str) -> Any:
    """One LLVM module: function `name` of a part, called `entry`, and what it reaches."""
    module = library._final_module
    for other in _reached(library):
        module.link_in(other._get_module_for_linking(), preserve=True)
    for function in module.functions:
        if function.name == name:
            function.name = entry
    hide(module, entry)
    return module


def hide(module: Any, entry: str) -> None:
    """Leave nothing but the entry to be seen from outside."""
    for value in (*module.functions, *module.global_variables):
        if not value.is_declaration:
            value.linkage = "external" if value.name == entry else "internal"


def _reached(library: Any) -> Iterator[Any]:
    """The libraries that a part needs, each once; those that are no parts have linked theirs."""
    waiting, seen = list(library._linking_libraries), {id(library)}
    while waiting:
        other = waiting.pop()
        if id(other) in seen:
            continue
        seen.add(id(other))
        yield other
        if type(other) is type(library):
            waiting += other._linking_libraries
