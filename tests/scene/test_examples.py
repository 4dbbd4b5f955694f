"""Every example scene: one command, its exit code, and an analytic value that it must have."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from scenes import EXAMPLES, estimates, written

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.references import _irradiance
from montecarlo_brdf.report.pictures.radiance import _headroom, figure
from montecarlo_brdf.scene.radiance import value_of
from montecarlo_brdf.scene.read import read_scene
from montecarlo_brdf.vectors import from_degrees, half_vector, mirrored

CODES = {"lambert_without_pi": 1}


@pytest.mark.parametrize("name", ["lambert", "lambert_without_pi", "standard"])
def test_one_command(name: str, cli: Callable[..., Any], tmp_path: Path) -> None:
    out = tmp_path / "report.json"
    outcome = cli(
        "radiance", str(EXAMPLES / f"{name}.toml"), "--explain", "--export-json", str(out)
    )
    assert outcome.code == CODES.get(name, 0), outcome.out
    assert "skipped" in outcome.out or "exact sum, no samples" in outcome.out
    assert json.loads(out.read_text())["settings"]["plan"]


def test_all_examples_can_be_read() -> None:
    names = {read_scene(file).name for file in EXAMPLES.glob("*.toml")}
    assert len(names) == len(list(EXAMPLES.glob("*.toml"))) >= 6


def test_lambert() -> None:
    """L_o = albedo L from every direction."""
    for theta in (0.0, 45.0, 89.0):
        found = [m.estimate.mean for m in estimates(read_scene(EXAMPLES / "lambert.toml"), theta)]
        assert found == pytest.approx([0.8, 0.5, 0.2], rel=1e-15)


@pytest.mark.parametrize(
    ("sky", "irradiance"),
    [
        ('kind = "constant"\nradiance = 2', 2.0 * math.pi),
        (
            'kind = "cosine"\nexponent = 5\naxis = {tilt_deg = 40}',
            _irradiance.cosine(5.0, math.cos(math.radians(40.0))),
        ),
        ('kind = "linear"\na = 1\nb = 2', _irradiance.linear(1.0, 2.0, 1.0)),
    ],
)
def test_lambert_under_three_skies(sky: str, irradiance: float, tmp_path: Path) -> None:
    """L_o = (albedo/pi) E whatever the view, so that Phi_out/Phi_in = albedo."""
    text = f'[surface]\nmodel = "lambert"\nalbedo = 0.7\n[environment]\n{sky}\n'
    scene = written(tmp_path, text)
    for theta in (0.0, 60.0, 85.0):
        (found,) = estimates(scene, theta, 1 << 16)
        e = found.estimate
        half = max(e.half_width(1e-8), 1e-14)
        assert abs(math.pi * e.mean / irradiance - 0.7) <= half * math.pi / irradiance


def test_lambert_without_pi() -> None:
    """Energy fails by exactly pi."""
    (found,) = estimates(read_scene(EXAMPLES / "lambert_without_pi.toml"), 30.0)
    assert found.estimate.mean == pytest.approx(math.pi, rel=1e-15)


def test_phong() -> None:
    """From the normal: ks (n + 2)/(n + 3) under the cosine sky, and the lamp point by point."""
    lamp = 0.5 * 52.0 / (2.0 * math.pi) * math.cos(math.radians(30.0)) ** 51
    exact = [ks * (52.0 / 53.0 + lamp) for ks in (0.9, 0.6, 0.3)]
    for found, value in zip(
        estimates(read_scene(EXAMPLES / "phong.toml"), 0.0, 1 << 16), exact, strict=True
    ):
        assert abs(found.estimate.mean - value) <= found.estimate.half_width(1e-8)
        assert found.estimate.stderr < 1e-4 * value


@pytest.mark.parametrize("name", ["phong_unnormalised", "blinn_phong"])
def test_highlights_point_by_point(name: str) -> None:
    """(r.v)^n and (n.h)^n from vectors, at 100 pairs of directions."""
    model = mb.load(name)
    p = model.parameters(ks=0.7, n=25.0, **({"norm": "none"} if name == "blinn_phong" else {}))
    for k in range(100):
        wo, wi = from_degrees(0.89 * k, 17.0 * k), from_degrees(87.0 - 0.8 * k, 31.0 * k)
        lobe = (
            half_vector(wi, wo)[2]
            if name == "blinn_phong"
            else sum(map(math.prod, zip(mirrored(wi), wo, strict=True)))
        )
        assert value_of(model.of(p), p, wo, wi) == pytest.approx(
            0.7 * max(0.0, lobe) ** 25, rel=1e-12, abs=1e-300
        )


def test_blinn_phong_lamp() -> None:
    """The lamp at distance 2: f I/d^2 cos, written out."""
    scene = read_scene(EXAMPLES / "blinn_phong.toml")
    dark = scene.under_constant_light(0.0)
    from dataclasses import replace

    (found, *_) = estimates(replace(dark, lights=scene.lights), 0.0)
    half = math.cos(math.radians(15.0))  # the lamp stands at 30 degrees
    exact = 0.8 * 42.0 / (8.0 * math.pi) * half**40 * 4.0 / 4.0 * math.cos(math.radians(30.0))
    assert found.estimate.mean == pytest.approx(exact, rel=1e-13)


def test_cook_torrance() -> None:
    """kd + ks = 1, and the diffuse part is kd albedo E/pi of the tilted cap."""
    from dataclasses import replace

    from montecarlo_brdf.scene.claims import weight_sums
    from montecarlo_brdf.scene.surface import Surface

    scene = read_scene(EXAMPLES / "cook_torrance.toml")
    assert weight_sums(scene) == pytest.approx([1.0, 1.0, 1.0], rel=1e-15)
    diffuse = replace(scene, surface=Surface(scene.surface.lobes[:1]))  # type: ignore[union-attr]
    e = _irradiance.cap(math.radians(30.0), math.radians(50.0))
    exact = [0.4 * c * light * e / math.pi for c, light in ((0.75, 3.0), (0.35, 2.9), (0.2, 2.7))]
    for found, value in zip(estimates(diffuse, 40.0, 1 << 16), exact, strict=True):
        assert abs(found.estimate.mean - value) <= found.estimate.half_width(1e-8)


def test_spectrum_and_band(cli: Callable[..., Any], tmp_path: Path) -> None:
    """Reflectance per wavelength; albedo over the band exact for linear pieces."""
    file = tmp_path / "scene.toml"
    file.write_text(
        "[spectrum]\nwavelengths = [400, 500, 700]\nilluminant = [[400, 1], [600, 3], [700, 1]]\n"
        '[surface]\nmodel = "lambert"\nalbedo = [[380, 0.1], [480, 0.6], [780, 0.3]]\n'
        '[environment]\nkind = "constant"\n'
    )
    outcome = cli("radiance", str(file), "--format", "json")
    findings = json.loads(outcome.out)["results"][0]["findings"]
    at = [0.2, 0.58, 0.38]  # 400, 500, 700 nm on the pairs
    first = [f["value"] for f in findings if f["quantity"] == "L_o"][:3]
    assert first == pytest.approx(at, rel=1e-14)
    band = next(f for f in findings if f["quantity"] == "albedo over the band")
    upper = lower = 0.0
    steps = 200_000
    for k in range(steps):  # midpoint rule, error below 1e-9
        w = 400.0 + (k + 0.5) * 300.0 / steps
        rho = (
            at[0] + (w - 400.0) / 100.0 * (at[1] - at[0])
            if w < 500.0
            else at[1] - (w - 500.0) / 200.0 * 0.2
        )
        light = 1.0 + (w - 400.0) / 100.0 if w < 600.0 else 3.0 - (w - 600.0) / 50.0
        upper, lower = upper + rho * light, lower + light
    assert band["value"] == pytest.approx(upper / lower, rel=1e-8)
    assert (outcome.code, band["verdict"]) == (0, "pass")


def test_the_picture_hides_no_point() -> None:
    row = Finding("L_o", {"theta_o_deg": 30.0}, "pass", value=0.5, expected=0.5, stderr=1e-6)
    result = Result("lambert", {}, "radiance", [row])
    top, bottom = figure(Report(Command.RADIANCE, {}, [result])).axes
    assert top.get_ylim()[1] > 0.5 and bottom.get_legend() is None
    assert _headroom([0.0]) > 0.0  # a black surface has an axis too
