"""What a kernel needs of numba: a model's own functions, and templates once for all models.

Kept parts are never stale and never trusted: one that LLVM cannot read is made again.
"""
from __future__ import annotations

import types
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.compile import bitcode, cache, compiler, folders, kernel
from montecarlo_brdf.compile.bind import Bound
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.estimate.quantity import Quantity, probe_of, second_moment
from montecarlo_brdf.estimate.samplers import functions_of, integrand
from montecarlo_brdf.sampling.directions import Sampler

Write = Callable[..., Path]

WO, WI = (0.6, 0.0, 0.8), (0.0, 0.6, 0.8)
ONE = """
from typing import NamedTuple
class Params(NamedTuple):
    k: float = 0.1
def helper(wi, p):
    return p.k * wi[2]
def f(wo, wi, p):
    return helper(wi, p)
def pdf(wo, wi, p):
    return 0.3 * wi[2]
"""
OTHER = """
from typing import NamedTuple
class Rest(NamedTuple):
    g: float
    pair: tuple
class Params(NamedTuple):
    a: float = 0.1
    b: float = 0.2
    c: float = 0.3
def prepare(p):
    return Rest(p.a, (p.b, p.c))
def f(wo, wi, p):
    return p.g + p.pair[0] * wo[2] + p.pair[1] * wi[1]
"""


class Made(list[str]):
    """What numba was asked to compile: names of templates and of a model's functions."""


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Made]:
    """In an empty cache."""
    found = Made()
    unit, entry = compiler.unit_module, compiler.entry_module

    def units(function: Any, vectors: int) -> Any:
        found.append(function.__globals__["FUNCTION"].py_func.__name__)
        return unit(function, vectors)

    def entries(function: Any) -> Any:
        found.append(function.__name__)
        return entry(function)

    monkeypatch.setattr(compiler, "unit_module", units)
    monkeypatch.setattr(compiler, "entry_module", entries)
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path / "kernels"))
    another_process(monkeypatch)
    yield found
    compiler.specialiser.cache_clear()


def another_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that has compiled nothing."""
    monkeypatch.setattr(kernel, "_kernels", {})
    monkeypatch.setattr(bitcode, "_parts", {})
    compiler.specialiser.cache_clear()


def of(path: Path) -> Pointwise:
    model = mb.load(str(path))
    return Pointwise(model, model.parameters())


def test_templates_are_compiled_once_for_all_models_and_functions_once_each(
    made: Made, user_file: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = of(user_file(ONE, "one.py"))
    assert one.f(WO, WI) == pytest.approx(0.08) and one.pdf(WO, WI) == pytest.approx(0.24)
    assert made == ["f", "values", "pdf"]
    other = of(user_file(OTHER, "other.py"))
    assert other.f(WO, WI) == pytest.approx(0.1 + 0.16 + 0.18)
    assert made[3:] == ["f"]
    another_process(monkeypatch)
    edited = of(user_file(ONE.replace("p.k * wi", "2.0 * p.k * wi"), "one.py"))
    assert edited.f(WO, WI) == pytest.approx(0.16) and edited.pdf(WO, WI) == pytest.approx(0.24)
    assert made[4:] == ["f"]


def test_functions_that_a_kernel_does_not_call_are_not_compiled(
    made: Made, user_file: Write
) -> None:
    """The integrand of f by cosine sampling is bound to all functions of the model."""
    sampler = "\ndef sample(wo, u, p):\n    return hash(object())\n"
    model = mb.load(str(user_file(ONE + sampler)))
    layout, _ = pack([model.parameters()], moments.QUERY)
    mean = integrand(model, Quantity.ALBEDO, Sampler.COSINE)
    assert moments.kernel_of(model.name, "sobol", [mean], layout).entry
    assert made == ["f", "moments"]


def test_a_part_that_llvm_cannot_read_is_made_again(
    made: Made, user_file: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = user_file(ONE)
    of(path).f(WO, WI)
    first = list(made)
    for entry in folders.directory().glob("*.o"):
        for image in (b"", b"x", b"[]\n", b'"float64"\nBC\xc0\xde and no more'):
            cache.write(entry.stem, image)
            assert bitcode._read(entry.stem) is None
    (kept,) = {folders.directory() / f"{e.stem}.o" for e in folders.directory().glob("*.o")} - {
        folders.directory() / f"{name}.o" for name in bitcode._parts
    }
    kept.unlink()  # the kernel itself, or nothing would be linked
    another_process(monkeypatch)
    assert of(path).f(WO, WI) == pytest.approx(0.08)
    assert made == first * 2


@pytest.mark.parametrize(
    "returned", ["np.float32(0.25)", "1", "wi[2] > 2.0 or 0.25", "0.25 if wi[2] > 0.0 else None"]
)
def test_whatever_a_function_returns_is_what_a_kernel_gets(
    made: Made, user_file: Write, returned: str
) -> None:
    """A number of any type; what has no type of its own is compiled as a whole."""
    found = of(user_file(f"import numpy as np\ndef f(wo, wi, p):\n    return {returned}\n"))
    assert found.f(WO, WI) == (1.0 if returned == "1" else 0.25)


def fillers(template: Bound) -> Iterator[object]:
    for _, value in template.names:
        yield from fillers(value) if isinstance(value, Bound) else [value]


def test_no_integrand_knows_its_model() -> None:
    """One function bound by itself, and each kernel of every new model would be compiled whole."""
    model = mb.load("ggx")
    quantities = (Quantity.ALBEDO, Quantity.REVERSE, Quantity.MASS, Quantity.BIHEMISPHERICAL)
    found = [integrand(model, q, s) for q in quantities for s in Sampler]
    found += [second_moment(s, functions_of(model)) for s in (Sampler.UNIFORM, Sampler.COSINE)]
    probes = [probe_of(s, functions_of(model)) for s in Sampler]
    found += [p for p in probes if p]
    own = [v for i in found for v in fillers(i.template) if isinstance(v, types.FunctionType)]
    assert own and all(v.__module__.startswith("montecarlo_brdf.sampling") or
                       v.__module__ == "montecarlo_brdf.estimate.quantity" for v in own)
