"""The text of a model file from a shader's functions: what an author would write in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from montecarlo_brdf.foreign import entry, members, runtime
from montecarlo_brdf.foreign.description import Cosine, Description, Measure
from montecarlo_brdf.foreign.members import CHANNEL, about, field_name
from montecarlo_brdf.foreign.numerals import Numerals
from montecarlo_brdf.foreign.python import Source

RUNTIME = "montecarlo_brdf.foreign.runtime"
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
        said = members.members(self.said, self.coloured)
        body = "\n\n".join([*self._tables(), *self._functions(), *said])
        known = sorted({*runtime.__all__} & {*re.findall(r"\w+", body)})
        imports = f"from {RUNTIME}{'_single' if self.numerals.single else ''} import "
        doc = members.doc(f"{self.name}: a shader.", self.said)
        head = [repr(doc), "from typing import NamedTuple"]
        if "math." in body:
            head.append("import math")
        if "array(" in body:
            head.append("from numpy import array")
        if self.numerals.single:
            head.append("STRICT = True")
        if known:
            head.append(f"{imports}{', '.join(known)}")
        return "\n".join(head) + f"\n\n\n{members.params(self.said, self.coloured)}\n\n{body}\n"

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
