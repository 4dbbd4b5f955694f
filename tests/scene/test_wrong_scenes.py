"""Everything wrong in a scene is one sentence with its place, exit code 2, and leaves no file."""

import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

SURFACE = '[surface]\nmodel = "lambert"\n'
SKY = '[environment]\nkind = "constant"\n'
LIGHT = '[[lights]]\nkind = "directional"\n'
SPECTRUM = "[spectrum]\nwavelengths = [400, 500]\n"
#: text of a scene -> words of the complaint
WRONG = {
    "": "needs 'surface'",
    "surface = 3": "line 1: surface must be a table",
    "[surface\n": "not a TOML file",
    "[surface]\nalbedo = 0.5": "line 1: [surface] needs 'model'",
    '[surface]\nmodel = "lambrt"': "line 2: no model 'lambrt'; did you mean 'lambert'?",
    SURFACE + "albdo = 0.5": "line 3: no key of [surface] 'albdo'; did you mean 'albedo'?",
    SURFACE + "albedo = 1.5": "line 3: albedo of model lambert must be a number in [0, 1], not 1.5",
    SURFACE + 'albedo = "red"': "line 3: albedo must be a finite number, not 'red'",
    SURFACE + "albedo = nan": "line 3: albedo must be a finite number",
    SURFACE + "weight = -1": "line 3: weight must be at least 0",
    SURFACE + "[sky]\nx = 1": "line 3: no key of the scene 'sky'",
    SURFACE + '[environment]\nkind = "blue"': "line 4: no kind 'blue' (choose from constant,",
    SURFACE + SKY + "radiance = -1": "line 5: radiance must be at least 0, not -1",
    SURFACE + '[environment]\nkind = "linear"\na = 1\nb = -2': "negative radiance",
    SURFACE
    + '[environment]\nkind = "harmonics"\ncoefficients = [0, 0, -1, 0]': "negative radiance",
    SURFACE + '[environment]\nkind = "harmonics"\ncoefficients = [1, 2]': "1, 4, 9, 16 or 25",
    SURFACE + '[environment]\nkind = "image"\nfile = "no.png"': "line 5: no image file",
    SURFACE + LIGHT + "direction = [0, 0, 0]\nirradiance = 1": "line 5: direction has no direction",
    SURFACE + LIGHT + "direction = [0, 1]\nirradiance = 1": "line 5: direction must be a list of 3",
    SURFACE + LIGHT + "direction = [0, 0, 1]": "line 3: [[lights]] 1 needs 'irradiance'",
    SURFACE
    + '[[lights]]\nkind = "lamp"': "line 4: no kind 'lamp' (choose from directional, point)",
    SURFACE + "[view]\ntheta_o_deg = [90]": "line 4: theta_o_deg must be angles in [0, 90)",
    SURFACE + "albedo = [1, 1, 1]\n[emission]\nradiance = [1, 1]": "same number of channels",
    SURFACE + "albedo = [[400, 0.5]]": "line 3: albedo is a spectrum: the scene needs [spectrum]",
    SPECTRUM
    + SURFACE
    + "albedo = [[500, 0.5], [400, 0.1]]": "line 5: albedo: the wavelengths of a",
    SPECTRUM + SURFACE + "albedo = [[-500, 0.5]]": "wavelengths are positive numbers",
    SPECTRUM + SURFACE + "albedo = [[450, 0.5], [600, 1]]": "no value at 400 nm",
    "[spectrum]\nwavelengths = [500, 400]\n"
    + SURFACE: "line 2: the wavelengths of a spectrum must",
    SPECTRUM + 'illuminant = "D99"\n' + SURFACE: "illuminant",
    SPECTRUM + "illuminant = [[-400, 1]]\n" + SURFACE: "line 3: wavelengths are positive numbers",
    SPECTRUM + "illuminant = 3\n" + SURFACE: "line 3: a spectrum is a list of",
    SPECTRUM + SURFACE + f"albedo = [[{10**400}, 1]]": "line 5: albedo: a spectrum is a list of",
    SURFACE + f"albedo = {'9' * 5000}": "not a TOML file",
}


@pytest.mark.parametrize("text", WRONG, ids=lambda t: " ".join(t.split())[-40:])
def test_scene(text: str, cli: Callable[..., Any], tmp_path: Path) -> None:
    file, out = tmp_path / "scene.toml", tmp_path / "out.json"
    file.write_text(text)
    outcome = cli("radiance", str(file), "--export-json", str(out))
    assert outcome.code == 2, outcome
    assert outcome.err.startswith("Error: ")
    assert outcome.err.count("\n") == 1
    assert WRONG[text] in outcome.err
    assert not out.exists()


def test_the_line_is_that_of_the_parameter(cli: Callable[..., Any], tmp_path: Path) -> None:
    """Also where the name of another parameter is the end of its name."""
    model, file = tmp_path / "mine.py", tmp_path / "scene.toml"
    model.write_text(
        "from typing import NamedTuple\n\n\nclass Params(NamedTuple):\n    a: float = 1.0\n"
        "    beta: float = 0.5\n\n\ndomain = {'beta': (0.0, 1.0)}\n\n\n"
        "def f(wo, wi, p):\n    return p.a * p.beta\n"
    )
    file.write_text(f"[surface]\nmodel = '{model}'\na = 0.2\nbeta = 2.0\n")
    outcome = cli("radiance", str(file))
    assert outcome.code == 2
    assert "line 4: beta of model" in outcome.err


def _image_scene(folder: Path, name: str) -> str:
    file = folder / "scene.toml"
    file.write_text(f'{SURFACE}[environment]\nkind = "image"\nfile = "{name}"\n')
    return str(file)


def _write(folder: Path, kind: str) -> str:
    """A file with something wrong in it; its name."""
    from PIL import Image

    if kind == "nan":
        np.save(folder / "bad.npy", np.full((4, 8, 3), np.nan))
    elif kind == "negative":
        np.save(folder / "bad.npy", np.full((4, 8, 3), -1.0))
    elif kind == "shape":
        np.save(folder / "bad.npy", np.zeros((4, 8, 3, 2)))
    elif kind == "truncated.png":
        Image.new("RGB", (64, 32), (9, 200, 30)).save(folder / "whole.png")
        (folder / "bad.png").write_bytes((folder / "whole.png").read_bytes()[:60])
        return "bad.png"
    elif kind == "truncated.hdr":
        (folder / "bad.hdr").write_bytes(b"#?RADIANCE\n\n-Y 64 +X 128\n" + bytes(20))
        return "bad.hdr"
    elif kind == "large.npy":
        with (folder / "bad.npy").open("wb") as file:
            shape = {"descr": "<f4", "fortran_order": False, "shape": (100_000, 200_000, 3)}
            np.lib.format.write_array_header_1_0(file, shape)
            file.truncate(file.tell() + 4 * 100_000 * 200_000 * 3)  # a hole: no bytes on the disk
    elif kind == "large.png":
        Image.new("RGB", (64, 32), (9, 200, 30)).save(folder / "whole.png")
        data = (folder / "whole.png").read_bytes()
        header = b"IHDR" + struct.pack(">II", 900_000, 900_000) + data[24:29]
        checksum = struct.pack(">I", zlib.crc32(header))
        (folder / "bad.png").write_bytes(data[:12] + header + checksum + data[33:])
        return "bad.png"
    elif kind == "large.hdr":
        (folder / "bad.hdr").write_bytes(b"#?RADIANCE\n\n-Y 900000 +X 900000\n")
        return "bad.hdr"
    else:
        (folder / "bad.gif").write_bytes(b"")
        return "bad.gif"
    return "bad.npy"


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("nan", "NaN"),
        ("negative", "negative radiance"),
        ("shape", "rows, columns and channels"),
        ("truncated.png", "damaged"),
        ("truncated.hdr", "truncated"),
        ("large.hdr", "too large"),
        ("large.png", "larger than memory allows"),
        ("large.npy", "too large"),
        ("gif", "must be a .png, .hdr, .exr or .npy file"),
    ],
)
def test_images(kind: str, words: str, cli: Callable[..., Any], tmp_path: Path) -> None:
    outcome = cli("radiance", _image_scene(tmp_path, _write(tmp_path, kind)))
    assert (outcome.code, outcome.err.count("\n")) == (2, 1), outcome
    assert words in outcome.err
    assert "line 5" in outcome.err


def test_missing_extra(cli: Callable[..., Any], tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.setitem(__import__("sys").modules, "OpenEXR", None)
    (tmp_path / "sky.exr").write_bytes(b"")
    outcome = cli("radiance", _image_scene(tmp_path, "sky.exr"))
    assert outcome.code == 2
    assert "pip install 'montecarlo-brdf[scene]'" in outcome.err
    scene = ["--model", "lambert", "--environment", "constant:1", "--size", "8"]
    outcome = cli("render", *scene, "-o", str(tmp_path / "s.exr"))
    assert outcome.code == 5
    assert not (tmp_path / "s.exr").exists()


def test_weights_beyond_one_warn_and_fail(cli: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    lobe = '[[surface.lobes]]\nweight = 0.7\nmodel = "lambert"\nalbedo = [0.2, 0.4, 0.6]\n'
    file.write_text(lobe + lobe + SKY)
    outcome = cli("radiance", str(file), "--samples", "2^10")
    assert outcome.code == 1
    assert outcome.err.count("Warning: the weights of the lobes add up to 1.4 > 1") == 1
    assert "sum of weights <= 1" in outcome.out


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["radiance"], 2),
        (["radiance", "--model", "ggx"], 2),
        (["radiance", "no.toml"], 2),
        (["radiance", "--model", "ggx", "--environment", "cosine"], 2),
        (["radiance", "--model", "ggx", "--environment", "cap:200"], 2),
        (["radiance", "--model", "ggx", "--environment", "sun:1"], 2),
        (["radiance", "--model", "lambert", "--environment", "constant", "--plot", "r.gif"], 2),
        (["render", "--model", "lambert", "--furnace", "-o", "s.gif"], 2),
        (["render", "--model", "lambert", "--furnace", "-o", "no/s.png"], 5),
        (["render", "--model", "lambert", "--furnace", "--size", "3", "-o", "s.png"], 2),
        (["render", "--model", "lambert", "-o", "s.png"], 2),
        (["render", "--model", "lambert", "--furnace", "-p", "albedo=0:1:99", "-o", "s.png"], 2),
    ],
)
def test_command_lines(
    arguments: list[str], code: int, cli: Callable[..., Any], tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    outcome = cli(*arguments)
    assert (outcome.code, outcome.err.count("\n")) == (code, 1), outcome
    assert not list(tmp_path.iterdir())
