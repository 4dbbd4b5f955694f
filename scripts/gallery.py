"""What checks say of the shaders of a folder: a table of findings, and no text of theirs.

Run: python scripts/gallery.py FOLDER [FILE], with the package's extra `shaders` installed. The
folder is one of the BRDF Explorer's files, or of shaders that describe themselves; FILE (default
docs/gallery.md) gets the table.
"""
from __future__ import annotations

import sys
from pathlib import Path

import montecarlo_brdf as mb
from montecarlo_brdf.foreign import translation
from montecarlo_brdf.judge.finding import Finding, Report, Verdict
from montecarlo_brdf.model import channels

ROOT = Path(__file__).parents[1]
CHECKS = ["positivity", "furnace", "energy", "reciprocity", "precision"]
ANGLES = (0.0, 60.0)
EFFORT = 0.1
MOST = 6  # angles and parameters that a place is told by
HEAD = """\
# Shaders of others

What `brdf-check run --check {checks} --theta-o 0,60 --effort {effort:g}` says of the shaders in one
folder, at their defaults and over the ranges that they declare. Written by
`python scripts/gallery.py FOLDER`; the files themselves are their authors'. Of colours the green
channel is asked. A *known* finding is of a property that a file does not promise: a factor of a
BRDF reflects what it likes.

| file | verdict | A at 0° | A at 60° | worst | where |
|---|---|---|---|---|---|
"""


def row(path: Path) -> str:
    """One line of the table."""
    try:
        model = mb.load(str(path))
        p = channels(model.parameters())
        report = mb.run(model, p[len(p) // 2], names=CHECKS, theta_o_deg=ANGLES, effort=EFFORT,
                        fixed=fixed(model))  # fmt: skip
    except mb.UserError as error:
        return f"| {path.name} | error | | | {str(error).removeprefix(str(path.parent))} | |"
    albedos = [shown(report, angle) for angle in ANGLES]
    worst = worst_of(report)
    cells = [path.name, str(report.verdict), *albedos, *(told(worst) if worst else ("", ""))]
    return f"| {' | '.join(cells)} |"


def fixed(model: mb.Model) -> tuple[str, ...]:
    """The channel stays; everything else is searched."""
    return ("channel",) if "channel" in model.Params._fields else ("",)


def shown(report: Report, angle: float) -> str:
    """A at an angle."""
    found = findings(report, "A")
    values = [f.value for f in found if f.where.get("theta_o_deg") == angle]
    return f"{values[0]:.4g}" if values and values[0] is not None else ""


def findings(report: Report, quantity: str = "") -> list[Finding]:
    return [f for r in report.results for f in r.findings if not quantity or f.quantity == quantity]


def worst_of(report: Report) -> Finding | None:
    """The finding that is refuted by most, of those that are."""
    refuted = [f for f in findings(report) if f.verdict in (Verdict.FAIL, Verdict.KNOWN)]
    return max(refuted, key=excess, default=None)


def excess(found: Finding) -> float:
    value, due = found.value or 0.0, found.expected or 0.0
    return abs(value - due) if value == value else float("inf")


def told(found: Finding) -> tuple[str, str]:
    """Quantity and value, and its place."""
    places = [f"{k.removesuffix('_deg')} {v:.3g}" for k, v in found.where.items()]
    where = ", ".join(places[:MOST]) + (", ..." if len(places) > MOST else "")
    return f"{found.quantity}: {found.value:.4g}", where


def main() -> int:
    folder = Path(sys.argv[1])
    file = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "docs" / "gallery.md"
    paths = [p for p in sorted(folder.iterdir()) if translation.is_shader(p.name)]
    rows = []
    for path in paths:
        rows.append(row(path))
        print(rows[-1], flush=True)
    head = HEAD.format(checks=",".join(CHECKS), effort=EFFORT)
    file.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
