"""Draw every picture of README and docs from library calls: equal inputs give equal files.

    python scripts/make_figures.py [FOLDER [NAME ...]]

The picture of run time is drawn from the recorded benchmark, scripts/results/bench.json.
"""
from __future__ import annotations

import json
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

from bench.picture import bench_figure
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.report.pictures import drawn, encoded, kind_of, style
from montecarlo_brdf.verify.converge import converge

ROOT = Path(__file__).parent.parent
ANGLES = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0, 89.0]


def plot(report: Report, path: Path) -> None:
    """The picture of a report as a file."""
    path.write_bytes(drawn(report, kind_of(path)))


def albedo(path: Path) -> None:
    """Directional albedo of GGX against angle for several widths."""
    model = mb.load("ggx")
    sets = [model.parameters(alpha=a) for a in (0.05, 0.3, 0.6, 1.0)]
    plot(mb.furnace(model, sets, ANGLES, target_error=1e-6, curve=True), path)


def failing(path: Path) -> None:
    """A model that reflects more than it receives."""
    model = mb.load("lambert_unnormalised")
    plot(mb.furnace(model, model.parameters(c=0.5), ANGLES, curve=True), path)


def convergence(name: str, theta: float, **values: float) -> Callable[[Path], None]:
    """Error against samples of a model."""

    def draw(path: Path) -> None:
        model = mb.load(name)
        plot(converge(model, model.parameters(**values), theta), path)

    return draw


def time_against_error(path: Path) -> None:
    """Error against seconds, ours and peers."""
    recorded = ROOT / "scripts" / "results" / "bench.json"
    if recorded.is_file():
        data = json.loads(recorded.read_text(encoding="utf-8"))
        path.write_bytes(encoded(bench_figure(data), kind_of(path)))


#: from the top: name, what it says below, what it knows
LAYERS = (
    ("cli", "one file per command", "options, exit codes"),
    ("sweep", "one question of many models, by many processes", "tasks"),
    ("verify", "a question becomes a Report", "settings, parameter sets"),
    ("scene, stability, table", "questions of their own", "skies, precisions, cells"),
    ("diagnosis", "what of a refuted model is wrong, tested by repair", "causes"),
    ("checks", "yield claims, decide nothing", "physics"),
    ("judge", "claims become findings", "levels, looks, confirmation"),
    ("cases", "models, directions, parameters to look at", "search"),
    ("estimate", "quantity x direction: a number with its error bar", "statistics"),
    ("arithmetic", "plain functions on arrays: any precision, and what turns", "rounding"),
    ("model, models", "f, sample, pdf and what is declared", "formulas"),
    ("foreign, measured", "shaders, C and measured files become models", "GLSL, C, MERL"),
    ("sampling", "points of the cube, ways to a direction", "hashes, maps"),
    ("compile", "templates with holes become machine code", "numba, llvmlite"),
)
ASIDE = (
    ("report", "pure functions of a Report: text, files, pictures", 0.5),
    ("references", "the truth, and no code of the package", 3.0),
)


def house(path: Path) -> None:
    """The layers of the package, what goes down and what comes back."""
    import matplotlib.pyplot as plt

    bottom = float(len(LAYERS))
    figure = plt.figure(figsize=(9.0, 0.7 * bottom))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 9.0), ylim=(bottom + 0.4, -0.4))
    axes.axis("off")
    for k, (name, job, knows) in enumerate(LAYERS):
        _box(axes, (0.9, k, 5.2), name, job, style.SKY)
        axes.text(6.0, k + 0.28, knows, ha="right", va="center", fontsize=8, color=style.GREY)
    for name, job, y in ASIDE:
        _box(axes, (7.05, y, 1.8), name, job, style.ORANGE)
    down, up = (0.1, bottom - 0.1), (bottom - 0.1, 0.1)
    for x, word, ends in ((0.45, "ask", down), (6.55, "plain data", up)):
        arrow = {"arrowstyle": "-|>", "color": style.BLACK, "linewidth": 1.5}
        axes.annotate("", xy=(x, ends[1]), xytext=(x, ends[0]), arrowprops=arrow)
        box = {"facecolor": "white", "edgecolor": "none", "pad": 3.0}
        middle = {"ha": "center", "va": "center", "rotation": 90}
        axes.text(x, 0.5 * bottom, word, fontsize=11, bbox=box, **middle)
    path.write_bytes(encoded(figure, kind_of(path)))
    plt.close(figure)


def _box(axes: Axes, place: tuple[float, float, float], name: str, job: str, colour: str) -> None:
    x, y, width = place
    narrow = width < 3.0
    height = 1.4 if narrow else 0.84
    axes.add_patch(Rectangle((x, y + 0.08), width, height, color=colour, alpha=0.35, linewidth=0))
    axes.text(x + 0.12, y + 0.32, name, va="center", fontsize=11, weight="bold")
    said = textwrap.fill(job, 24) if narrow else job
    axes.text(x + 0.12, y + 0.56, said, va="top" if narrow else "center", fontsize=8.5)


FIGURES: dict[str, Callable[[Path], None]] = {
    "albedo": albedo,
    "failing": failing,
    "convergence_ggx": convergence("ggx", 60.0, alpha=0.3),
    "convergence_oren_nayar": convergence("oren_nayar", 60.0, sigma=0.5),
    "house": house,
    "time_against_error": time_against_error,
}


def main() -> None:
    """Draw all."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or FIGURES:
        FIGURES[name](folder / f"{name}.png")
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
