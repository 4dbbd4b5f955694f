"""The members of a model file that a description makes, as source: all but its functions."""

from __future__ import annotations

import contextlib
import keyword
from collections.abc import Iterator

from montecarlo_brdf.foreign import formula, parameter_sets
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import Cosine, Description, Measure, Parameter, Type

CHANNEL = "channel"  # the parameter that says which number of a colour f returns


def doc(first: str, said: Description) -> str:
    """The docstring: a first line, what is bound, what was found."""
    lines = [f"{k} = {e}" for k, e in expressions(said)]
    lines += [f"found: {one}" for one in said.found]
    return "\n".join([first, "", *lines])


def params(said: Description, coloured: bool) -> str:
    """The class Params."""
    lines = [
        f"    {field_name(k)}: {_annotation(p)} = {int(v) if _is_counted(p) else v!r}"
        for p in said.parameters for k, v in p.fields().items()
    ]  # fmt: skip
    if coloured:
        lines.append(f"    {CHANNEL}: int = (0.0, 1.0, 2.0)")
    return "\n".join(["class Params(NamedTuple):", *(lines or ["    pass"])])


def members(said: Description, coloured: bool) -> Iterator[str]:
    """All others."""
    domain = {
        field_name(k): p.ends for p in said.parameters if p.ends for k in p.fields()
    }
    if domain:
        yield f"domain = {domain!r}"
    fields = [field_name(k) for p in said.parameters for k in p.fields()]
    if said.lobe:
        kind, _, width = said.lobe.partition(":")
        with about("lobe"):
            yield f"lobe = ({kind.strip()!r}, lambda p: {formula.source(width, fields)})"
    if said.albedo:
        with about("albedo"):
            value = formula.source(said.albedo, fields, ("mu",))
        yield f"def albedo(mu, p):\n    return {value}"
    yield from _sets(said, coloured)
    yield from (f"{name} = {value!r}" for name, value in said.members.items())


def _sets(said: Description, coloured: bool) -> Iterator[str]:
    """Members that are parameter sets, which have a channel each if f is a colour."""
    known = {p.name: [field_name(k) for k in p.fields()] for p in said.parameters}
    known |= {k: [k] for fields in known.values() for k in fields}
    channels = [{CHANNEL: float(k)} for k in range(3)] if coloured else [{}]
    for key in ("verified", "lossless"):
        text = getattr(said, key)
        if text in ("true", "false"):
            yield f"{key} = {text == 'true'}"
        elif text:
            with about(key):
                sets = [one | c for one in parameter_sets.every(text, known) for c in channels]
            yield f"{key} = [{', '.join(f'Params(**{one!r})' for one in sets)}]"
    if said.limits:
        with about("limits"):
            yield f"limits = {parameter_sets.limits(said.limits, known)!r}"


def expressions(said: Description) -> Iterator[tuple[str, str]]:
    """What is bound to what."""
    for name in ("before", "f", "pdf", "sample", "weight"):
        value = " ".join(getattr(said, name).split())
        if value:
            yield name, value
    if said.cosine is Cosine.INCLUDED:
        yield "cosine", said.cosine
    if said.measure is Measure.PROJECTED:
        yield "measure", said.measure


def _is_counted(one: Parameter) -> bool:
    return one.type in (Type.WHOLE, Type.SWITCH)


def _annotation(one: Parameter) -> str:
    """What a field of Params is declared as."""
    return "int" if _is_counted(one) else "float"


@contextlib.contextmanager
def about(key: str) -> Iterator[None]:
    """What is wrong meanwhile is said of a key of the description."""
    try:
        yield
    except Complaint as error:
        raise Complaint(f"key {key}: {error}") from None


def field_name(name: str) -> str:
    """A name that Python allows for a field."""
    name = name.lstrip("_") or "x"
    return f"{name}_" if keyword.iskeyword(name) or name in ("count", "index", CHANNEL) else name
