"""Models in C: the same values, kernels and sentences as of any other."""
from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.foreign import c_compiler
from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.judge.finding import Verdict

GGX = stored.FOLDER / "c" / "ggx.c"
WO, WI = (0.6, 0.0, 0.8), (-0.28, 0.45, (1.0 - 0.28**2 - 0.45**2) ** 0.5)
ANY = any(True for _ in c_compiler.others(plus=False))
pytestmark = pytest.mark.skipif(not ANY, reason="no C compiler is at hand")
needs_cc = pytest.mark.skipif(not shutil.which("cc"), reason="no cc is at hand")


def is_ggx(model: mb.Model) -> None:
    known = mb.load("ggx")
    assert model.pdf and model.sample and known.pdf
    p, q = model.prepared(model.parameters()), known.parameters(alpha=0.3)
    assert model.f(WO, WI, p) == pytest.approx(0.3126128, abs=5e-8)
    for wo, wi, _ in stored.pairs(50):
        assert model.f(wo, wi, p) == pytest.approx(known.f(wo, wi, q), rel=1e-12)
        assert model.pdf(wo, wi, p) == pytest.approx(known.pdf(wo, wi, q), rel=1e-12)
    report = mb.furnace(model, theta_o_deg=[60.0], sampler=["own"])
    found = {f.quantity: f.value for f in report.results[0].findings}
    assert report.verdict == Verdict.PASS and found["A"] == pytest.approx(0.82171, abs=1e-4)


def test_a_file_of_c_is_a_model() -> None:
    is_ggx(mb.load(str(GGX)))


@needs_cc
def test_a_library_is_a_model(tmp_path: Path) -> None:
    library = tmp_path / "lib.so"
    source = GGX.with_name("library.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
    model = mb.load(f"{library}:brdf")
    assert model.domain == {"alpha": (0.01, 1.0)} and model.prepare
    is_ggx(model)
    with pytest.raises(mb.ModelError, match="lib.so: it has no function lost: double lost"):
        mb.load(f"{library}:lost")


@needs_cc
def test_what_kernels_do_not_have_is_called_by_its_address(tmp_path: Path) -> None:
    path = tmp_path / "a.cpp"
    path.write_text(
        "// brdf-check: before = V o{wo.x, wo.y, wo.z};\n"
        "// brdf-check: f = shade<double>(o, share) / wo.z\n"
        "// brdf-check: param share = 0.5 in [0, 1]\n#include <cstdlib>\n#include \"half.h\"\n"
        "struct V { double x, y, z; };\n"
        "template <class T> T shade(const V& v, T a) { return std::atof(HALF) * a * v.z; }\n"
    )
    (tmp_path / "half.h").write_text('#define HALF "0.5"\n')
    model, up = mb.load(str(path)), (0.0, 0.0, 1.0)
    assert model.f(up, up, model.prepared(model.parameters())) == 0.25
    assert mb.directional_albedo(model, model.parameters(), 0.0).mean == pytest.approx(0.7853982)
    (tmp_path / "half.h").write_text('#define HALF "0.25"\n')
    model = mb.load(str(path))
    assert model.f(up, up, model.prepared(model.parameters())) == 0.125


MISTAKES = {
    "double g(double x) { return *(volatile double *)(long)(x * 1e-9); }":
        "a.c: its f crashed with SIGSEGV at wo = (",
    "double g(double x) { volatile int k = 1; while (k) ; return x; }":
        "a.c: its functions did not return within 2 s",
    "double lost(double); double g(double x) { return lost(x); }":
        "a.c: lost is called and nowhere defined",
    "double g(double x) {\n return x }": "a.c, line 3: ",
    "float other(float x) { return x; }": "a.c, line 1, key f: ",
    "struct s { int k; }; struct s g(double x) { struct s a; return a; }": "a.c, line 1, key f: ",
    '#include "lost.h"': "a.c, line 2: ",
    "": "a.c, line 1, key f: ",
}  # fmt: skip


@needs_cc
@pytest.mark.parametrize("text", MISTAKES, ids=lambda t: t[:24])
def test_a_mistake_is_a_sentence(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.c").write_text(f"// brdf-check: f = g(wo.x)\n{text}\n")
    with pytest.raises(mb.ModelError) as raised:
        mb.load("a.c")
    assert MISTAKES[text] in str(raised.value) and "\n" not in str(raised.value)
    assert raised.value.exit_code == 4


def test_no_compiler_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(c_compiler, "clangs", lambda plus: iter(()))
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(Complaint, match=r"needs a C compiler: .* 'montecarlo-brdf\[native\]'"):
        c_compiler.made("", tmp_path / "a.c", [], plus=False)


def test_other_precisions_are_refused() -> None:
    model = mb.load(str(GGX))
    with pytest.raises(mb.ModelError, match="machine code: it runs in its own precision alone"):
        mb.stress(model, [model.parameters()], precisions=["float32"], quick=True)


def test_a_crash_later_on_is_a_sentence(tmp_path: Path, process: Callable[..., Any]) -> None:
    path = tmp_path / "a.c"
    path.write_text(
        "// brdf-check: f = g(wo.x, share)\n// brdf-check: param share = 0.5 in [0, 1]\n"
        "double g(double x, double share)\n"
        "{ return share > 0.9 ? *(volatile double *)(long)(x * 1e-9) : 0.1; }\n"
    )
    done = process("furnace", "--model", path, "--theta-o", "0", "-p", "share=0.95")
    assert done.code == 4 and done.err.strip().endswith("the model crashed with SIGSEGV")
