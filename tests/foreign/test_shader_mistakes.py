"""A mistake in a shader is one sentence with its file and line, and exit code 4."""
from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.foreign import wheel

MISTAKES = tomllib.loads((stored.FOLDER / "mistakes.toml").read_text(encoding="utf-8"))["mistakes"]


@stored.needs_wheel
@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda m: m["said"][:40])
def test_a_mistake_is_told_with_its_place(
    mistake: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(mistake["file"]).write_text(mistake["text"], encoding="utf-8")
    with pytest.raises(mb.ModelError, match=re.escape(mistake["said"])) as raised:
        mb.load(mistake["file"])
    assert raised.value.exit_code == 4 and "\n" not in str(raised.value)


@stored.needs_wheel
def test_an_endless_loop_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.glsl"
    loop = "float x = a.x; while (x > -2.0) { x = sin(x); } return x;"
    text = f"// brdf-check: f = g(wo)\nfloat g(vec3 a) {{ {loop} }}\n"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(mb.ModelError, match="its functions did not return within 2 s"):
        mb.load(str(path))


def test_no_file_is_a_mistake_of_the_command() -> None:
    with pytest.raises(mb.UserError, match="no model file lost.glsl") as raised:
        mb.load("lost.glsl")
    assert raised.value.exit_code == 2


def test_without_the_wheel_its_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wheel, "folder", lambda: None)
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path))
    with pytest.raises(mb.ModelError, match=r"pip install 'montecarlo-brdf\[shaders\]'"):
        mb.load(str(stored.SHADERS / "ggx.glsl"))
