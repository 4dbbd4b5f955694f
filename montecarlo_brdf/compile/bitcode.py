"""What is kept of numba's work: templates without their model, and a model's functions, each once.

Both are kept on disk as LLVM's bitcode under the hash of all that it depends on, like kernels. A
kernel of a new model needs numba for the model's functions alone, after an edit for those that
changed; the rest is linked.
"""

from __future__ import annotations

import contextlib
import functools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.compile import (
    cache,
    compiler,
    external,
    layout,
    linking,
    native,
    outline,
    sines,
    twins,
)
from montecarlo_brdf.compile.bind import Bound, Called, is_strict
from montecarlo_brdf.compile.cache import Fingerprint
from montecarlo_brdf.compile.external import Kind

#: The files that say how code is generated, as opposed to what it computes.
SOURCES = (twins, compiler, linking, native, layout, external, outline, sines)


class Part(NamedTuple):
    """An LLVM module that is linked into kernels, with one function, and what that returns."""

    returns: Kind
    module: Any


def module_of(template: Bound) -> Any:
    """The LLVM module of a kernel. Raises Unknown if the template cannot do without its model, and
    numba's own errors if something does not compile."""
    found = outline.outlined(template)
    if found is None:
        raise external.Unknown(template.function.__name__)
    units = {call: _unit(call, found.unit(call)) for call in found.calls}
    module = _bare(found.bare({call: unit.returns for call, unit in units.items()})).module.clone()
    for call, symbol in found.calls.items():
        unit = units[call].module.clone()
        unit.get_function(native.ENTRY).name = symbol
        module.link_in(unit)
    for one, symbol in found.layouts.items():
        module.link_in(native.parsed(external.copier(one.places, symbol, found.room)))
    if sines.needed(module):
        module.link_in(native.parsed(sines.text()))
    linking.hide(module, native.ENTRY)
    return module


def name_of(*content: object) -> str:
    """Hash of everything that machine code of this content depends on."""
    found = Fingerprint()
    found.add((native.identity(), _sources(), *content))
    return found.hexdigest()


@functools.cache
def _sources() -> tuple[bytes, ...]:
    return tuple(Path(str(m.__file__)).read_bytes() for m in SOURCES)


def _unit(call: Called, content: Bound) -> Part:
    return _kept(content, lambda: _compiled(call, content))


def _compiled(call: Called, content: Bound) -> tuple[Kind, Any]:
    returns, module = compiler.unit_module(compiler.assembled(content), call.vectors)
    if not is_strict(call.function):
        sines.substitute(module)
    return returns, module


def _bare(template: Bound) -> Part:
    return _kept(template, lambda: ((), compiler.entry_module(compiler.assembled(template))))


_parts: dict[str, Part] = {}  # of this process, by content: a global may have been set since


def _kept(content: Bound, make: Callable[[], tuple[Kind, Any]]) -> Part:
    """From this process, else from disk, else made."""
    name = name_of("part", content)
    if name not in _parts:
        _parts[name] = _read(name) or _written(name, Part(*make()))
    return _parts[name]


def _written(name: str, part: Part) -> Part:
    cache.write(name, json.dumps(part.returns).encode() + b"\n" + part.module.as_bitcode())
    return part


def _read(name: str) -> Part | None:
    """What was stored; nothing where LLVM cannot read it."""
    head, _, code = (cache.read(name) or b"").partition(b"\n")
    with contextlib.suppress(ValueError, RuntimeError):
        return Part(_frozen(json.loads(head)), native.parsed(code))
    return None


def _frozen(kind: Any) -> Kind:
    """Lists of JSON as tuples."""
    return kind if isinstance(kind, str) else tuple(map(_frozen, kind))
