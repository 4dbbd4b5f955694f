"""Every picture that a command draws, with that command: docs/pictures.md and docs/figures/shown_*.

python scripts/pictures.py [NAME ...] runs each command as the page prints it, in an empty folder
with the examples; with names only these pictures are drawn anew.
"""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from PIL import Image

ROOT = Path(__file__).parent.parent
PAGE, FIGURES = ROOT / "docs" / "pictures.md", ROOT / "docs" / "figures"
COLOURS = 128  # of a picture: lines, text and soft shades
WIDEST = 1400  # pixels
HEAD = """\
# Pictures, each with its command

Each runs as printed, after `brdf-check examples --copy examples` where a scene is named; the suffix
.svg or .pdf instead of .png makes another kind. Made by `python scripts/pictures.py`. What several
commands write as a page, `--export report.html`, is at the end.
"""


class Picture(NamedTuple):
    """What a picture shows, and the command line, which writes NAME.png."""

    title: str
    words: str
    command: str


SHOWN = {
    "albedo": Picture(
        "Albedo against angle",
        "Points with bars of three standard errors, the reference as a line; below it the error, "
        "its standard error and the tolerance.",
        "furnace --model ggx -p alpha=0.05,0.3,0.6,1 --theta-o 0:85:12 --plot albedo.png",
    ),
    "failing": Picture(
        "A model that gives more than it gets",
        "The dotted line is all the light that arrives.",
        "furnace --model lambert_unnormalised -p c=0.5 --plot failing.png",
    ),
    "all": Picture(
        "All models",
        "With more curves than can be told apart each model has a panel.",
        "furnace --model all --theta-o 0:85:9 --plot all.png",
    ),
    "convergence": Picture(
        "Error against samples",
        "Each sampler and point set; the slope is what is judged.",
        "converge --model ggx -p alpha=0.3 --plot convergence.png",
    ),
    "time": Picture(
        "Error against processor time",
        "Which method is best for a model; the grey line is the error of what it is held against.",
        "bench --model ggx -p alpha=0.05 --theta-o 80 --plot time.png",
    ),
    "margins": Picture(
        "How near every finding came to its tolerance",
        "A row for each check; what lies right of the line is refuted, open or known.",
        "run --model phong_original --plot margins.png",
    ),
    "beside": Picture(
        "Two models side by side",
        "The same picture of a comparison.",
        "compare ggx beckmann --plot beside.png",
    ),
    "digits": Picture(
        "Digits",
        "The error of f in each precision over angle and roughness.",
        "stress --model textbook_ggx --quick --plot digits.png",
    ),
    "radiance": Picture(
        "Radiance of a scene",
        "Every view and channel with its truth.",
        "radiance examples/cook_torrance.toml --plot radiance.png",
    ),
    "sphere": Picture(
        "A sphere in a scene",
        "Each pixel an estimate; the command prints the largest standard error.",
        "render examples/cook_torrance.toml --size 384 -o sphere.png",
    ),
    "furnace": Picture(
        "A furnace",
        "A lossless sphere disappears in constant light; below it the signed difference, with its "
        "scale.",
        "render --model ggx --furnace -p alpha=0.1:1:5 --size 200 -o furnace.png",
    ),
}
PAGES = """\
## Pages

`brdf-check run --model first.py --export report.html`, of the first model of the
[tutorial](tutorial.md):

![The page of a failing model](figures/page_model_1400.png)

The same on a narrow screen:

![The page of a failing model, 400 pixels wide](figures/page_model_400.png)

`brdf-check radiance examples/lambert_without_pi.toml --export report.html`:

![The page of a scene](figures/page_scene_1400.png)

Taken by `python scripts/screenshots.py`.

"""
RESULTS = ROOT / "scripts" / "results" / "pages.json"


def draw(name: str, folder: Path) -> None:
    """Run a command and keep its picture, in few colours."""
    done = subprocess.run(
        [sys.executable, "-m", "montecarlo_brdf", *shlex.split(SHOWN[name].command)],
        cwd=folder, check=False, capture_output=True, encoding="utf-8",
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    if done.returncode not in (0, 1, 3):
        raise SystemExit(f"{name} ended with {done.returncode}: {done.stderr}")
    image = Image.open(folder / f"{name}.png").convert("RGB")
    image.thumbnail((WIDEST, 10 * WIDEST))
    image.quantize(COLOURS).save(FIGURES / f"shown_{name}.png", optimize=True)


def page() -> str:
    """The page as Markdown."""
    parts = [HEAD]
    for name, one in SHOWN.items():
        parts.append(f"## {one.title}\n\n{one.words}\n\n```sh\nbrdf-check {one.command}\n```\n\n"
                     f"![{one.title}](figures/shown_{name}.png)\n")  # fmt: skip
    return "\n".join([*parts, PAGES + sizes()])


def sizes() -> str:
    """How large pages are, as measured."""
    rows = ["| page of | MB | seconds of the processor to show it |", "|---|---|---|"]
    for one in json.loads(RESULTS.read_text(encoding="utf-8"))["pages"]:
        rows.append(f"| `{one['command']}` | {one['bytes'] / 1e6:.2f} | {one['seconds']:g} |")
    return "\n".join([*rows, "", "Measured by `python scripts/page_sizes.py`.", ""])


def main() -> None:
    """Draw the pictures and write the page."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "examples").symlink_to(ROOT / "examples")
        for name in sys.argv[1:] or SHOWN:
            draw(name, Path(folder))
            print(name, flush=True)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
