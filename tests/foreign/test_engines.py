"""What engines write beside formulas stays out of the way."""
from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.model import channels

SHADERS = tomllib.loads((stored.FOLDER / "engines.toml").read_text(encoding="utf-8"))["shaders"]
UP = (0.0, 0.0, 1.0)
pytestmark = stored.needs_wheel


@pytest.mark.parametrize("shader", SHADERS, ids=lambda s: s["what"])
def test_a_shader_means_what_it_says(shader: dict[str, Any], tmp_path: Path) -> None:
    (tmp_path / "Engine").mkdir()
    (tmp_path / "Engine" / "Common.ush").write_text("static const float HALF = 0.5;\n")
    path = tmp_path / shader["file"]
    path.write_text(shader["text"], encoding="utf-8")
    model = mb.load(str(path))
    p = channels(model.parameters())[0]
    assert model.f(UP, UP, p) == pytest.approx(shader["f"], rel=1e-12)


FOUND = """\
// brdf-check: param alpha = 0.5 in [0.1, 1]
float half_of(float x) { return 0.5 * x; }
float ggx_pdf(vec3 V, vec3 L, float alpha) { return alpha * L.z; }
vec3 sampleGGX(vec2 Xi, vec3 V, float alpha) { return vec3(0.0, Xi.x * 0.0, 1.0); }
float ggx(vec3 V, vec3 L, vec3 N, float alpha) { return half_of(alpha); }
"""


def test_what_is_found_is_told_by_every_command(
    tmp_path: Path, cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.glsl"
    path.write_text(FOUND)
    model = mb.load(str(path))
    assert model.pdf and model.sample and model.pdf(UP, UP, model.parameters()) == 0.5
    assert not cli("show", path).err  # the tests ask for quiet
    monkeypatch.delenv("BRDF_CHECK_QUIET")
    told = cli("furnace", "--model", path, "--theta-o", "0", "--samples", "64").err
    assert f"{path}: f = ggx(wo, wi, n, alpha), from {path}, line 5" in told
    assert f"{path}: pdf = ggx_pdf(wo, wi, alpha), from {path}, line 3" in told
    assert f"{path}: sample = sampleGGX(u.xy, wo, alpha), from {path}, line 4" in told


COUNTED = """\
// brdf-check: param thin = true
// brdf-check: param layers = int(2) in [1, 4]
// brdf-check: param scale = 0.5 in [0, 1]
// brdf-check: f = (thin ? 0.1 : 0.2) * scale / float(layers)
"""


def test_switches_and_counts_are_no_ranges(tmp_path: Path) -> None:
    path = tmp_path / "a.glsl"
    path.write_text(COUNTED)
    model = mb.load(str(path))
    assert model.whole == {"thin", "layers"}
    case = Case(model, model.parameters(), [0.0], free=searched(model, {}))
    sets = [p for p, _ in zip(parameters.sets_inside(case), range(64), strict=False)]
    assert {p.thin for p in sets} == {0.0, 1.0} and {p.layers for p in sets} == {1, 2, 3, 4}
    assert len({p.scale for p in sets}) == 64
    assert parameters.at(case, parameters.position(case, sets[0])) == pytest.approx(sets[0])
    assert model.parameters(thin="true").thin == model.parameters(thin=True).thin == 1.0
    with pytest.raises(mb.UserError, match="layers .* must be a whole number in .1, 4., not 2.5"):
        model.parameters(layers=2.5)


SETS = """\
// brdf-check: param base = color(0.8, 0.5, 0.2) in [0, 1]
// brdf-check: param rough = 0.5 in [0, 1]
// brdf-check: f = base * (1.0 - 0.5 * rough) / 3.14159265358979
// brdf-check: verified = base = 0.5; base_r = 1, rough = 0.25
// brdf-check: verified = defaults
// brdf-check: lossless = base = 1, rough = 0
// brdf-check: limits = rough = 0, base = 0.8: lambert
"""


def test_sets_of_parameters_are_said_by_name(tmp_path: Path) -> None:
    path = tmp_path / "a.glsl"
    path.write_text(SETS)
    model = mb.load(str(path))
    assert len(model.verified) == 9 and model.verified[3].base_r == 1.0
    assert isinstance(model.lossless, tuple) and model.lossless[2].channel == 2.0
    assert model.limits[0].model == "lambert" and model.limits[0].changes["base_b"] == 0.8
    report = mb.run(model, model.parameters(), names=["limits"], effort=0.05)
    assert report.verdict == "pass"


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("verified = roughness = 1", "line 8, key verified: no parameter 'roughness'"),
        ("lossless = rough", "line 8, key lossless: write `rough = number`"),
        ("limits = rough = 0", "line 8, key limits: write `parameter = number: model`"),
        ("define 3 = x", "line 8: write `define NAME = value`"),
        ("language = osl", "line 8: no language 'osl'"),
    ],
)
def test_a_key_that_is_wrong_has_its_line(tmp_path: Path, line: str, told: str) -> None:
    path = tmp_path / "a.glsl"
    kept = "".join(x for x in SETS.splitlines(True) if line.split()[0] not in x)
    blank = "\n" * (7 - kept.count("\n"))
    path.write_text(f"{kept}{blank}// brdf-check: {line}\n")
    with pytest.raises(mb.ModelError) as raised:
        mb.load(str(path))
    assert told in str(raised.value)


def test_a_structure_is_to_be_filled(tmp_path: Path) -> None:
    path = tmp_path / "a.glsl"
    path.write_text("struct M { float x; };\nfloat f(vec3 V, vec3 L, M m) { return m.x; }\n")
    with pytest.raises(mb.ModelError, match="takes a M: fill it by // brdf-check: before = M m"):
        mb.load(str(path))


def test_a_language_is_said_where_the_name_does_not(tmp_path: Path) -> None:
    project = tmp_path / "brdf-check.toml"
    project.write_text(
        '[model.mine]\nsource = "a.inc"\nlanguage = "hlsl"\nf = "Shade(wo)"\n', encoding="utf-8"
    )
    (tmp_path / "a.inc").write_text("float Shade(float3 v) { return 0.5 * saturate(v.z); }\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        model = mb.load("mine")
    assert model.f(UP, UP, model.parameters()) == 0.5
