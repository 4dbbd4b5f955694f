"""The text of a model file whose functions are C: `CALL_f`, `CALL_pdf`, ... stand for those."""

from __future__ import annotations

from collections.abc import Iterator

from montecarlo_brdf.foreign import members
from montecarlo_brdf.foreign.description import Cosine, Description, Measure
from montecarlo_brdf.foreign.entry import Entry
from montecarlo_brdf.foreign.members import field_name


def text(name: str, said: Description, found: list[Entry], linked: bool) -> str:
    """The whole file. linked: kernels have the code itself and need no addresses."""
    fields = [field_name(k) for p in said.parameters for k in p.fields()]
    head = [repr(members.doc(f"{name}: a model in C.", said)), "from typing import NamedTuple"]
    body = [members.params(said, False)]
    if not linked:
        body += _addresses([one.name for one in found], fields)
    body += _functions(said, {one.name for one in found}, fields, linked)
    return "\n".join(head) + "\n\n\n" + "\n\n".join([*body, *members.members(said, False)]) + "\n"


def _addresses(names: list[str], fields: list[str]) -> list[str]:
    """Parameters with the places of functions, which are others in every process."""
    both = [*(f"at_{n}" for n in names), *fields]
    given = [*(f"float(CALL_{n}.find())" for n in names), *(f"p.{k}" for k in fields)]
    kind = "\n".join(["class Prepared(NamedTuple):", *(f"    {k}: float" for k in both)])
    return [kind, f"def prepare(p):\n    return Prepared({', '.join(given)})"]


def _functions(
    said: Description, names: set[str], fields: list[str], linked: bool
) -> Iterator[str]:
    def call(name: str, second: str) -> str:
        given = [f"wo[{k}]" for k in range(3)] + [f"{second}[{k}]" for k in range(3)]
        given += [f"p.{k}" for k in fields]
        return f"CALL_{name}({'0.0' if linked else f'p.at_{name}'}, ({', '.join(given)}))"

    over = " / wi[2]" if said.cosine is Cosine.INCLUDED else ""
    yield f"def f(wo, wi, p):\n    return {call('f', 'wi')}[0]{over}"
    if "pdf" in names:
        times = " * wi[2]" if said.measure is Measure.PROJECTED else ""
        yield f"def pdf(wo, wi, p):\n    return {call('pdf', 'wi')}[0]{times}"
    if "sample" in names:
        weight = f"(*{call('sample', 'u')}, {call('weight', 'u')}[0])"
        drawn = weight if "weight" in names else call("sample", "u")
        yield f"def sample(wo, u, p):\n    return {drawn}"
