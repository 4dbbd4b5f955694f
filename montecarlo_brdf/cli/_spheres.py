"""The scenes of a row of spheres: one per combination of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError

FURNACE = 0.5  # radiance of the furnace: a lossless sphere disappears in its grey
MOST_SPHERES = 12


def scenes_of(options: dict[str, Any]) -> list[tuple[str, Any]]:
    """(label, scene) of every parameter set."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._values import parameter_sets
    from montecarlo_brdf.scene.make import scene_of

    path, spec, sky = options["scene"], options["spec"], options["environment"]
    if path is not None:
        if spec or sky:
            raise UserError("give a scene file, or --model and --environment, not both")
        return _from_file(path, options["assignments"])
    if not spec or not (sky or options["furnace"]):
        raise UserError("give a scene file, or --model with --environment or --furnace")
    model = loading.load(spec)
    sets = parameter_sets(model, options["assignments"])
    _check_count(len(sets))
    labels = [_label(spec, options["assignments"], p) for p in sets]
    scenes = [scene_of(model, p, sky or f"constant:{FURNACE}") for p in sets]
    return list(zip(labels, scenes, strict=True))


def _label(spec: str, assignments: Sequence[str], p: Any) -> str:
    """The model and the parameters that were given."""
    names = [a.partition("=")[0].strip().replace(".", "_") for a in assignments]
    rows = [f"{n} = {_shown(getattr(p, n))}" for n in names if hasattr(p, n)]
    return f"{spec}\n{', '.join(rows)}" if rows else spec


def _shown(value: Any) -> str:
    return "/".join(f"{v:.3g}" for v in value) if isinstance(value, tuple) else f"{value:.3g}"


def _from_file(path: Path, assignments: Sequence[str]) -> list[tuple[str, Any]]:
    """The scene once per combination of -p values, which replace those of its surface."""
    import itertools

    from montecarlo_brdf.cli._values import _parameter
    from montecarlo_brdf.scene.read import read_scene

    axes = []
    for assignment in assignments:
        name, equals, text = assignment.partition("=")
        if not equals or not text:
            raise UserError(f"-p takes name=value, not {assignment!r}")
        axes.append(
            [(name.strip(), v) for part in text.split(",") for v in _parameter(name, part.strip())]
        )
    rows = list(itertools.product(*axes))
    _check_count(len(rows))
    made = [(read_scene(path, **dict(row)), row) for row in rows]
    return [("\n".join([s.name, *(f"{n} = {v}" for n, v in row)]), s) for s, row in made]


def _check_count(count: int) -> None:
    if count > MOST_SPHERES:
        raise UserError(f"{count} spheres are more than the {MOST_SPHERES} that fit a picture")
