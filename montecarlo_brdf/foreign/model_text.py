"""The text of a model file from a shader's functions: what an author would write in Python."""

from __future__ import annotations

import contextlib
import keyword
import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from montecarlo_brdf.foreign import entry, formula, parameter_sets, runtime
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import Cosine, Description, Measure, Parameter, Type
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.python import Source

RUNTIME = "montecarlo_brdf.foreign.runtime"
CHANNEL = "channel"  # the parameter that says which number of a colour f returns
LONGEST_TUPLE = 64  # numbers; larger tables are arrays


class Texts(NamedTuple):
    """In double precision, and rounded as the shader is; that one may be empty."""

    double: str
    single: str


class Version:
    """One version of a shader's functions."""

    def __init__(
        self, said: Description, name: str, binaries: Mapping[str, bytes], numerals: Numerals
    ) -> None:
        self.said, self.name, self.numerals = said, name, numerals
        self.sources = {k: _source(b, k, numerals) for k, b in binaries.items()}
        self.first = entry.end(said.parameters)
        self.coloured = _is_coloured(self.sources["f"])

    def text(self) -> str:
        """The whole file."""
        body = "\n\n".join([*self._tables(), *self._functions(), *self._members()])
        known = sorted({*runtime.__all__} & {*re.findall(r"\w+", body)})
        imports = f"from {RUNTIME}{'_single' if self.numerals.single else ''} import "
        head = [repr(self._doc()), "from typing import NamedTuple"]
        if "math." in body:
            head.append("import math")
        if "array(" in body:
            head.append("from numpy import array")
        if self.numerals.single:
            head.append("STRICT = True")
        if known:
            head.append(f"{imports}{', '.join(known)}")
        return "\n".join(head) + f"\n\n\n{self._params()}\n\n{body}\n"

    def _doc(self) -> str:
        lines = [f"{k} = {e}" for k, e in _expressions(self.said)]
        lines += [f"found: {one}" for one in self.said.found]
        return "\n".join([f"{self.name}: a shader.", "", *lines])

    def _params(self) -> str:
        lines = [
            f"    {field_name(k)}: {_annotation(p)} = {int(v) if _is_counted(p) else v!r}"
            for p in self.said.parameters for k, v in p.fields().items()
        ]  # fmt: skip
        if self.coloured:
            lines.append(f"    {CHANNEL}: int = (0.0, 1.0, 2.0)")
        return "\n".join(["class Params(NamedTuple):", *(lines or ["    pass"])])

    def _tables(self) -> Iterator[str]:
        for name, source in self.sources.items():
            for table, numbers in source.tables.items():
                plain = ", ".join(_plain(x) for x in numbers)
                whole = f"array([{plain}])" if len(numbers) > LONGEST_TUPLE else f"({plain},)"
                if self.numerals.single and len(numbers) <= LONGEST_TUPLE:
                    whole = f"({', '.join(numbers)},)"
                yield f"{name}_{table} = {whole}"

    def _functions(self) -> Iterator[str]:
        for name, source in self.sources.items():
            text = re.sub(r"\b(TABLE_\d+\[)", rf"{name}_\1", source.text)
            yield text
        yield self._f()
        if "pdf" in self.sources:
            yield self._pdf()
        if "sample" in self.sources:
            yield self._sample()

    def _f(self) -> str:
        first, second, third = (self._result("f", k) for k in range(3))
        result = first
        if self.coloured:
            last = f"({second} if p.{CHANNEL} == 1.0 else {third})"
            result = f"({first} if p.{CHANNEL} == 0.0 else {last})"
        if self.said.cosine is Cosine.INCLUDED:
            result += " / wi[2]"
        return f"def f(wo, wi, p):\n    x = {self._call('f', 'wi')}\n    return {result}"

    def _pdf(self) -> str:
        times = " * wi[2]" if self.said.measure is Measure.PROJECTED else ""
        call, result = self._call("pdf", "wi"), self._result("pdf", 0)
        return f"def pdf(wo, wi, p):\n    x = {call}\n    return {result}{times}"

    def _sample(self) -> str:
        lines = [f"    x = {self._call('sample', 'u')}"]
        results = [self._result("sample", k) for k in range(3)]
        if "weight" in self.sources:
            lines.append(f"    y = {self._call('weight', 'u')}")
            results.append(self._result("weight", 0).replace("x[", "y["))
        return "\n".join(
            ["def sample(wo, u, p):", *lines, f"    return ({', '.join(results)})"]
        )

    def _result(self, name: str, k: int) -> str:
        """The k-th number that an entry gives, as a double."""
        place = self.sources[name].results.index(self.first + k)
        return f"float(x[{place}])" if self.numerals.single else f"x[{place}]"

    def _call(self, name: str, second: str) -> str:
        given = [f"wo[{k}]" for k in range(3)] + [f"{second}[{k}]" for k in range(3)]
        given += [f"p.{field_name(k)}" for p in self.said.parameters for k in p.fields()]
        used = [given[k] for k in self.sources[name].arguments]
        texts = [f"F({x})" for x in used] if self.numerals.single else used
        return f"{name}_shader({', '.join(texts)})"

    def _members(self) -> Iterator[str]:
        domain = {
            field_name(k): p.ends for p in self.said.parameters if p.ends for k in p.fields()
        }
        if domain:
            yield f"domain = {domain!r}"
        fields = [field_name(k) for p in self.said.parameters for k in p.fields()]
        if self.said.lobe:
            kind, _, width = self.said.lobe.partition(":")
            with about("lobe"):
                yield f"lobe = ({kind.strip()!r}, lambda p: {formula.source(width, fields)})"
        if self.said.albedo:
            with about("albedo"):
                value = formula.source(self.said.albedo, fields, ("mu",))
            yield f"def albedo(mu, p):\n    return {value}"
        yield from self._sets()
        yield from (f"{name} = {value!r}" for name, value in self.said.members.items())

    def _sets(self) -> Iterator[str]:
        """Members that are parameter sets, which have a channel each if f is a colour."""
        known = {p.name: [field_name(k) for k in p.fields()] for p in self.said.parameters}
        known |= {k: [k] for fields in known.values() for k in fields}
        channels = [{CHANNEL: float(k)} for k in range(3)] if self.coloured else [{}]
        for key in ("verified", "lossless"):
            text = getattr(self.said, key)
            if text in ("true", "false"):
                yield f"{key} = {text == 'true'}"
            elif text:
                with about(key):
                    sets = [one | c for one in parameter_sets.every(text, known) for c in channels]
                yield f"{key} = [{', '.join(f'Params(**{one!r})' for one in sets)}]"
        if self.said.limits:
            with about("limits"):
                yield f"limits = {parameter_sets.limits(self.said.limits, known)!r}"


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


def _source(binary: bytes, name: str, numerals: Numerals) -> Source:
    """An entry as Python."""
    with about(name):
        return Source(binary, f"{name}_shader", numerals)


def _is_coloured(source: Source) -> bool:
    """Whether f gives three numbers that differ."""
    given = dict(re.findall(r"^\s*(o\d+) = (\S.*)$", source.text, re.M))
    return len({given.get(f"o{k}") for k in source.results}) > 1


def _plain(text: str) -> str:
    return text.removeprefix("F(").rstrip(")") if text.startswith("F(") else text


def _expressions(said: Description) -> Iterator[tuple[str, str]]:
    for name in ("before", "f", "pdf", "sample", "weight"):
        value = " ".join(getattr(said, name).split())
        if value:
            yield name, value
    if said.cosine is Cosine.INCLUDED:
        yield "cosine", said.cosine
    if said.measure is Measure.PROJECTED:
        yield "measure", said.measure


def field_name(name: str) -> str:
    """A name that Python allows for a field."""
    name = name.lstrip("_") or "x"
    return f"{name}_" if keyword.iskeyword(name) or name in ("count", "index", CHANNEL) else name
