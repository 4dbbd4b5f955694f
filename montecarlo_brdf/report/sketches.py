"""Small pictures that the page draws by itself: how near findings came to their tolerance, and
where the worst of them lie."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from montecarlo_brdf.judge.finding import SEVERITY, Finding, Result, Verdict
from montecarlo_brdf.report import text
from montecarlo_brdf.report.pictures import margins

MOST_ROWS = 40  # of margins
MOST_DOTS = 150  # of a check in a picture
MOST_DIALS = 12
RADIUS = 50.0  # of the horizon in a dial
DECADES = margins.DECADES
WIDTH, LEFT, STEP = 640, 180, 24  # of the picture of margins


class Dot(NamedTuple):
    """A finding in the picture of margins."""

    x: float
    y: float
    verdict: str
    label: str


class Dial(NamedTuple):
    """Where the worst finding of a check lies: the directions as seen from above the surface, the
    normal in the middle, the horizon at the rim."""

    check: str
    words: str
    marks: list[tuple[str, float, float]]  # wo or wi, x, y


class Margins(NamedTuple):
    """How near every finding came to its tolerance, on a log scale."""

    height: int
    limit: float
    rows: list[tuple[float, str]]
    ticks: list[tuple[float, str]]
    dots: list[Dot]


def margins_of(results: Sequence[Result]) -> Margins | None:
    """Findings that have a tolerance, a row for each check or quantity."""
    rows: dict[str, list[Finding]] = {}
    several = len(results) > 1
    for result in results:
        for f in result.findings:
            if f.tolerance and f.expected is not None:
                rows.setdefault(result.check if several else f.quantity, []).append(f)
    if not rows:
        return None
    names = [*rows][:MOST_ROWS]
    dots = [d for k, name in enumerate(names) for d in _dots(rows[name], 18 + STEP * k)]
    unit = (WIDTH - LEFT - 20) / (2 * DECADES)
    ticks = [(LEFT + unit * (d + DECADES), f"10^{d}" if d else "1") for d in range(-4, 5, 2)]
    named = [(18.0 + STEP * k, name) for k, name in enumerate(names)]
    return Margins(STEP * len(names) + 46, LEFT + unit * DECADES, named, ticks, dots)


def dials(results: Sequence[Result]) -> list[Dial]:
    """Of the checks that failed at a pair of directions, or at one."""
    found = []
    for result in results:
        if result.findings and result.verdict in text.BAD:
            finding = text.most_telling(result)
            marks = [m for w in "oi" if (m := _mark(finding, w))]
            if marks:
                found.append(Dial(result.check, text.place(finding), marks))
    return found[:MOST_DIALS]


def _mark(finding: Finding, which: str) -> tuple[str, float, float] | None:
    theta = finding.where.get(f"theta_{which}_deg")
    phi = finding.where.get(f"phi_{which}_deg", 0.0)
    known = (isinstance(v, (int, float)) and math.isfinite(v) for v in (theta, phi))
    if not all(known):
        return None
    radius, angle = RADIUS * float(theta) / 90.0, math.radians(float(phi))  # type: ignore[arg-type]
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    return f"w{which}", round(60.0 + x, 1), round(60.0 - y, 1)


def _dots(findings: Sequence[Finding], y: float) -> list[Dot]:
    ordered = sorted(findings, key=lambda f: SEVERITY.index(Verdict(f.verdict)))
    return [
        Dot(round(_across(f), 1), y, f.verdict, text.statement(f)) for f in ordered[:MOST_DOTS]
    ][::-1]


def _across(f: Finding) -> float:
    """The place of a finding: its deviation in tolerances, by the logarithm; what is not finite
    stands at the end."""
    return LEFT + (WIDTH - LEFT - 20) * (margins.power(f) / DECADES + 1) / 2
