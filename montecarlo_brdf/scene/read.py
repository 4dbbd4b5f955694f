"""Scenes from TOML files, every value checked, and from a command line.

docs/scenes.md lists all keys.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple, TypeGuard

from montecarlo_brdf import loading
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.plan import check_theta
from montecarlo_brdf.model import Model, ParameterSet, channels
from montecarlo_brdf.scene.colour import Band, Colour, illuminant_table, pairs, spread
from montecarlo_brdf.scene.environment import read_sky, short_sky
from montecarlo_brdf.scene.expected import TOLERANCE, Expected, named_values
from montecarlo_brdf.scene.scene import Directional, Light, Point, Scene, View
from montecarlo_brdf.scene.skies import Sky
from montecarlo_brdf.scene.standard import Form, Standard
from montecarlo_brdf.scene.surface import Surface, lobes_of
from montecarlo_brdf.scene.table import SceneTable
from montecarlo_brdf.toml import parse


class Part(NamedTuple):
    """A lobe as it is written: its colours may have fewer channels than the scene."""

    weight: Colour
    model: Model
    parameters: ParameterSet


def read_scene(path: str | Path, **parameters: object) -> Scene:
    """The scene in a file.

    path: of a TOML file (docs/scenes.md). parameters: values that replace those of its surface
    model, by name; a tuple makes a colour. Raises UserError with the line and what is allowed for
    anything wrong in it.
    """
    file = Path(path)
    data, text = parse(file)
    top = SceneTable(file, text, data)
    top.band = _band(top)
    scene = _assembled(top, parameters)
    return replace(scene, words=(str(path), *assigned(parameters)))


def scene_of(
    model: Model,
    p: ParameterSet,
    environment: str,
    theta_o_deg: Sequence[float] = View().theta_o_deg,
) -> Scene:
    """`model` with parameters `p` (colours allowed) under a sky like "cosine:8" or "cap:10:60".

    theta_o_deg: polar angles of the view in degrees.
    """
    sky, own = short_sky(environment), len(channels(p))
    widths = {own, sky.channels} - {1}
    if len(widths) > 1:
        raise UserError(f"the model has {own} channels and the environment {sky.channels}")
    count = max(widths, default=1)
    dark = (0.0,) * count
    shown = {model.labels.get(k, k): v for k, v in p._asdict().items()} | dict(model.of(p).picks)
    scene = Scene(
        name=f"{model.name} under {environment}",
        channels=count,
        surface=Surface(tuple(lobes_of(model, p, (1.0,) * count, count))),
        sky=sky.spread(count),
        ambient=dark,
        emission=dark,
        words=("--model", model.name, *assigned(shown), "--environment", environment),
    )
    return with_views(scene, theta_o_deg)


def assigned(values: Mapping[str, object]) -> list[str]:
    """-p name=value of every parameter."""
    rows = ((k, v if isinstance(v, tuple) else (v,)) for k, v in values.items())
    return [word for k, v in rows for word in ("-p", f"{k}={'/'.join(map(str, v))}")]


def with_views(scene: Scene, theta_o_deg: Sequence[float]) -> Scene:
    """The scene seen from other polar angles."""
    angles = tuple(check_theta(t) for t in theta_o_deg)
    return replace(scene, view=scene.view._replace(theta_o_deg=angles))


def _assembled(top: SceneTable, parameters: Mapping[str, object]) -> Scene:
    """The scene with every colour spread over the same number of channels."""
    name = top.text_of("name", top.file.stem)
    surface = _surface(top.table("surface"), parameters)
    sky = read_sky(top.table("environment")) if "environment" in top.data else None
    lights = [_light(t) for t in top.tables("lights")]
    ambient, emission = _single(top, "ambient"), _single(top, "emission")
    view = _view(top.table("view", {}))
    expected = _expected(top, surface, view)
    top.done()
    colours = [ambient, emission, *(light.colour for light in lights), *_colours(surface)]
    count = _channels(top, colours, sky)
    if isinstance(surface, Standard) and sky:
        raise top.error(
            "the standard lighting equation has lights and no [environment]", "environment"
        )
    return Scene(
        name=name,
        channels=count,
        surface=_spread_surface(surface, count),
        sky=sky.spread(count) if sky else None,
        lights=tuple(light._replace(colour=spread(light.colour, count)) for light in lights),
        ambient=spread(ambient, count),
        emission=spread(emission, count),
        view=view,
        band=top.band,
        expected=_of_channels(top, expected, count),
    )


def _expected(
    top: SceneTable, surface: Standard | list[Part], view: View
) -> Expected | None:
    """[expected]: what L_o must be, a number or a formula, or one for each channel."""
    top.know("expected")
    if "expected" not in top.data:
        return None
    table = top.table("expected")
    given = table.take("radiance")
    rows = given if isinstance(given, list) else [given]
    formulas = tuple(map(str, rows))
    good = rows and not any(isinstance(r, (bool, dict, list)) for r in rows)
    if not good:
        raise table.error("radiance must be a number, a formula in quotes, or a list", "radiance")
    relative = table.number("tolerance", TOLERANCE, 0.0, 1.0)
    made = Expected(formulas, relative, table.number("absolute", 0.0, 0.0))
    more = named_values(surface[0].model, surface[0].parameters, 0) if _lone(surface) else {}
    with table.at("radiance"):
        for k in range(len(formulas)):
            made.value(k, view.theta_o_deg[0], view.phi_o_deg[0], more)
    table.done()
    return made


def _of_channels(top: SceneTable, expected: Expected | None, count: int) -> Expected | None:
    if expected and len(expected.formulas) not in (1, count):
        many = f"{len(expected.formulas)} values for {count} channels"
        raise top.table("expected").error(f"radiance has {many}", "radiance")
    return expected


def _lone(surface: Standard | list[Part]) -> TypeGuard[list[Part]]:
    """Whether formulas can name the parameters: of one model there is one each."""
    return isinstance(surface, list) and len(surface) == 1


def _channels(top: SceneTable, colours: Sequence[Colour], sky: Sky | None) -> int:
    """The one number of channels that all colours of the scene have."""
    widths = set(map(len, colours))
    widths |= {sky.channels} if sky else set()
    widths |= {len(top.band.wavelengths)} if top.band else set()
    widths -= {1}
    if len(widths) > 1:
        raise top.error(
            f"all colours of a scene need the same number of channels, not {sorted(widths)}"
        )
    return max(widths, default=1)


def _colours(surface: Standard | list[Part]) -> list[Colour]:
    if isinstance(surface, Standard):
        return [surface.diffuse, surface.specular, surface.ambient_colour]
    return [v for part in surface for v in (part.weight, *part.parameters) if isinstance(v, tuple)]


def _spread_surface(surface: Standard | list[Part], count: int) -> Surface | Standard:
    if isinstance(surface, Standard):
        return surface._replace(
            diffuse=spread(surface.diffuse, count),
            specular=spread(surface.specular, count),
            ambient=spread(surface.ambient_colour, count),
        )
    rows = (lobes_of(m, p, spread(w, count), count) for w, m, p in surface)
    return Surface(tuple(lobe for row in rows for lobe in row))


def _surface(table: SceneTable, parameters: Mapping[str, object]) -> Standard | list[Part]:
    """A model, lobes, or the standard lighting equation."""
    if "equation" in table.data:
        return _standard(table)
    if "lobes" not in table.data:
        return [_part(table, parameters)]
    found = [_part(t, {}) for t in table.tables("lobes")]
    table.done()
    return found


def _part(table: SceneTable, parameters: Mapping[str, object]) -> Part:
    """A model with its weight and the parameters that stand beside it or in `parameters`."""
    weight = table.colour("weight", 1.0)
    with table.at("model"):
        model = loading.load(table.text_of("model"))
    own = table.table("parameters", {})
    sources = (table, own)
    picks = {c: s.text_of(c) for c in model.choices for s in sources if c in s.data}
    with table.at("model"):
        model = model.variant(**picks) if picks else model
        names = [model.labels.get(n, n) for n in model.Params._fields]
        for source in sources:
            source.know(*names, *model.choices)
        given = {n: _value(s, n) for n in names for s in sources if n in s.data}
        p = model.parameters(**{**given, **parameters})
    own.done()
    table.done()
    return Part(weight, model, p)


def _value(table: SceneTable, name: str) -> float | Colour:
    row = table.colour(name, low=-math.inf)
    return row[0] if len(row) == 1 else row


def _standard(table: SceneTable) -> Standard:
    table.choice("equation", ["standard"])
    table.know("ambient")
    made = Standard(
        ambient=table.colour("ambient") if "ambient" in table.data else None,
        diffuse=table.colour("diffuse"),
        specular=table.colour("specular", 0.0),
        gloss=table.number("gloss", 32.0, 0.0, 1e7),
        form=Form(table.choice("form", list(Form), Form.PHONG)),
        gloss_on_diffuse=table.flag("gloss_on_diffuse"),
    )
    table.done()
    return made


def _single(top: SceneTable, key: str) -> Colour:
    """[ambient] and [emission] have one key, radiance."""
    table = top.table(key, {})
    colour = table.colour("radiance") if key in top.data else (0.0,)
    table.done()
    return colour


def _band(top: SceneTable) -> Band | None:
    top.know("spectrum")
    if "spectrum" not in top.data:
        return None
    table = top.table("spectrum")
    wavelengths = table.numbers("wavelengths")
    with table.at("wavelengths"):
        pairs([[w, 1.0] for w in wavelengths])
    first, last = wavelengths[0], wavelengths[-1]
    given = table.take("illuminant", "E")
    with table.at("illuminant"):
        light = illuminant_table(given, first, last) if isinstance(given, str) else pairs(given)
    for end in (first, last):
        if not light[0][0] <= end <= light[-1][0]:
            raise table.error(f"the illuminant has no value at {end:g} nm", "illuminant")
    table.done()
    return Band(wavelengths, light)


def _directional(table: SceneTable) -> Directional:
    return Directional(table.direction("direction"), table.colour("irradiance"))


def _point(table: SceneTable) -> Point:
    x, y, z = position = table.numbers("position", 3)
    a, b, c = falloff = table.numbers("falloff", 3, (0.0, 0.0, 1.0))
    if not any(position):
        raise table.error("position is the shaded point itself", "position")
    if min(falloff) < 0.0 or not any(falloff):
        raise table.error(
            "falloff is [a, b, c] of 1/(a + b d + c d^2), at least 0, not all 0", "falloff"
        )
    return Point((x, y, z), table.colour("intensity"), (a, b, c))


LIGHTS: dict[str, Callable[[SceneTable], Light]] = {
    "directional": _directional,
    "point": _point,
}


def _light(table: SceneTable) -> Light:
    light = LIGHTS[table.choice("kind", LIGHTS)](table)
    table.done()
    return light


def _view(table: SceneTable) -> View:
    theta = table.numbers("theta_o_deg", None, View().theta_o_deg)
    phi = table.numbers("phi_o_deg", None, View().phi_o_deg)
    if not all(0.0 <= t < 90.0 for t in theta):
        raise table.error(
            f"theta_o_deg must be angles in [0, 90) degrees, not {list(theta)}", "theta_o_deg"
        )
    camera = table.direction("camera", View().camera)
    table.done()
    return View(theta, phi, camera)
