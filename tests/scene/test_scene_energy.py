"""Energy of scenes: per channel, by A, and by R where light and viewer cannot be exchanged."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from scenes import written

import montecarlo_brdf as mb
from montecarlo_brdf import loading, references
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.scene import claims, plan
from montecarlo_brdf.scene.claims import reversed_scene
from montecarlo_brdf.scene.read import scene_of
from montecarlo_brdf.vectors import from_degrees
from montecarlo_brdf.verify.radiance import radiance

NOT_RECIPROCAL = {"phong_original", "ggx_turquin"}


def _scene(name: str, **values: Any) -> Any:
    model = mb.load(name)
    p = model.parameters(**values)
    return scene_of(model.of(p), p, "constant:1", [30.0, 70.0])


@pytest.mark.parametrize("name", loading.names())
def test_who_is_reciprocal(name: str) -> None:
    scene = _scene(name)
    assert (reversed_scene(scene) is not None) == (name in NOT_RECIPROCAL)


def test_reverse_albedo() -> None:
    """R as its reference has it, estimated by the scene's own plan."""
    name, values = "ggx_turquin", {"alpha": 0.7}
    scene = _scene(name, **values)
    reverse = reversed_scene(scene)
    assert reverse is not None
    model = mb.load(name)
    p = model.parameters(**values)
    for claim in claims.energy_claims(scene, plan.make(reverse), None, reverse=True):
        (found,) = claim.measure(Plan(samples=1 << 16))
        mu = from_degrees(claim.where["theta_i_deg"])[2]
        exact = references.reverse_albedo(name, mu, **p._asdict(), **model.picks)
        assert exact is not None
        bar = found.estimate.half_width(1e-7)
        assert abs(found.estimate.mean - exact.value) <= bar + exact.error < 0.01


def test_one_channel_gains(tmp_path: Path) -> None:
    """The mean over channels is 0.9: energy is judged per channel."""
    text = (
        '[surface]\nmodel = "lambert_unnormalised"\nc = [0.4, 0.3, 0.16]\n'
        "[view]\ntheta_o_deg = 20\n"
    )
    report = radiance(written(tmp_path, text), samples=1 << 10, threads=1)
    energy = [f.verdict for f in report.results[0].findings if f.quantity == "A <= 1"]
    assert energy == ["fail", "pass", "pass"]


def test_reproduction_and_plot(cli: Callable[..., Any], tmp_path: Path) -> None:
    """The command that a finding shows gives the finding; its report can be drawn again."""
    out, first, again = (tmp_path / n for n in ("r.json", "a.png", "b.png"))
    scene = ["--model", "lambert_unnormalised", "-p", "c=0.5/0.1", "--environment", "cosine:2"]
    more = ["--theta-o", "0,40", "--seed", "3", "--export-json", str(out), "--plot", str(first)]
    assert cli("radiance", *scene, *more).code == 1
    findings = json.loads(out.read_text())["results"][0]["findings"]
    bad = [f for f in findings if f["verdict"] == "fail"]
    assert len(bad) == 2
    assert all("reproduce" not in f for f in findings if f["verdict"] == "pass")
    assert cli("plot", str(out), "-o", str(again)).code == 0
    assert first.read_bytes() == again.read_bytes()
    program, *words = bad[1]["reproduce"].split()
    assert program == "brdf-check"
    assert cli(*words, "--export-json", str(out)).code == 1
    assert bad[1] in json.loads(out.read_text())["results"][0]["findings"]
