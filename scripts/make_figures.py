"""Draw every picture of README and docs from library calls: equal inputs give equal files.

    python scripts/make_figures.py [FOLDER]

The picture of run time is drawn from the recorded benchmark, scripts/results/bench.json.
"""
from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

from bench.picture import bench_figure

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.report.pictures import drawn, encoded, kind_of
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


FIGURES: dict[str, Callable[[Path], None]] = {
    "albedo": albedo,
    "failing": failing,
    "convergence_ggx": convergence("ggx", 60.0, alpha=0.3),
    "convergence_oren_nayar": convergence("oren_nayar", 60.0, sigma=0.5),
    "time_against_error": time_against_error,
}


def main() -> None:
    """Draw all."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        draw(folder / f"{name}.png")
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
