"""The sphere: flat in a furnace, equal to `radiance` at its pixels, written whole or not at all."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import EXAMPLES, written

import montecarlo_brdf as mb
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.report.spheres import difference
from montecarlo_brdf.scene import truth
from montecarlo_brdf.scene.read import read_scene, scene_of
from montecarlo_brdf.scene.render import disk_of, in_world, render
from montecarlo_brdf.vectors import from_degrees

LOSSLESS = [(n, p) for n in ("lambert", "eon", "ggx_kulla_conty") for p in mb.load(n).lossless]


def _furnace(name: str, size: int = 96, **values: Any) -> Any:
    model = mb.load(name)
    p = model.parameters(**values)
    return render(scene_of(model.of(p), p, "constant:0.5"), size=size)


@pytest.mark.parametrize(("name", "p"), LOSSLESS, ids=str)
def test_lossless_spheres_disappear(name: str, p: Any) -> None:
    sphere = _furnace(name, **p._asdict())
    assert np.abs(sphere.values - 0.5).max() < 1e-5
    assert sphere.error < 1e-5


def test_a_gain_shows_in_the_difference() -> None:
    """Blinn-Phong (n + 8)/(8 pi): 1.0752 at the normal, in the middle of the picture."""
    sphere = _furnace("blinn_phong", 97, ks=1.0, n=8.7637, norm="n+8")
    panel = difference(sphere, 0.5)
    assert panel[48, 48] == pytest.approx(0.0752012, abs=1e-4)
    assert np.nanmin(panel) < -0.5
    assert np.isnan(panel[0, 0])


def test_table_agrees_with_truth() -> None:
    """Interpolation and sampling stay within the error that is stated."""
    model = mb.load("ggx")
    scene = scene_of(model, model.parameters(alpha=0.3), "constant:1")
    sphere = render(scene, size=65)
    row = sphere.values[32, sphere.inside[32], 0]
    x = ((np.arange(65) + 0.5) * (2.2 / 65) - 1.1)[sphere.inside[32]]
    for theta, value in zip(np.degrees(np.arcsin(np.abs(x))), row, strict=True):
        exact = truth.reference(scene, from_degrees(float(theta)), 0).value
        assert abs(value - exact) <= sphere.error + 1e-6


def test_pixels_are_the_radiance_of_their_place(tmp_path: Path) -> None:
    """The middle pixel is the flat surface seen from the normal, under a tilted sky and lamps."""
    scene = read_scene(EXAMPLES / "cook_torrance.toml")
    sphere = render(scene, size=9, samples=1 << 14)
    for c in range(3):
        exact = truth.reference(scene, (0.0, 0.0, 1.0), c).value
        assert sphere.values[4, 4, c] == pytest.approx(exact, rel=2e-3)
    standard = read_scene(EXAMPLES / "standard.toml")
    assert standard.name and written(tmp_path, (EXAMPLES / "standard.toml").read_text())


def _lamp(file: Path, sky: str) -> Any:
    return written(file, f'[surface]\nmodel = "lambert"\nalbedo = 1.0\n[environment]\n{sky}\n')


@pytest.mark.parametrize("camera", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])
def test_a_sphere_sees_the_sky_below_the_horizon(camera: Any, tmp_path: Path) -> None:
    """A cap that does not light a flat surface lights the sphere's lower side."""
    sky = 'kind = "cap"\nhalf_angle_deg = 20\naxis = {tilt_deg = 130}'
    scene = _lamp(tmp_path, f"{sky}\n[view]\ncamera = {list(camera)}")
    sphere = render(scene, size=9, samples=1 << 12)
    normals = np.zeros((9, 9, 3))
    normals[sphere.inside] = in_world(disk_of(9)[1], camera)
    axis = np.array(from_degrees(130.0))
    for n, value in zip(normals[sphere.inside], sphere.values[sphere.inside, 0], strict=True):
        exact = _irradiance.cap(math.radians(20.0), math.acos(float(n @ axis))) / math.pi
        assert value == pytest.approx(exact, abs=5e-4)


def test_a_sphere_sees_all_of_an_image(tmp_path: Path) -> None:
    """Texels below the horizon against a sum over small cells."""
    texels = np.random.default_rng(2).random((8, 16))
    texels[6, 3] = 20.0
    np.save(tmp_path / "sky.npy", texels)
    scene = _lamp(tmp_path, 'kind = "image"\nfile = "sky.npy"')
    camera = (0.0, -1.0, 0.0)
    sphere = render(scene, size=7, samples=1 << 14, camera=camera)
    theta = (np.arange(400) + 0.5) * np.pi / 400.0
    phi = (np.arange(800) + 0.5) * 2.0 * np.pi / 800.0 - np.pi
    t, p = np.meshgrid(theta, phi, indexing="ij")
    w = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
    light = np.kron(texels, np.ones((50, 50))) * np.sin(t) * 2.0 * (np.pi / 400.0) ** 2 / 2.0
    for n, value in zip(
        in_world(disk_of(7)[1], camera), sphere.values[sphere.inside, 0], strict=True
    ):
        exact = np.sum(light * np.maximum(0.0, w @ n)) / np.pi
        assert value == pytest.approx(exact, rel=2e-3, abs=1e-3)


def test_negative_sky_below_the_horizon(cli: Callable[..., Any], tmp_path: Path) -> None:
    _lamp(tmp_path, 'kind = "linear"\na = 1\nb = 2')
    png = tmp_path / "s.png"
    outcome = cli("render", str(tmp_path / "scene.toml"), "-o", str(png), "--size", "16")
    assert (outcome.code, outcome.err.count("\n")) == (2, 1)
    assert "negative radiance: below the horizon" in outcome.err
    assert not png.exists()


def test_sky_opposite_to_its_axis() -> None:
    picture = render(read_scene(EXAMPLES / "phong.toml"), size=8, samples=16)
    assert np.all(picture.values[0, 0] == 0.0)  # behind the sphere seen from the axis it is black


def test_threads_change_nothing() -> None:
    scene = read_scene(EXAMPLES / "blinn_phong.toml")
    one, two = (render(scene, size=64, samples=16, threads=t) for t in (1, 2))
    assert np.array_equal(one.values, two.values)


def test_two_lists_make_a_grid(cli: Callable[..., Any], tmp_path: Path) -> None:
    png, npy = tmp_path / "s.png", tmp_path / "s.npy"
    arguments = ["--model", "lambert", "--furnace", "-p", "albedo=0.5,0.7,1", "--size", "16"]
    assert cli("render", *arguments, "-o", str(npy)).code == 0
    assert np.load(npy).shape == (16, 48, 1)
    scene = tmp_path / "s.toml"
    scene.write_text('[surface]\nmodel = "oren_nayar"\n[environment]\nkind = "constant"\n')
    grid = [str(scene), "-p", "albedo=0.5,1", "-p", "sigma=0:0.5:3", "--size", "16"]
    outcome = cli("render", *grid, "-o", str(npy), "-o", str(png))
    assert outcome.code == 0, outcome
    values = np.load(npy)
    assert values.shape == (32, 48, 1)
    ball = values[:16] != 1.0  # not the sky behind it
    assert np.allclose(values[16:][ball], 2.0 * values[:16][ball], atol=1e-5)
    assert "albedo = 0.5, sigma = 0.25: L_o from" in outcome.out


def test_files(cli: Callable[..., Any], tmp_path: Path) -> None:
    png, npy = tmp_path / "s.png", tmp_path / "s.npy"
    arguments = ["render", "--model", "lambert", "--furnace", "-p", "albedo=0.5,1", "--size", "32"]
    outcome = cli(*arguments, "-o", str(png), "-o", str(npy))
    assert outcome.code == 0, outcome
    assert outcome.out.count("difference to the light") == 2
    assert np.load(npy).shape == (32, 64, 1)
    assert png.read_bytes().startswith(b"\x89PNG")


def test_exr(tmp_path: Path) -> None:
    """What is written can be read again, also as a sky."""
    pytest.importorskip("OpenEXR")
    from montecarlo_brdf.report.spheres import save
    from montecarlo_brdf.scene.images import read_image

    sphere = render(read_scene(EXAMPLES / "standard.toml"), size=16)
    save(tmp_path / "s.exr", [sphere], ["standard"], None)
    assert np.allclose(read_image(tmp_path / "s.exr"), sphere.values, rtol=1e-6)


def test_a_spectrum_is_no_picture(cli: Callable[..., Any], tmp_path: Path) -> None:
    png = tmp_path / "s.png"
    arguments = ["--model", "lambert", "-p", "albedo=1/0.5/0.2/0.1", "--size", "16"]
    outcome = cli("render", *arguments, "--furnace", "-o", str(png))
    assert outcome.code == 2
    assert "a picture needs 1 or 3 channels, not 4" in outcome.err
    assert not png.exists()
