"""Draws of a sampler beside its pdf, in coordinates that follow the lobe: how densely both lie in
each cell, and by how many standard deviations the counts differ."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.judge.finding import Finding, Result
from montecarlo_brdf.report import text

WIDE, HIGH = 200.0, 120.0  # of a panel
SHADES = 8  # of a colour
LEAST = 4.0  # standard deviations at which the colours of what is in order end


class Panel(NamedTuple):
    """Cells by their shade, as paths of SVG."""

    title: str
    caption: str
    shades: list[tuple[str, float, str]]  # the colour's name, its opacity, the path


class Draws(NamedTuple):
    """The panels of the finding that tells most."""

    check: str
    place: str
    panels: list[Panel]


class Cell(NamedTuple):
    """A cell in [0, 1]^2 with the draws found in it, which are counted together with those of its
    neighbours, what pdf expects there, and by how many standard deviations the counts differ."""

    x: tuple[float, float]
    y: tuple[float, float]
    found: float
    expected: float
    residual: float

    @property
    def area(self) -> float:
        """Its share of the picture."""
        return max((self.x[1] - self.x[0]) * (self.y[1] - self.y[0]), 1e-9)


def draws(results: Sequence[Result]) -> Draws | None:
    """Of the worst finding that counted draws, if its cells can be read."""
    for result in results:
        counted = [f for f in result.findings if f.draws]
        if counted:
            finding = text.most_telling(Result(result.model, result.params, result.check, counted))
            try:
                panels = _panels(cells(finding))
            except (KeyError, TypeError, ValueError, IndexError):  # a report that was edited
                return None
            return Draws(result.check, text.place(finding), panels)
    return None


def cells(finding: Finding) -> list[Cell]:
    """The cells of a finding."""
    data: Mapping[str, Any] = finding.draws or {}
    counts, rows = [float(n) for n in data["counts"]], data["cells"]
    total, due = sum(counts), [0.0] * (len(counts) - 1)
    for *_, probability, group in rows:
        due[group] += total * probability
    if not (rows and all(map(math.isfinite, (*counts, *due))) and min(due) > 0.0):
        raise ValueError("counts")
    return [
        Cell((b0, b1), (x0, x1), counts[k] * total * p / due[k], total * p,
             (counts[k] - due[k]) / math.sqrt(due[k]))
        for x0, x1, b0, b1, p, k in rows
    ]  # fmt: skip


def _panels(found: Sequence[Cell]) -> list[Panel]:
    most = max(max(c.found, c.expected) / c.area for c in found) or 1.0
    end = max(LEAST, *(abs(c.residual) for c in found))
    total = sum(c.found for c in found)
    return [
        Panel(f"{total:,.0f} draws", "how densely they lie in each cell",
              _shaded(found, lambda c: c.found / c.area / most, "dense")),
        Panel("pdf", "how densely they should, in the same shades",
              _shaded(found, lambda c: c.expected / c.area / most, "dense")),
        Panel("difference", f"red: too many, blue: too few, to {end:.0f} standard deviations",
              _shaded(found, lambda c: c.residual / end, "more", "less")),
    ]  # fmt: skip


def _shaded(
    found: Sequence[Cell], value: Callable[[Cell], float], above: str, below: str = ""
) -> list[tuple[str, float, str]]:
    """A path for all cells of one shade: a value in [-1, 1], the root of it as the eye sees it."""
    paths: dict[int, str] = defaultdict(str)
    for cell in found:
        shade = value(cell)
        root = math.copysign(math.sqrt(min(abs(shade), 1.0)), shade)
        paths[round(SHADES * root)] += _path(cell)
    named = {k: above if k > 0 else below for k in paths}
    return [(named[k], abs(k) / SHADES, path) for k, path in sorted(paths.items()) if k]


def _path(cell: Cell) -> str:
    """The cell with the lobe's centre at the bottom."""
    (x0, x1), (y0, y1) = cell.x, cell.y
    left, top = WIDE * x0, HIGH * (1.0 - y1)
    wide, high = WIDE * (x1 - x0), HIGH * (y1 - y0)
    return f"M{left:.1f} {top:.1f}h{wide:.1f}v{high:.1f}h-{wide:.1f}z"
