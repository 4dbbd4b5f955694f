"""Pictures of the page that --export report.html writes, at two widths: docs/figures/page_*.png.

Needs Chromium. python scripts/screenshots.py
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parent.parent
FIGURES = ROOT / "docs" / "figures"
MODEL = "from typing import NamedTuple\nclass Params(NamedTuple):\n    albedo: float = 0.8\n"
MODEL += "domain = {'albedo': (0.0, 1.0)}\nscales_with = 'albedo'\n\n"
MODEL += "def f(wo, wi, p):\n    return p.albedo\n"
#: name -> the command, the height of the page at each width
PAGES = {
    "model": ("run --model first.py", {1400: 1500, 400: 1800}),
    "scene": (f"radiance {ROOT / 'examples' / 'lambert_without_pi.toml'}", {1400: 1300, 400: 1500}),
}
COLOURS = 240  # enough for text, lines and every mark


def main() -> int:
    """Write the pictures."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if not browser:
        print("no Chromium: nothing is drawn", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "first.py").write_text(MODEL, encoding="utf-8")
        for name, (command, sizes) in PAGES.items():
            page = Path(folder, f"{name}.html")
            words = [*command.split(), "--export", str(page)]
            subprocess.run(
                [sys.executable, "-m", "montecarlo_brdf", *words],
                cwd=folder, check=False, stdout=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
            )  # fmt: skip
            for width, height in sizes.items():
                shoot(browser, page, width, height, FIGURES / f"page_{name}_{width}.png")
    return 0


def shoot(browser: str, page: Path, width: int, height: int, picture: Path) -> None:
    """A page as the browser shows it, in few colours."""
    flags = ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars")
    size = f"--window-size={width},{height}"
    subprocess.run(
        [browser, *flags, size, f"--screenshot={picture}", f"file://{page}"],
        check=True, capture_output=True, timeout=60,
    )  # fmt: skip
    image = Image.open(picture).convert("RGB").quantize(COLOURS)
    image.save(picture, optimize=True)


if __name__ == "__main__":
    sys.exit(main())
