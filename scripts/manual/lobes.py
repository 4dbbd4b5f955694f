"""A small picture of a model: its lobes in the plane of incidence, and its albedo against angle.

SVG by hand in the colours of the page, light or dark, so that all models together cost a second.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from montecarlo_brdf import references
from montecarlo_brdf.compile.bind import plain
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.pictures.style import BLUE, GREEN, VERMILION

Place = tuple[float, float]
#: polar angles of the viewer with a colour and a dash, told apart without colours too
VIEWERS = ((0.0, BLUE, ""), (30.0, GREEN, "6 3"), (60.0, VERMILION, "2 2"))
STEPS = 240  # directions of light in a lobe
ANGLES = (0, 10, 20, 30, 40, 50, 60, 70, 75, 80, 85)  # of the viewer, where A is known
CENTRE, RADIUS = (150.0, 150.0), 130.0  # of the half disk with the lobes
LEFT, TOP, SIDE, DEEP = 360.0, 20.0, 250.0, 125.0  # of the frame with the albedo
WORDS = 180.0  # below both


def picture(model: Model) -> str:
    """The picture as an element without blank lines, which would end it in Markdown."""
    label = f"{model.name}: lobes in the plane of incidence, and albedo against angle"
    head = f'<svg viewBox="0 0 640 190" role="img" aria-label="{label}" fill="none"'
    parts = "".join([*_lobes(model), *_albedo(model)])
    return f'{head} stroke="currentColor" font-size="11">{parts}</svg>'


def _lobes(model: Model) -> Iterator[str]:
    """f cos theta_i for light from one horizon to the other, each lobe to its own maximum; a tick
    at the rim for each viewer."""
    x0, y0 = CENTRE
    yield _line([(x0 - RADIUS, y0), (x0 + RADIUS, y0)], opacity=0.4)
    yield _line([_at(180.0 * k / 60 - 90.0, 1.0) for k in range(61)], opacity=0.4)
    for k, (theta, colour, dash) in enumerate(VIEWERS):
        style = {"stroke": colour, "stroke_width": 1.8}
        yield _line([CENTRE, *_lobe(model, theta), CENTRE], stroke_dasharray=dash, **style)
        yield _line([_at(-theta, 0.94), _at(-theta, 1.03)], **style)
        yield _text((20.0 + 95.0 * k, WORDS), f"viewer at {theta:g}°", fill=colour)


def _at(degrees: float, radius: float) -> Place:
    """A place of the half disk."""
    angle = math.radians(degrees)
    x0, y0 = CENTRE
    return x0 + RADIUS * radius * math.sin(angle), y0 - RADIUS * radius * math.cos(angle)


def _lobe(model: Model, theta: float) -> list[Place]:
    f, p = plain(model.f), model.prepared(model.parameters())
    angle = math.radians(theta)
    wo = (-math.sin(angle), 0.0, math.cos(angle))
    lights = [math.pi * (k + 0.5) / STEPS - math.pi / 2 for k in range(STEPS)]
    values = [f(wo, (math.sin(a), 0.0, math.cos(a)), p) * math.cos(a) for a in lights]
    most = max(values) or 1.0
    return [_at(math.degrees(a), max(v / most, 0.0)) for a, v in zip(lights, values, strict=True)]


def _albedo(model: Model) -> Iterator[str]:
    """A by its reference, where there is one."""
    known = _known(model)
    most = 1.08 * max([1.0, *(value for _, value in known)])

    def at(theta: float, value: float) -> Place:
        return LEFT + SIDE * theta / 90.0, TOP + DEEP * (1.0 - value / most)

    yield _line([at(0, most), at(0, 0), at(90, 0)], opacity=0.6)
    yield _line([at(0, 1), at(90, 1)], opacity=0.6, stroke_dasharray="3 3")
    for value in (0, 1):
        x, y = at(0, value)
        yield _text((x - 6.0, y + 4.0), f"{value}", text_anchor="end")
    for theta in (0, 45, 90):
        x, y = at(theta, 0)
        yield _text((x, y + 16.0), f"{theta}°", text_anchor="middle")
    words = "A against the viewer's angle" if known else "A: no reference is known"
    yield _text((LEFT + SIDE / 2.0, WORDS), words, text_anchor="middle")
    yield _line([at(theta, value) for theta, value in known], stroke_width=1.8)


def _known(model: Model) -> list[Place]:
    values = {**model.parameters()._asdict(), **model.picks}
    found = []
    for theta in ANGLES:
        truth = references.albedo(model.name, math.cos(math.radians(theta)), **values)
        found += [] if truth is None else [(float(theta), float(truth.value))]
    return found


def _line(places: list[Place], **style: object) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    return f'<polyline points="{points}"{_styled(style)}/>'


def _text(place: Place, words: str, **style: object) -> str:
    x, y = place
    shown = _styled({"fill": "currentColor", "stroke": "none", **style})
    return f'<text x="{x:.1f}" y="{y:.1f}"{shown}>{words}</text>'


def _styled(style: dict[str, object]) -> str:
    return "".join(f' {name.replace("_", "-")}="{value}"' for name, value in style.items())
