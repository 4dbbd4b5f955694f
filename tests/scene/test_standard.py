"""The standard lighting equation against its formula, and read as a surface."""

import math
from typing import Any

import pytest
from scenes import written

import montecarlo_brdf as mb
from montecarlo_brdf import references
from montecarlo_brdf.references._phong import double_axis, single_axis
from montecarlo_brdf.scene import claims, truth
from montecarlo_brdf.scene import plan as planning
from montecarlo_brdf.scene.radiance import value_of
from montecarlo_brdf.scene.scene import as_lobes
from montecarlo_brdf.scene.standard import Form, Standard, factors, shade
from montecarlo_brdf.vectors import from_degrees
from montecarlo_brdf.verify.radiance import radiance

LIGHTS = [
    (from_degrees(20.0, 30.0), (0.9, 0.8, 0.7)),
    (from_degrees(75.0, 200.0), (0.1, 0.5, 0.2)),
    (from_degrees(120.0, 10.0), (9.0, 9.0, 9.0)),  # below the horizon
    (from_degrees(50.0, 180.0), (0.3, 0.3, 1.1)),
    (from_degrees(0.0, 0.0), (0.4, 0.0, 0.2)),
]
MENDED = [(Form.PHONG, "phong", {}), (Form.BLINN, "blinn_phong", {"norm": "exact"})]
WO, WI = from_degrees(35.0), from_degrees(42.0, 170.0)
AMBIENT, EMISSION = (0.05, 0.04, 0.1), (0.01, 0.0, 0.02)
SURFACE = Standard((0.6, 0.3, 0.2), (0.4, 0.4, 0.1), gloss=13.0)


def _formula(s: Standard, theta: float, count: int) -> list[float]:
    """Written in angles: r.v and n.h from theta and phi, never from vectors."""
    total = [e + a * k for e, a, k in zip(EMISSION, AMBIENT, s.ambient or s.diffuse, strict=True)]
    angles = [(20.0, 30.0), (75.0, 200.0), (120.0, 10.0), (50.0, 180.0), (0.0, 0.0)]
    o = math.radians(theta)
    for (t, p), (_, colour) in list(zip(angles, LIGHTS, strict=True))[:count]:
        i, phi = math.radians(t), math.radians(p)
        if t >= 90.0:
            continue
        across = math.sin(i) * math.sin(o) * math.cos(phi)
        if s.form is Form.PHONG:
            lobe = max(0.0, math.cos(i) * math.cos(o) - across)
        else:
            lobe = (math.cos(i) + math.cos(o)) / math.sqrt(
                2.0 + 2.0 * (across + math.cos(i) * math.cos(o))
            )
        spread = math.cos(i) ** (s.gloss if s.gloss_on_diffuse else 1.0)
        for c in range(3):
            total[c] += colour[c] * (s.diffuse[c] * spread + s.specular[c] * lobe**s.gloss)
    return total


@pytest.mark.parametrize("count", [0, 1, 5])
@pytest.mark.parametrize("form", list(Form))
@pytest.mark.parametrize("printed", [False, True])
def test_equals_its_formula(count: int, form: Form, printed: bool) -> None:
    s = SURFACE._replace(form=form, gloss_on_diffuse=printed)
    for theta in (0.0, 35.0, 70.0, 89.0):
        found = shade(s, from_degrees(theta), LIGHTS[:count], AMBIENT, EMISSION)
        assert found == pytest.approx(_formula(s, theta, count), rel=1e-13)


def test_ambient_colour_defaults_to_the_diffuse_colour() -> None:
    own = SURFACE._replace(ambient=(0.1, 0.2, 0.3))
    assert SURFACE.ambient_colour == SURFACE.diffuse
    dark = (0.0, 0.0, 0.0)
    assert shade(own, (0.0, 0.0, 1.0), [], AMBIENT, dark) == pytest.approx((0.005, 0.008, 0.03))


FILE = """
[surface]
equation = "standard"
form = "FORM"
diffuse = [0.6, 0.3, 0.1]
specular = 0.4
gloss = 9
gloss_on_diffuse = PRINTED
[ambient]
radiance = 0.1
[[lights]]
kind = "directional"
direction = [1, 0, 1]
irradiance = [0.9, 0.8, 0.7]
[[lights]]
kind = "point"
position = [0, -2, 1]
intensity = 3.0
"""


@pytest.mark.parametrize("form", list(Form))
@pytest.mark.parametrize("printed", ["false", "true"])
def test_equals_its_reading_as_lobes(form: Form, printed: str, tmp_path: Any) -> None:
    """The equation and the sum f E cos over lights of its lobes, which share no code."""
    scene = written(tmp_path, FILE.replace("FORM", form).replace("PRINTED", printed))
    plan = planning.make(scene)
    for claim in claims.claims(scene, plan):
        (found,) = claim.measure(None)  # type: ignore[arg-type]
        assert found.estimate.mean == pytest.approx(claim.expected.value, rel=1e-12)


def test_energy_is_read_and_mended(tmp_path: Any) -> None:
    """A = pi kd + ks M_n(theta), which is more than 1: known, with the factors that mend it."""
    scene = written(tmp_path, FILE.replace("FORM", "phong").replace("PRINTED", "false"))
    report = radiance(scene, samples=1 << 14, threads=1)
    energy = [f for f in report.results[0].findings if f.quantity == "A <= 1"]
    assert report.exit_code == 0
    assert energy[0].verdict == "known"
    gains = [f for f in report.results[0].findings if f.verdict == "known"]
    most = max(f.value for f in gains)
    assert f"up to {most:.4g} times what arrives (theta_i 85° channel 0); it would" in gains[0].note  # type: ignore[operator]
    assert "1/pi" in (energy[0].note or "")
    for f in (f for f in report.results[0].findings if f.quantity == "R <= 1"):
        mu, kd = from_degrees(f.where["theta_i_deg"])[2], (0.6, 0.3, 0.1)[f.where["channel"]]
        exact = math.pi * kd + 0.4 * 2.0 * math.pi / 11.0 * double_axis(mu, 9.0) / mu
        assert f.value == pytest.approx(exact, rel=3e-3)
    for f in energy:
        mu, kd = from_degrees(f.where["theta_o_deg"])[2], (0.6, 0.3, 0.1)[f.where["channel"]]
        exact = math.pi * kd + 0.4 * 2.0 * math.pi / 10.0 * single_axis(mu, 9.0)
        assert f.value == pytest.approx(exact, rel=3e-3)
        furnace = as_lobes(scene.under_constant_light(1.0))
        truth_now = truth.reference(
            furnace, from_degrees(f.where["theta_o_deg"]), f.where["channel"]
        )
        assert truth_now.value == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize(("form", "name", "norm"), MENDED)
def test_what_mends_it(form: Form, name: str, norm: dict[str, str]) -> None:
    """With the factors and n.l the lobes are models that reflect no more than arrives."""
    for n in (0.5, 4.0, 30.0, 900.0):
        s = SURFACE._replace(form=form, gloss=n)
        diffuse, specular = factors(s)
        lobes = s.as_surface().lobes
        model = mb.load(name, **norm)
        p = model.parameters(ks=1.0, n=n)
        assert diffuse * lobes[0].model.f(WO, WI, lobes[0].sets[0]) == pytest.approx(1.0 / math.pi)
        old = value_of(lobes[1].model, lobes[1].sets[0], WO, WI)
        assert specular * old * WI[2] == pytest.approx(value_of(model, p, WO, WI), rel=1e-12)
        for theta in (0.0, 40.0, 80.0):
            truth_now = references.albedo(
                name, from_degrees(theta)[2], **p._asdict(), **model.picks
            )
            assert truth_now.value <= 1.0 + 1e-12


def test_lobes_of_the_equation() -> None:
    assert [lobe.name for lobe in SURFACE.as_surface().lobes] == ["diffuse", "specular"]
