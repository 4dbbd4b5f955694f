"""Pictures: no text leaves the canvas or lies on another, all that is drawn is named, what cannot
be drawn is said."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Outcome
from matplotlib.figure import Figure
from matplotlib.text import Text
from PIL import Image

from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.report import bench
from montecarlo_brdf.report.pictures import albedo, convergence, margins, radiance, spheres
from montecarlo_brdf.report.pictures import stability as heat

Call = Callable[..., Outcome]
CLOSE = 1.0  # pixels that texts may share


def texts(figure: Figure) -> list[tuple[str, Any]]:
    """All words of a figure with where they stand, in pixels."""
    figure.draw_without_rendering()
    renderer = figure._get_renderer()  # type: ignore[attr-defined]
    shown = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]
    off = [a for a in figure.axes if not (a.axison and a.get_visible())]
    hidden = {t for a in off for t in a.findobj(Text)}
    outside = {t for a in figure.axes for t in _beyond(a)}
    found = [t for t in shown if t not in hidden | outside]
    return [(t.get_text(), t.get_window_extent(renderer)) for t in found]


def _beyond(axes: Any) -> list[Text]:
    """Labels of ticks that are not in the picture."""
    found = []
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        low, high = min(low, high), max(low, high)
        for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
            if not low <= tick.get_loc() <= high or not tick.label1.get_visible():
                found += [tick.label1, tick.label2]
            found += [] if tick.label1.get_visible() else [tick.label1]
            found += [tick.label2]
    return found


def faults(figure: Figure) -> list[str]:
    found, canvas = texts(figure), figure.bbox
    out = [
        f"{t!r} leaves the canvas" for t, b in found
        if b.x0 < canvas.x0 - CLOSE or b.x1 > canvas.x1 + CLOSE
        or b.y0 < canvas.y0 - CLOSE or b.y1 > canvas.y1 + CLOSE
    ]  # fmt: skip
    for (one, a), (two, b) in itertools.combinations(found, 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        down = min(a.y1, b.y1) - max(a.y0, b.y0)
        if across > CLOSE and down > CLOSE:
            out.append(f"{one!r} lies on {two!r}")
    return out


def test_faults_are_seen() -> None:
    wide, twice = Figure(figsize=(2.0, 2.0)), Figure(figsize=(3.0, 3.0))
    wide.suptitle("a title that is far too long for such a figure")
    twice.text(0.4, 0.5, "one here")
    twice.text(0.45, 0.5, "another here")
    assert "leaves" in faults(wide)[0] and "lies on" in faults(twice)[0]


def furnace(name: str, params: dict[str, Any], **more: Any) -> Result:
    """Albedos at seven angles, of each channel of a colour."""
    width = max([len(v) for v in params.values() if isinstance(v, tuple)], default=0)
    found = [
        Finding("A", {"theta_o_deg": t, **({"channel": c} if width else {})},
                more.get("verdict", Verdict.PASS), value=more.get("value", 0.5 + 0.001 * t),
                stderr=1e-4, expected=0.5 + 0.001 * t, tolerance=1e-3, samples=64)
        for c in range(width or 1) for t in (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0)
    ]  # fmt: skip
    return Result(name, params, "furnace", found)


LONG = {"distribution": "blinn_phong", "masking": "walter_correlated", "fresnel": "conductor",
        "normalisation": "4", "alpha": 0.123456, "k": 3.9876}  # fmt: skip
COLOUR = {"alpha": 0.3, "f0": (1.0, 0.71, 0.29)}
FURNACES = {
    "one": [furnace("lambert", {"albedo": 0.8})],
    "colours": [furnace("ggx", COLOUR)],
    "two colours": [furnace("ggx", {**COLOUR, "alpha": a}) for a in (0.1, 0.4)],
    "long names": [furnace("brdfs/materials/metals/brushed.py", {**LONG, "k": k}) for k in (1, 2)],
    "NaN": [furnace("bad.py", {}, value=math.nan)],
    "above 1": [furnace("phong", {"n": 2.0}, value=21.0, verdict=Verdict.KNOWN)],
    "nine": [furnace("ggx", {"alpha": 0.1 * k}) for k in range(9)],
    "26 models": [furnace(f"model_of_some_length_{k}", LONG) for k in range(26)],
    "60 models": [furnace(f"model_{k}", COLOUR) for k in range(60)],
}


SLOW = ("nine", "60 models")


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] if n in SLOW else []) for n in FURNACES]
)
def test_a_furnace(name: str) -> None:
    figure = albedo.figure(Report(Command.FURNACE, {}, FURNACES[name]))
    assert faults(figure) == []
    words = " ".join(" ".join(t.split()) for t, _ in texts(figure))
    models = [r.model for r in FURNACES[name]]
    if name == "60 models":
        assert "12 more are not drawn" in words
        models = models[: albedo.MOST_PANELS]
    assert all(m in words.replace(" ", "") for m in models)
    assert ("all values are NaN" in words) == (name == "NaN")
    assert ("known" in words) == (name == "above 1")
    assert all(f"channel {k}" in words for k in range(3)) or name != "colours"


def test_every_series_has_a_mark_of_its_own() -> None:
    figure = albedo.figure(Report(Command.FURNACE, {}, FURNACES["colours"]))
    drawn = [(line.get_color(), line.get_marker()) for line in figure.axes[0].lines]
    marked = [mark for mark in drawn if mark[1] not in ("None", "", " ", "_", "|")]
    assert len({*marked}) == 3 and len({colour for colour, _ in marked}) == 3


def test_a_scene() -> None:
    found = [
        Finding("L_o", {"theta_o_deg": t, "channel": c}, Verdict.PASS, value=0.1 * c + 0.1,
                stderr=1e-5, expected=0.1 * c + 0.1, tolerance=1e-3, samples=64)
        for c in range(3) for t in (0.0, 30.0, 60.0, 85.0)
    ]  # fmt: skip
    result = Result("a scene " * 20, {}, "L_o", found)
    figure = radiance.figure(Report(Command.RADIANCE, {}, [result]))
    assert faults(figure) == []
    words = " ".join(t for t, _ in texts(figure))
    assert "dashed: tolerance" in words and "dash above: truth" in words
    top = [line for line in figure.axes[0].lines if line.get_linestyle() != "None"]
    assert top == []  # four views say nothing of what lies between them


def curve(sampler: str, points: str, error: float, slope: float) -> Finding:
    levels = [
        {"samples": 2**k, "value": error and error * 2.0 ** (slope * k), "randomisations": [error]}
        for k in range(4, 12)
    ]  # fmt: skip
    return Finding("slope", {"sampler": sampler, "points": points}, Verdict.PASS, value=slope,
                   stderr=0.01, expected=slope, tolerance=0.1, reference={"error": 1e-16},
                   estimators=levels)  # fmt: skip


@pytest.mark.parametrize("count", [1, *(pytest.param(n, marks=pytest.mark.slow) for n in (3, 6))])
def test_convergence(count: int) -> None:
    samplers = ("uniform", "cosine", "own", "half_vector", "mirror", "panels")[:count]
    sets = ("independent", "stratified", "sobol", "lattice")
    found = [curve(s, p, 0.1, -0.5) for s in samplers for p in sets[:3]]
    found += [curve(s, "lattice", 0.0, math.nan) for s in samplers]
    result = Result("my.py", LONG, "converge", found)
    report = Report(Command.CONVERGE, {"theta_o_deg": 60.0}, [result])
    figure = convergence.figure(report)
    assert faults(figure) == []
    words = " ".join(t for t, _ in texts(figure))
    flat = " ".join(words.split())
    assert "lattice exact" in flat and "sobol -0.50" in flat


def test_checks_against_their_tolerances() -> None:
    def one(check: str, value: float, verdict: Verdict) -> Result:
        f = Finding("x", {}, verdict, "at most", value, 0.0, 1.0, 1e-3, samples=4)
        return Result("my.py", {}, check, [f])

    rows = [one("furnace", 1.0, Verdict.PASS), one("energy", 40.0, Verdict.FAIL)]
    rows += [one("a check with a name that is longer than any " + "x" * 60, 1.2, Verdict.KNOWN)]
    figure = margins.figure(Report(Command.RUN, {}, rows))
    assert faults(figure) == [] and {"pass", "fail", "known"} <= {t for t, _ in texts(figure)}
    many = [one(f"check {k}", math.nan, Verdict.FAIL) for k in range(100)]
    assert faults(margins.figure(Report(Command.RUN, {}, many))) == []


def test_stability_shows_each_precision_in_its_own_roundings() -> None:
    points = [(10.0 * k, 0.1 * j, 1e-7 * (1 + j * k)) for j in range(1, 6) for k in range(8)]
    names = {"float32": 6e-8, "float64": 1.1e-16}
    measured = [{"name": n, "parameter": "alpha", "eps": e} for n, e in names.items()]
    curves = [points, [(t, a, 1e-17) for t, a, _ in points]]
    result = Result("ggx", {}, "stability", [], curves)
    figure = heat.figure(Report(Command.STRESS, {}, [result], {"precisions": [measured]}))
    assert faults(figure) == []
    grids = [a.collections[0].get_array() for a in figure.axes[:2]]
    assert grids[0].max() > 10.0 and grids[1].max() == heat.LEAST
    assert "no error above one rounding" in " ".join(t for t, _ in texts(figure))


def test_pictures_of_commands(cli: Call, tmp_path: Path) -> None:
    for k, line in enumerate((
        "run --model lambert --check furnace,energy", "compare lambert eon", "identities",
    )):  # fmt: skip
        picture, again, data = (tmp_path / f"{k}{end}" for end in (".png", "b.png", ".json"))
        assert cli(*line.split(), "--plot", picture, "--export", data).code in (0, 1)
        assert cli("plot", data, "-o", again).code == 0
        assert picture.read_bytes() == again.read_bytes() != b""


def test_a_benchmark_is_drawn_again(cli: Call, tmp_path: Path) -> None:
    data, one, two = (tmp_path / name for name in ("t.json", "a.svg", "b.svg"))
    line = ("bench", "--model", "lambert", "--quick", "--method", "cosine x sobol,uniform x sobol")
    assert cli(*line, "--export", data, "--plot", one).code == 0
    assert cli("plot", data, "-o", two).code == 0 and one.read_bytes() == two.read_bytes()
    damaged = json.loads(data.read_text())
    for width in (40, 60, 80, 118):  # tables keep to a terminal, and no number is torn
        lines = bench.table(damaged, width).splitlines()
        rows = [row for found in damaged["targets"].values() for row in found]
        words = {word for line in lines for word in line.split()}
        assert {f"{row['error']:.1e}" for row in rows} <= words
        assert max(len(line) for line in lines[4:] if "not within" not in line) <= width
    del damaged["timings"]
    data.write_text(json.dumps(damaged))
    outcome = cli("plot", data, "-o", two)
    assert outcome.code == 2 and "it has no timings" in outcome.err


class Ball:
    """A sphere whose radiance is a number."""

    def __init__(self, radiance: float, size: int = 64, background: float = 0.5) -> None:
        x = (np.arange(size) + 0.5) * (2.2 / size) - 1.1
        self.inside = np.hypot(*np.meshgrid(x, x)) < 1.0
        self.values = np.where(self.inside, radiance, background)[:, :, None]


def test_the_scale_of_a_furnace_fits() -> None:
    differences = [spheres.difference(Ball(0.5 * (1.0 + d)), 0.5) for d in (-0.001, 0.0173)]
    scale = spheres.fitting(differences)
    assert scale == 0.02 and spheres.Furnace(0.5, scale).numbers()[0] == "-2% or less"
    strong = spheres.coloured(differences[1], scale)
    weak = spheres.coloured(differences[1], 1.0)
    middle = (32, 32)
    assert np.ptp(strong[middle]) > 100.0 > np.ptp(weak[middle])


def test_edges_are_soft_and_numbers_are_not() -> None:
    ball = Ball(1.0, background=0.0)
    soft = spheres.smooth(ball)
    between = (soft > 0.05) & (soft < 0.95)
    assert 50 < between.sum() < 400 and set(np.unique(ball.values)) == {0.0, 1.0}
    area = math.pi / 2.2**2
    assert abs(soft.mean() - area) < abs(0.0005)


def test_exposure_brightens_a_picture(cli: Call, tmp_path: Path) -> None:
    line = ("render", "--model", "lambert", "--environment", "constant:0.05", "--size", 16)
    means = []
    for stops in (0, 2):
        assert cli(*line, "--exposure", stops, "-o", tmp_path / "s.png").code == 0
        means.append(np.asarray(Image.open(tmp_path / "s.png"))[8, 8].mean())
    assert means[1] > 1.5 * means[0]
    assert cli(*line, "--exposure", 1000, "-o", tmp_path / "s.png").code == 2
    assert cli(*line, "--scale", 1e9, "-o", tmp_path / "s.png").code == 2
