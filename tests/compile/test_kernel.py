"""Kernels: found on disk, compiled our way, or by numba's public way where ours breaks.

A mistake in the model's code is a sentence, a break in the compiler never is.
"""
from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.compile import bitcode, cache, compiler, kernel, linking, native
from montecarlo_brdf.compile.cache import Fingerprint
from montecarlo_brdf.compile.kernel import Kernel
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """A process in which nothing was compiled, and an empty cache."""
    monkeypatch.setattr(kernel, "_told", [])
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path / "kernels"))
    forget(monkeypatch)
    yield
    compiler.specialiser.cache_clear()


def forget(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever this process has compiled."""
    monkeypatch.setattr(kernel, "_kernels", {})
    monkeypatch.setattr(bitcode, "_parts", {})
    compiler.specialiser.cache_clear()


def gone(*_: Any, **__: Any) -> Any:
    """What a private part of another release may do."""
    raise AttributeError("module 'numba.core.codegen' has no attribute 'JITCodeLibrary'")


#: private parts of numba and llvmlite: when functions become parts, when parts are linked, when an
#: object is loaded
BREAKS: list[tuple[Any, str]] = [(linking, "pipeline"), (linking, "linked"), (native, "load")]


SOME = [pytest.param(*b, marks=[pytest.mark.slow] * (b is not BREAKS[0])) for b in BREAKS]


@pytest.mark.parametrize(("module", "name"), SOME, ids=[name for _, name in BREAKS])
def test_a_compiler_that_breaks_is_no_mistake_of_the_user(
    fresh: None,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    user_file: Any,
    module: Any,
    name: str,
) -> None:
    """It is said once, and the run goes on by numba's public way with the same numbers."""
    model = mb.load(str(user_file("def f(wo, wi, p):\n    return 0.1 + 0.1 * wi[2]\n")))
    usual = directional_albedo(model, model.parameters(), 45.0, sampler="cosine", samples=1 << 10)
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path / "empty"))
    forget(monkeypatch)
    monkeypatch.setattr(module, name, gone)
    found = directional_albedo(model, model.parameters(), 45.0, sampler="cosine", samples=1 << 10)
    assert capsys.readouterr().err.count("numba's public way") == 1
    assert np.isclose(found.mean, usual.mean, rtol=1e-14, atol=0.0)


def test_a_mistake_of_the_user_stays_one_where_the_compiler_breaks(
    cli: Callable[..., Any], fresh: None, monkeypatch: pytest.MonkeyPatch, user_file: Any
) -> None:
    text = "def f(wo, wi, p):\n    return 0.1 + 0.0 * hash(object())\n"
    path = user_file(text, "typed.py")
    assert cli("furnace", "--model", path).code == 4
    monkeypatch.setattr(linking, "linked", gone)
    found = cli("furnace", "--model", path)
    assert found.code == 4 and "does not compile" in found.err


def test_a_model_that_raises_is_told_whichever_way_it_is_compiled(
    fresh: None, monkeypatch: pytest.MonkeyPatch, user_file: Any
) -> None:
    raising = "    if wi[2] < 0.5:\n        raise ValueError('no')\n"
    text = f"def f(wo, wi, p):\n{raising}    return 0.1\n"
    path = str(user_file(text, "raising.py"))
    for broken in (False, True):
        if broken:
            monkeypatch.setattr(linking, "linked", gone)
            monkeypatch.setattr(kernel, "_kernels", {})
        functions = Pointwise(mb.load(path), mb.load(path).parameters())
        with pytest.raises(ModelError, match="raised an exception"):
            functions.f((0.0, 0.0, 1.0), (np.sqrt(0.96), 0.0, 0.2))


def test_single_precision_functions_of_libc_need_no_run_time(fresh: None, user_file: Any) -> None:
    """A model that calls one is stored on disk like any other, not compiled anew every time."""
    functions = ("arccos", "arcsin", "arctan", "sinh", "cosh", "tan", "log10", "log1p", "expm1")
    functions += ("hypot", "fmax", "rint", "trunc", "fabs", "floor", "ceil", "log2", "arcsinh")
    calls = [f"float(np.{n}(F(wi[2])))" for n in functions if n not in ("hypot", "fmax")]
    calls += [f"float(np.{n}(F(wi[2]), F(0.5)))" for n in ("hypot", "fmax")]
    body = " + ".join(calls)
    text = f"import numpy as np\nF = np.float32\ndef f(wo, wi, p):\n    return 0.01 * abs({body})\n"
    model = mb.load(str(user_file(text, "single.py")))
    layout, _ = pack([model.parameters()], moments.QUERY)
    mean = integrand(model, Quantity.ALBEDO, "cosine")
    made = moments.kernel_of(model.name, "sobol", [mean], layout)
    assert made.entry and cache.read(made.key) is not None


def test_classes_of_numpy_are_values_like_others() -> None:
    """`from numpy import float32` in a model's file."""
    prints = []
    for kind in (np.float32, np.float64):
        content = Fingerprint()
        content.add(kind)
        prints.append(content.hexdigest())
    assert prints[0] != prints[1]


def test_a_status_is_never_ignored() -> None:
    made = Kernel(kernel.bound(gone), "mine")
    made._entry = lambda ints, reals, out: 1
    with pytest.raises(ModelError, match="model mine raised an exception"):
        made(0, 0, 0)


def test_pieces_cover_all_items_once_however_the_pace_changes() -> None:
    made = Kernel(kernel.bound(gone), "mine")
    for pace in (None, 1e-9, 1e-3, 10.0):
        made.pace = pace
        spans = []
        for start, count in made.pieces(1000, 3):
            spans += range(start, start + count)
        assert spans == list(range(1000))


def test_whoever_compiles_knows_a_typing_error() -> None:
    from numba.core.errors import TypingError

    assert compiler.is_mistake(TypingError("cannot determine the type"))
    assert not compiler.is_mistake(AttributeError("no attribute"))
