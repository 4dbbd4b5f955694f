"""The scenes of a page of spheres: one per combination of parameters."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.verify.common import shown_parameters

FURNACE = 0.5  # radiance of the furnace: a lossless sphere disappears in its grey
MOST_SPHERES = 12


class Case(NamedTuple):
    """One sphere."""

    label: str
    scene: Any


def scenes_of(options: dict[str, Any]) -> tuple[list[Case], int]:
    """All spheres, and how many stand in a row: the values of the last parameter that varies."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._values import axes, parameter_sets
    from montecarlo_brdf.scene.read import scene_of

    path, spec, sky = options["scene"], options["spec"], options["environment"]
    if path is not None:
        if spec or sky:
            raise UserError("give a scene file, or --model and --environment, not both")
        return _from_file(path, options["assignments"])
    if not spec or not (sky or options["furnace"]):
        raise UserError("give a scene file, or --model with --environment or --furnace")
    model = loading.load(spec)
    columns = _columns(axes(options["assignments"], lambda name: model))
    cases = [
        Case(
            _label(spec, options["assignments"], model.of(p), p),
            scene_of(model.of(p), p, sky or f"constant:{FURNACE}"),
        )
        for p in parameter_sets(model, options["assignments"])
    ]
    return cases, columns


def _columns(listed: dict[str, list[Any]]) -> int:
    """Spheres in a row; complains if there are too many."""
    counts = [len(values) for values in listed.values()]
    total = math.prod(counts)
    if total > MOST_SPHERES:
        raise UserError(f"{total} spheres are more than the {MOST_SPHERES} that fit a picture")
    varied = [n for n in counts if n > 1]
    return varied[-1] if varied else 1


def _label(spec: str, assignments: Sequence[str], model: Any, p: Any) -> str:
    """The model, and the parameters and choices that were given."""
    values = shown_parameters(model, p)
    names = [a.partition("=")[0].strip() for a in assignments]
    rows = [f"{n} = {_shown(values[n])}" for n in names if n in values]
    return "\n".join([spec, ", ".join(rows)]) if rows else spec


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return "/".join(map(_shown, value))
    return value if isinstance(value, str) else f"{value:.3g}"


def _from_file(path: Path, assignments: Sequence[str]) -> tuple[list[Case], int]:
    """The scene once per combination of -p values, which replace those of its surface."""
    from montecarlo_brdf.cli._values import _parameter
    from montecarlo_brdf.scene.read import read_scene

    listed: dict[str, list[Any]] = {}
    for assignment in assignments:
        name, equals, text = (t.strip() for t in assignment.partition("="))
        if not equals or not text or name in listed:
            raise UserError(f"-p takes name=value, once per name, not {assignment!r}")
        listed[name] = [v for part in text.split(",") for v in _parameter(name, part.strip())]
    columns = _columns(listed)
    cases = []
    for row in itertools.product(*listed.values()):
        scene = read_scene(path, **dict(zip(listed, row, strict=True)))
        told = ", ".join(f"{n} = {_typed(v)}" for n, v in zip(listed, row, strict=True))
        cases.append(Case(f"{scene.name}\n{told}" if told else scene.name, scene))
    return cases, columns


def _typed(value: Any) -> str:
    """A value as it was typed, a number of a range in three digits."""
    return "/".join(value) if isinstance(value, tuple) else _shown(value)
