"""A shader is a model like any other, from its file to a report."""
from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.foreign import glslang, language, translate, translation
from montecarlo_brdf.judge.finding import Verdict

pytestmark = stored.needs_wheel
GGX = stored.SHADERS / "ggx.glsl"


@pytest.mark.parametrize("path", sorted(stored.SHADERS.iterdir()), ids=lambda p: p.name)
def test_plain_and_optimised_spirv_agree(path: Path) -> None:
    shader = translate.opened(path)
    found = language.binaries(shader.text, path, shader.said, shader.folders, shader.files)
    binaries = dict(found)
    both = [translate.texts(shader, binaries, optimise).double for optimise in (False, True)]
    plain, optimised = map(stored.functions, both)
    assert len(both[1]) < len(both[0])
    p = plain["Params"]()
    p = p._replace(channel=1.0) if hasattr(p, "channel") else p
    for wo, wi, _ in stored.pairs(200):
        assert optimised["f"](wo, wi, p) == pytest.approx(plain["f"](wo, wi, p), rel=1e-12)


@pytest.mark.parametrize("name", stored.GGX)
def test_stored_spirv_is_what_the_compiler_gives(name: str) -> None:
    now, then = mb.load(str(stored.SHADERS / name)), stored.model(name)
    for wo, wi, _ in stored.pairs(20):
        value = then.f(wo, wi, then.parameters())
        assert now.f(wo, wi, now.parameters()) == pytest.approx(value, rel=1e-12)
    assert now.domain == then.domain


def test_a_shader_passes_its_furnace() -> None:
    report = mb.furnace(mb.load(str(GGX)), theta_o_deg=(0.0, 60.0))
    found = {(f.quantity, f.where["theta_o_deg"]): f.value for f in report.results[0].findings}
    assert report.verdict == Verdict.PASS
    assert found["A", 60.0] == pytest.approx(0.82171, abs=1e-4)


def changed(tmp_path: Path, name: str, old: str, new: str) -> Path:
    """A copy of the GLSL with one thing changed."""
    text = GGX.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / name
    path.write_text(text.replace(old, new), encoding="utf-8")
    return path


PDF = "visible_pdf(wo, wi, alpha)"
WRONG = [
    ("(4.0 * masked)", "masked", "energy", "factor 4 too much"),
    (PDF, "visible_pdf(wi, wo, alpha)", "pdf", "wo and wi swapped"),
    (PDF, f"{PDF} / wi.z", "furnace", "cos_i is missing"),
]


@pytest.mark.parametrize(("old", "new", "check", "cause"), WRONG)
def test_a_wrong_shader_is_refuted(
    tmp_path: Path, cli: Callable[..., Any], old: str, new: str, check: str, cause: str
) -> None:
    path = changed(tmp_path, "wrong.glsl", old, new)
    done = cli("run", "--model", path, "--check", check, "--effort", "0.1", "--theta-o", "45")
    assert done.code == 1 and cause in " ".join(done.out.split())


def test_a_projected_pdf_is_said(tmp_path: Path) -> None:
    said = "visible_pdf(wo, wi, alpha) / wi.z\n// brdf-check: measure = projected"
    path = changed(tmp_path, "projected.glsl", "visible_pdf(wo, wi, alpha)", said)
    projected, known = mb.load(str(path)), mb.load("ggx")
    assert projected.pdf and known.pdf
    for wo, wi, _ in stored.pairs(20):
        value = known.pdf(wo, wi, known.parameters())
        assert projected.pdf(wo, wi, projected.parameters()) == pytest.approx(value, rel=1e-12)


def test_show_tells_what_is_bound(cli: Callable[..., Any]) -> None:
    out = cli("show", GGX).out
    assert "f = ggx(wo, wi, alpha)" in out and "alpha=0.3 in [0.01, 1]" in out
    assert "def f(wo, wi, p):" in out


def test_a_function_is_found_by_its_arguments(tmp_path: Path) -> None:
    path = tmp_path / "auto.glsl"
    path.write_text(
        "// brdf-check: param rough = 0.5 in [0, 1]\n"
        "uniform float unused;\n"
        "float helper(float x) { return x; }\n"
        "vec3 shade(vec3 L, vec3 V, vec3 N, float rough) { return vec3(rough * helper(N.z)); }\n",
        encoding="utf-8",
    )
    model = mb.load(str(path))
    assert "f = shade(wi, wo, n, rough)" in model.doc
    assert model.f((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), model.parameters()) == 0.5


def test_a_translation_is_kept_until_anything_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path / "cache"))
    shader, other = tmp_path / "a.glsl", tmp_path / "half.glsl"
    shader.write_text(
        "// brdf-check: f = g(wo)\n#include \"half.glsl\"\nfloat g(vec3 x) { return HALF; }\n"
    )
    other.write_text("#define HALF 0.5\n")
    assert value(shader) == 0.5
    with monkeypatch.context() as patch:
        patch.setattr(translation, "_asked", lambda path: pytest.fail("translated again"))
        assert value(shader) == 0.5
    other.write_text("#define HALF 0.25\n")
    assert value(shader) == 0.25
    shader.write_text(shader.read_text().replace("HALF;", "2.0 * HALF;"))
    assert value(shader) == 0.5


def value(path: Path) -> float:
    model = mb.load(str(path))
    up = (0.0, 0.0, 1.0)
    return float(model.f(up, up, model.parameters()))


def test_folders_sources_stubs_and_macros_are_an_engine(tmp_path: Path) -> None:
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "common.h").write_text("float third(float x) { return x / SHARE; }\n")
    (tmp_path / "first.glsl").write_text("float twice(float x) { return 2.0 * x; }\n")
    path = tmp_path / "main.glsl"
    path.write_text(
        "// brdf-check: include = lib\n// brdf-check: define SHARE = 3.0\n"
        "// brdf-check: source = first.glsl\n// brdf-check: stub = float scale;\n"
        "// brdf-check: before = scale = 0.75;\n// brdf-check: f = g(wo.z)\n"
        "#ifdef NEVER\n#include <nothing.h>\n#endif\n#include <common.h>\n"
        "float g(float x) { return third(twice(x)) * scale; }\nvoid main() { }\n"
    )
    assert value(path) == pytest.approx(0.5)


def test_what_a_stage_has_besides_does_not_matter(tmp_path: Path) -> None:
    path = tmp_path / "stage.frag"
    path.write_text(
        "#version 300 es\nprecision highp float;\n#extension GL_OES_standard_derivatives : enable\n"
        "// brdf-check: f = shade(wo, wi)\n// brdf-check: param uRough = 0.5 in [0, 1]\n"
        "in vec3 vNormal;\nout vec4 outColor;\nuniform highp float uRough;\n"
        "uniform sampler2D map;\nuniform mat4 viewMatrix;\n"
        "layout(std140) uniform Lights { vec4 position[4]; } lights;\n"
        "vec4 looked(vec2 uv) { return texture(map, uv) * dFdx(uv.x); }\n"
        "float reflect(float x) { return x * uRough; }\n"
        "float shade(vec3 V, vec3 L) { return reflect(V.z); }\n"
        "void main() { if (vNormal.x > 2.0) discard; outColor = looked(vNormal.xy); }\n"
    )
    assert value(path) == 0.5


def test_a_shader_is_an_input_and_never_written_over(
    tmp_path: Path, cli: Callable[..., Any]
) -> None:
    path = tmp_path / "mine.glsl"
    shutil.copy(GGX, path)
    before = path.read_bytes()
    options = ("--theta-o", "0", "--samples", "64", "--export-json", path)
    done = cli("furnace", "--model", path, *options)
    assert done.code != 70 and path.read_bytes() == before


def test_constants_keep_their_digits() -> None:
    binary, _ = glslang.spirv(
        "#version 450\nlayout(std430, binding = 0) buffer B { float bc[]; };\n"
        "void main() { bc[1] = bc[0] * 3.14159265358979; }\n", "x.glsl"
    )  # fmt: skip
    from montecarlo_brdf.foreign.constants import meant
    from montecarlo_brdf.foreign.widen import widened

    assert binary and b"\x18-DT\xfb!\t@" in widened(binary, {})
    assert meant(0.10000000149011612, {}) == 0.1
    assert meant(1.4142135381698608, {1.4142135381698608: math.sqrt(2.0)}) == math.sqrt(2.0)
    assert meant(-0.31830987334251404, {}) == -1.0 / math.pi


def test_a_lobe_and_an_albedo_are_formulas(tmp_path: Path) -> None:
    path = tmp_path / "diffuse.glsl"
    path.write_text(
        "// brdf-check: f = share * 1.5 * wi.z * wo.z / 3.14159265358979\n"
        "// brdf-check: param share = 0.5 in [0, 1]\n"
        "// brdf-check: lobe = half vector: sqrt(share)^2\n// brdf-check: albedo = share * mu\n"
    )
    model = mb.load(str(path))
    p = model.parameters()
    assert model.lobe and model.lobe.width(p) == pytest.approx(0.5)
    assert model.albedo and model.albedo(0.5, p) == 0.25
    assert mb.furnace(model, theta_o_deg=[60.0]).verdict == Verdict.PASS


@pytest.mark.parametrize("formula", ["().__class__", "open(share)", "'a'", "lambda: 1", "share[0]"])
def test_a_formula_reaches_nothing(tmp_path: Path, formula: str) -> None:
    path = tmp_path / "a.glsl"
    said = "// brdf-check: f = share\n// brdf-check: param share = 0.5\n"
    path.write_text(f"{said}// brdf-check: albedo = {formula}\n")
    with pytest.raises(mb.ModelError, match="line 3, key albedo: "):
        mb.load(str(path))


def test_a_shader_within_javascript(tmp_path: Path) -> None:
    chunk = "export default `\nfloat half_of(float x) {\n return 0.5 * x; }\n`;\n"
    (tmp_path / "chunk.glsl.js").write_text(chunk)
    path = tmp_path / "a.glsl"
    path.write_text("// brdf-check: source = chunk.glsl.js\n// brdf-check: f = half_of(wo.z)\n")
    assert value(path) == 0.5


PROJECT = """
[model.matte]
source = "shaders/matte.glsl"
f = "matte(wo, wi)"
before = ["scale = 1.0 / PI;", "scale *= share;"]
isotropic = true
define = { PI = "3.14159265358979" }
param.share = "0.5 in [0, 1]"

[[models]]
model = "matte"
checks = ["furnace"]
theta_o = [0]
"""


def test_a_project_describes_shaders_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Callable[..., Any]
) -> None:
    (tmp_path / "shaders").mkdir()
    shader = tmp_path / "shaders" / "matte.glsl"
    shader.write_text("float scale;\nfloat matte(vec3 a, vec3 b) { return scale; }\n")
    (tmp_path / "brdf-check.toml").write_text(PROJECT)
    monkeypatch.chdir(tmp_path)
    model = mb.load("matte")
    assert model.name == "matte" and model.domain == {"share": (0.0, 1.0)}
    assert value(Path("matte")) == pytest.approx(0.5 / math.pi, rel=1e-12)
    assert cli("run").code == 0
    (tmp_path / "brdf-check.toml").write_text(PROJECT.replace("matte(wo, wi)", "lost(wo, wi)"))
    with pytest.raises(mb.ModelError, match="brdf-check.toml, line 4, key f: 'lost'"):
        mb.load("matte")
    (tmp_path / "brdf-check.toml").write_text(PROJECT.replace("isotropic", "isotropy"))
    with pytest.raises(mb.UserError, match="brdf-check.toml, line 6: no key of .model.matte. 'iso"):
        mb.load("matte")


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    [
        "run --effort 0.03 --theta-o 45 --model", "furnace --theta-o 45 --model",
        "converge --theta-o 45 --model", "stress --model", "show", "compare lambert",
        "bench --model", "radiance --environment gradient --model",
    ],
)  # fmt: skip
def test_every_command_takes_a_shader(command: str, cli: Callable[..., Any]) -> None:
    for name in ("ggx_stable.glsl", "colour.glsl"):
        assert cli(*command.split(), stored.SHADERS / name).code in (0, 1, 3)
