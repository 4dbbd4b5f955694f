"""Scenes made in tests, and their radiance at one view."""

from pathlib import Path
from typing import Any

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.scene import plan as planning
from montecarlo_brdf.scene import radiance
from montecarlo_brdf.scene.read import read_scene
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.vectors import from_degrees

EXAMPLES = Path(__file__).parents[2] / "examples"


def written(folder: Path, text: str) -> Scene:
    """The scene of a file with this text."""
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return read_scene(file)


def estimates(scene: Scene, theta: float, samples: int = 1 << 14, **more: Any) -> list[Any]:
    """L_o per channel."""
    plan = planning.make(scene, more.pop("skip", True))
    return radiance.measure(plan, from_degrees(theta), Plan(samples=samples, **more))
