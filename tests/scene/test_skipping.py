"""Skipping what a scene does not need changes no result beyond rounding and the error bars."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import EXAMPLES, estimates, written

import montecarlo_brdf as mb
from montecarlo_brdf.scene import plan, skies
from montecarlo_brdf.scene.read import read_scene
from montecarlo_brdf.scene.scene import Directional, Point, Scene, View
from montecarlo_brdf.scene.skies import cap_of
from montecarlo_brdf.scene.surface import Lobe, Surface
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.vectors import from_degrees

LEVEL = 1e-6 / (200 * 3 + 100)  # of a false alarm, per comparison


def _agree(scene: Scene, theta: float, samples: int) -> None:
    more: dict[str, Any] = {"points": "independent", "samples": samples, "seed": 5}
    short, long = (estimates(scene, theta, skip=skip, **more) for skip in (True, False))
    for a, b in zip(short, long, strict=True):
        if a.unfit or b.unfit:  # said so, and judged by nobody
            continue
        a, b = a.estimate, b.estimate
        bar = quantile(LEVEL / 2.0, 15)
        noise = sum(e.stderr for e in (a, b) if e.samples > 1)
        assert abs(a.mean - b.mean) <= bar * noise + 1e-12 * abs(b.mean) + 1e-15


@pytest.mark.parametrize("file", sorted(EXAMPLES.glob("*.toml")), ids=lambda f: f.stem)
def test_examples(file: Any) -> None:
    for theta in (0.0, 60.0):
        _agree(read_scene(file), theta, 1 << 16)


WIDER = {
    "mixture under harmonics": """
[surface]
model = "0.3 lambert + 0.5 ggx"
[environment]
kind = "harmonics"
coefficients = [[2, 0.3, 0.1, 0.2], [2, 0.3, 0.1, 0.2], [0, 0, 0, 0]]
""",
    "GGX under an image": """
[[surface.lobes]]
weight = [0.5, 0.5, 0]
model = "ggx"
alpha = 0.3
[[surface.lobes]]
weight = 0
model = "phong"
[environment]
kind = "image"
file = "sky.npy"
""",
}


@pytest.mark.parametrize("name", WIDER)
def test_other_surfaces_and_skies(name: str, tmp_path: Path) -> None:
    """A wider study of 200 scenes is scripts/skipping_study.py."""
    np.save(tmp_path / "sky.npy", np.random.default_rng(0).random((8, 16)) ** 6)
    _agree(written(tmp_path, WIDER[name]), 40.0, 1 << 14)


angles = st.tuples(st.floats(0.0, 130.0), st.floats(0.0, 360.0)).map(lambda a: from_degrees(*a))
values = st.sampled_from([0.0, 0.25, 0.5, 1.0]) | st.floats(0.01, 1.0)
colours = st.one_of(values.map(lambda v: (v, v, v)), st.tuples(values, values, values))
shapes = st.one_of(
    st.just(skies.Constant()),
    st.builds(skies.Cosine, st.floats(0.0, 4.0), angles),
    st.builds(cap_of, st.floats(40.0, 120.0), angles),
)
lights = st.one_of(
    st.builds(Directional, angles, colours),
    st.builds(
        lambda at, colour: Point(at, colour),
        st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-1.0, 3.0)).filter(
            lambda v: max(map(abs, v)) > 0.1
        ),
        colours,
    ),
)
LAMBERT, PHONG = mb.load("lambert"), mb.load("phong")
lobes = st.one_of(
    st.builds(
        lambda w, a: Lobe("lambert", w, LAMBERT, tuple(LAMBERT.parameters(albedo=v) for v in a)),
        colours,
        colours,
    ),
    st.builds(
        lambda w, k, n: Lobe("phong", w, PHONG, tuple(PHONG.parameters(ks=v, n=n) for v in k)),
        colours,
        colours,
        st.floats(0.5, 20.0),
    ),
)
scenes = st.builds(
    lambda *parts: Scene("random", 3, *parts),
    st.lists(lobes, min_size=1, max_size=3).map(lambda ls: Surface(tuple(ls))),
    st.none() | st.builds(lambda s, c: skies.Sky((s, s, s), c), shapes, colours),
    st.lists(lights, max_size=4).map(tuple),
    colours,
    colours,
)


@given(scenes, st.floats(0.0, 85.0))
@settings(max_examples=200)
def test_random_scenes(scene: Scene, theta: float) -> None:
    _agree(scene, theta, 1 << 13)


def _skipped(scene: Scene) -> str:
    return "; ".join(
        f"{i.what}: {i.reason}" for i in plan.make(scene).items if not i.evaluated
    )


def test_what_is_skipped_and_why() -> None:
    scene = read_scene(EXAMPLES / "cook_torrance.toml")
    surface: Any = scene.surface
    dark = surface.lobes[1]._replace(weights=(0.0, 0.0, 0.0))
    assert "lobe cook_torrance: its weight is zero" in _skipped(
        replace(scene, surface=Surface((surface.lobes[0], dark)))
    )
    assert "environment: it is black" in _skipped(
        replace(scene, sky=scene.sky._replace(scales=(0.0,) * 3))  # type: ignore[union-attr]
    )
    below = skies.Sky((cap_of(10.0, from_degrees(101.0)),) * 3, (1.0,) * 3)
    assert "below the horizon" in _skipped(replace(scene, sky=below))
    up = Directional((0.0, 0.0, 1.0), (0.0,) * 3), Directional((0.0, 0.0, -1.0), (1.0,) * 3)
    lit = replace(scene, lights=up)
    assert "1 lights: black" in _skipped(lit)
    assert "1 lights: below the horizon" in _skipped(lit)
    assert "equal to another channel" in _skipped(scene)
    assert "the hemisphere that the cap covers" in _skipped(scene)
    assert "emission: it is zero; " not in _skipped(replace(scene, emission=(1.0,) * 3))


def test_views_that_must_be_equal_are_evaluated_once() -> None:
    view = View((0.0, 40.0), (0.0, 90.0))
    lambert = read_scene(EXAMPLES / "lambert.toml")
    assert len(set(plan.make(replace(lambert, view=view)).views.values())) == 1
    phong = replace(read_scene(EXAMPLES / "phong.toml"), view=view)
    assert len(set(plan.make(phong).views.values())) == 4  # a light breaks the symmetry
    assert len(set(plan.make(replace(phong, lights=())).views.values())) == 2
    assert len(set(plan.make(replace(phong, lights=()), skip=False).views.values())) == 4
