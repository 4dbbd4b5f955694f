"""A scene from a TOML file, every value checked; docs/scenes.md lists all keys."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.lights import Directional, Light, Point
from montecarlo_brdf.scene.make import assigned
from montecarlo_brdf.scene.read_surface import read_surface
from montecarlo_brdf.scene.scene import Band, Scene, View
from montecarlo_brdf.scene.sky_tables import read_sky
from montecarlo_brdf.scene.spectrum import illuminant_table, pairs
from montecarlo_brdf.scene.standard import Standard
from montecarlo_brdf.scene.surface import Surface, lobes_of, spread
from montecarlo_brdf.scene.toml import Table, parse

Colour = float | tuple[float, ...]


def read_scene(path: str | Path, **parameters: Any) -> Scene:
    """The scene in a file.

    path: of a TOML file (docs/scenes.md). parameters: values that replace those of its surface
    model, by name; a tuple makes a colour. Raises UserError with the line and what is allowed for
    anything wrong in it.
    """
    file = Path(path)
    data, text = parse(file)
    top = Table(file, text, data)
    band = _band(top)
    top.wavelengths = band.wavelengths if band else None
    raw = _raw(top, parameters)
    top.done()
    words = (str(path), *assigned(parameters))
    return replace(_assembled(top, raw, band), words=words)


def _raw(top: Table, parameters: dict[str, Any]) -> dict[str, Any]:
    """Everything in the file, colours still as written."""
    return {
        "name": top.text_of("name", top.file.stem),
        "surface": read_surface(top.table("surface"), parameters),
        "sky": read_sky(top.table("environment")) if "environment" in top.data else None,
        "lights": [_light(t) for t in top.tables("lights")],
        "ambient": _single(top, "ambient"),
        "emission": _single(top, "emission"),
        "view": _view(top.table("view", {})),
    }


def _single(top: Table, key: str) -> Colour:
    """[ambient] and [emission] have one key, radiance."""
    table = top.table(key, {})
    colour = table.colour("radiance") if key in top.data else 0.0
    table.done()
    return colour


def _band(top: Table) -> Band | None:
    if "spectrum" not in top.data:
        top.take("spectrum", None)
        return None
    table = top.table("spectrum")
    wavelengths = table.numbers("wavelengths")
    try:
        pairs([[w, 1.0] for w in wavelengths])
        given = table.take("illuminant", "E")
        name = given if isinstance(given, str) else None
        light = illuminant_table(name, wavelengths[0], wavelengths[-1]) if name else pairs(given)
    except (UserError, TypeError) as error:
        raise table.error(
            str(error), "wavelengths" if "wavelength" in str(error) else "illuminant"
        ) from None
    for end in (wavelengths[0], wavelengths[-1]):
        if not light[0][0] <= end <= light[-1][0]:
            raise table.error(f"the illuminant has no value at {end:g} nm", "illuminant")
    table.done()
    return Band(wavelengths, light)


def _light(table: Table) -> tuple[Any, Colour]:
    kind = table.choice("kind", ["directional", "point"])
    if kind == "directional":
        made: tuple[Any, Colour] = (
            Directional(table.direction("direction"), ()),
            table.colour("irradiance"),
        )
    else:
        position = table.numbers("position", 3)
        falloff = table.numbers("falloff", 3, (0.0, 0.0, 1.0))
        if not any(position):
            raise table.error("position is the shaded point itself", "position")
        if min(falloff) < 0.0 or not any(falloff):
            raise table.error(
                "falloff is [a, b, c] of 1/(a + b d + c d^2), at least 0, not all 0", "falloff"
            )
        made = Point(position, (), falloff), table.colour("intensity")  # type: ignore[arg-type]
    table.done()
    return made


def _view(table: Table) -> View:
    theta = table.numbers("theta_o_deg", None, View().theta_o_deg)
    phi = table.numbers("phi_o_deg", None, View().phi_o_deg)
    if not all(0.0 <= t < 90.0 for t in theta):
        raise table.error(
            f"theta_o_deg must be angles in [0, 90) degrees, not {list(theta)}", "theta_o_deg"
        )
    camera = table.direction("camera", View().camera)
    table.done()
    return View(theta, phi, camera)


def _assembled(top: Table, raw: dict[str, Any], band: Band | None) -> Scene:
    """The scene with every colour spread over the same number of channels."""
    count = _channels(top, raw, band)

    def row(value: Any) -> tuple[float, ...]:
        return spread(value if isinstance(value, tuple) else (value,), count)

    lights: list[Light] = [_coloured(light, row(colour)) for light, colour in raw["lights"]]
    if isinstance(raw["surface"], Standard):
        s = raw["surface"]
        if raw["sky"]:
            raise top.error(
                "the standard lighting equation has lights and no [environment]", "environment"
            )
        surface: Any = s._replace(
            diffuse=row(s.diffuse),
            specular=row(s.specular),
            ambient=None if s.ambient is None else row(s.ambient),
        )
    else:
        parts = [lobe for w, m, p in raw["surface"] for lobe in lobes_of(m, p, row(w), count)]
        surface = Surface(tuple(parts))
    return Scene(
        name=raw["name"],
        channels=count,
        surface=surface,
        sky=raw["sky"].spread(count) if raw["sky"] else None,
        lights=tuple(lights),
        ambient=row(raw["ambient"]),
        emission=row(raw["emission"]),
        view=raw["view"],
        band=band,
    )


def _coloured(light: Any, colour: tuple[float, ...]) -> Light:
    name = "irradiance" if isinstance(light, Directional) else "intensity"
    return light._replace(**{name: colour})  # type: ignore[no-any-return]


def _channels(top: Table, raw: dict[str, Any], band: Band | None) -> int:
    """The one number of channels that all colours of the scene have."""
    colours = [raw["ambient"], raw["emission"], *(c for _, c in raw["lights"])]
    if isinstance(raw["surface"], Standard):
        colours += [v for v in raw["surface"] if isinstance(v, tuple)]
    else:
        colours += [v for w, _, p in raw["surface"] for v in (w, *p)]
    widths = {len(c) for c in colours if isinstance(c, tuple)}
    widths |= {raw["sky"].channels} if raw["sky"] else set()
    widths |= {len(band.wavelengths)} if band else set()
    widths -= {1}
    if len(widths) > 1:
        raise top.error(
            f"all colours of a scene need the same number of channels, not {sorted(widths)}"
        )
    return widths.pop() if widths else 1
