"""Does skipping change a result? Random scenes of all kinds: python scripts/skipping_study.py OUT

Per scene one view, with and without skipping, independent points: parts that are sums must agree to
rounding, sampled parts within the joint error bar. The level is that of a false alarm in the whole
study. An estimate that says that it must not be believed is counted, and judged by nobody.
"""

import json
import random
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from environment import describe

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.scene import plan, radiance
from montecarlo_brdf.scene.read import read_scene
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.vectors import from_degrees

SCENES, SAMPLES, LEVEL = 200, 1 << 13, 1e-6
SURFACES = (
    'model = "lambert"\nalbedo = {colour}',
    'model = "ggx"\nalpha = {width}\nf0 = {colour}',
    'model = "ggx_anisotropic"\nalpha_x = {width}\nalpha_y = {width}',
    'model = "cook_torrance"\nalpha = {width}\nf0 = {colour}',
    'model = "phong"\nks = {colour}\nn = {exponent}',
    'model = "blinn_phong"\nks = {colour}\nn = {exponent}',
    'model = "oren_nayar"\nalbedo = {colour}\nsigma = {width}',
    'model = "0.5 lambert + 0 ggx"',
    'model = "0.3 lambert + 0.5 ggx"',
)
SKIES = (
    "",
    '[environment]\nkind = "constant"\nradiance = {colour}\n',
    '[environment]\nkind = "gradient"\ntop = {colour}\nbottom = {colour}\n',
    '[environment]\nkind = "cosine"\nexponent = {exponent}\nradiance = {colour}\naxis = {axis}\n',
    '[environment]\nkind = "cap"\nhalf_angle_deg = {angle}\nradiance = {colour}\naxis = {axis}\n',
    '[environment]\nkind = "harmonics"\ncoefficients = [2, 0.3, {small}, 0.2]\n',
    '[environment]\nkind = "image"\nfile = "sky.npy"\nscale = {number}\n',
)  # fmt: skip
LIGHTS = (
    '[[lights]]\nkind = "directional"\ndirection = {axis}\nirradiance = {colour}\n',
    '[[lights]]\nkind = "point"\nposition = [{small}, 1.3, {number}]\nintensity = {colour}\n',
)


def filled(draw: random.Random, text: str) -> str:
    """The text with a value for every placeholder; each stands for itself."""
    makers = {
        "colour": lambda: _colour(draw),
        "width": lambda: draw.choice(("0.1", "0.3", "1.0")),
        "exponent": lambda: draw.choice(("1", "5", "30")),
        "angle": lambda: f"{draw.uniform(3.0, 100.0):.3f}",
        "axis": lambda: "{tilt_deg = {tilt}, azimuth_deg = {turn}}",
        "tilt": lambda: f"{draw.uniform(0.0, 130.0):.3f}",
        "turn": lambda: f"{draw.uniform(0.0, 360.0):.3f}",
        "small": lambda: f"{draw.uniform(-0.3, 0.3):.3f}",
        "number": lambda: draw.choice(("0", "0.5", "2.0")),
    }  # fmt: skip
    for name, make in makers.items():
        while f"{{{name}}}" in text:
            text = text.replace(f"{{{name}}}", make(), 1)
    return text


def _colour(draw: random.Random) -> str:
    grey = draw.choice((0.0, 0.5, 1.0, round(draw.random(), 3)))
    row = [grey] * 3 if draw.random() < 0.5 else [draw.choice((0.0, grey, 0.7)) for _ in range(3)]
    return str(row)


def scene_text(draw: random.Random) -> str:
    """One to three lobes, a sky or none, up to four lights, perhaps ambient and emission."""
    parts = []
    for _ in range(draw.randint(1, 3)):
        weight = draw.choice(("0", "0.5", "[0.3, 0.3, 0.3]", "[0.1, 0, 0.4]"))
        parts.append(f"[[surface.lobes]]\nweight = {weight}\n{draw.choice(SURFACES)}\n")
    parts.append(draw.choice(SKIES))
    parts += [draw.choice(LIGHTS) for _ in range(draw.randint(0, 4))]
    for name in ("ambient", "emission"):
        parts.append(f"[{name}]\nradiance = {{colour}}\n" if draw.random() < 0.3 else "")
    return filled(draw, "".join(parts))


def compared(text: str, theta: float, folder: Path) -> list[tuple[str, float]]:
    """Per channel what was compared, and how far apart it is in units of what is allowed."""
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    scene, sampling = read_scene(file), Plan(points="independent", samples=SAMPLES, seed=5)
    wo = from_degrees(theta, 20.0)
    short, long = (
        radiance.measure(plan.make(scene, skip), wo, sampling) for skip in (True, False)
    )
    bar = quantile(LEVEL / (3 * SCENES) / 2.0, 15)
    rows = []
    for a, b in zip(short, long, strict=True):
        x, y = a.estimate, b.estimate
        noise = sum(e.stderr for e in (x, y) if e.samples > 1)
        allowed = bar * noise + 1e-12 * abs(y.mean) + 1e-15
        kind = "not believed" if a.unfit or b.unfit else "sampled" if noise else "exact"
        rows.append((kind, abs(x.mean - y.mean) / allowed))
    return rows


def main() -> None:
    """Run all scenes and record what was found."""
    draw, rows, bad = random.Random(1), [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.save(folder / "sky.npy", np.random.default_rng(0).random((8, 16)) ** 6)
        for _ in range(SCENES):
            text = scene_text(draw)
            found = compared(text, draw.uniform(0.0, 85.0), folder)
            rows += found
            bad += [text] * any(k != "not believed" and d > 1.0 for k, d in found)
    counts = {k: sum(kind == k for kind, _ in rows) for k in ("exact", "sampled", "not believed")}
    largest = {k: max((d for kind, d in rows if kind == k), default=0.0) for k in counts}
    result: dict[str, Any] = {
        "scenes": SCENES, "level": LEVEL, "channels compared": counts,
        "largest difference over what is allowed": largest, "scenes that disagree": bad,
    }  # fmt: skip
    text = json.dumps({"environment": describe(), **result}, indent=1)
    Path(sys.argv[1]).write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
