"""True albedos by our references; those that take a quadrature stay on disk.

A quadrature takes a millisecond, but numpy, which it needs, a quarter of a warm run to import. The
values of a model lie in a file that is named by the hash of everything they depend on, so that
none outlives an edit of the references, another release of numpy or another processor.
"""

from __future__ import annotations

import functools
import hashlib
import json
from pathlib import Path

from montecarlo_brdf import references
from montecarlo_brdf.compile import cache, native
from montecarlo_brdf.judge.claim import Kind, Reference


def true_albedo(name: str, mu_o: float, /, **parameters: float | str) -> Reference | None:
    """A(theta_o) by `references.albedo`, or as it was when it was last asked for.

    name: a built-in model; mu_o: cos(theta_o), above 0; its parameters, picks and, for a model that
    is not isotropic, phi_o in radians. None if no reference tells.
    """
    question = repr((mu_o, sorted(parameters.items())))
    values = _values(_file(name))
    if question not in values:
        truth = references.albedo(name, mu_o, **parameters)
        if truth is None:
            return None
        known = Reference.of(*truth)
        if known.kind is Kind.CLOSED_FORM:
            return known
        values[question] = known
        cache.note(_file(name), json.dumps([question, *values[question]]))
    return values[question]


@functools.cache
def _values(file: str) -> dict[str, Reference]:
    lines = [json.loads(line) for line in cache.notes(file)]
    return {question: Reference.of(*truth) for question, *truth in lines}


@functools.cache
def _file(name: str) -> str:
    return hashlib.blake2b(f"{name} {_dependencies()}".encode(), digest_size=16).hexdigest()


@functools.cache
def _dependencies() -> str:
    """The source of all references, what they compute with, and how lines are written here."""
    content = hashlib.blake2b(repr(native.identity()).encode() + Path(__file__).read_bytes())
    for package in ("numpy", "scipy"):
        content.update(native.release(package).encode())
    for path in sorted(Path(str(references.__file__)).parent.glob("*.py")):
        content.update(path.read_bytes())
    return content.hexdigest()
