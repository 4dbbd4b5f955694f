"""How large the pages of --export report.html are, and how long a browser takes to open them.

python scripts/page_sizes.py writes scripts/results/pages.json; with Chromium also the time from
the request to the end of loading, the least of some.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from environment import describe

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "scripts" / "results" / "pages.json"
#: command -> the bytes that its page may have
PAGES = {
    "run --model first.py": 1_500_000,
    "run --model ggx": 1_500_000,
    "radiance examples/lambert_without_pi.toml": 1_500_000,
    "stress --model ggx --quick": 1_500_000,
    "run --model all": 6_000_000,
}
FIRST = "from typing import NamedTuple\nclass Params(NamedTuple):\n    albedo: float = 0.8\n"
FIRST += "domain = {'albedo': (0.0, 1.0)}\n\ndef f(wo, wi, p):\n    return p.albedo\n"
TIMES = 5
CLOCK = """<script>addEventListener("load", () => setTimeout(() => {
const t = performance.getEntriesByType("navigation")[0];
document.title = "took " + t.loadEventEnd; }, 0));</script></body>"""


def written(command: str, folder: Path) -> Path:
    """The page of a command."""
    page = folder / "page.html"
    page.unlink(missing_ok=True)
    words = [*shlex.split(command), "--export", str(page)]
    subprocess.run(
        [sys.executable, "-m", "montecarlo_brdf", *words], cwd=folder, check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.DEVNULL,
    )  # fmt: skip
    return page


def opened(page: Path, browser: str) -> float:
    """Seconds until a browser has loaded a page, by its own clock."""
    timed = page.with_name("timed.html")
    text = page.read_text(encoding="utf-8")
    timed.write_text(text.replace("</body>", CLOCK), encoding="utf-8")
    flags = ("--headless=new", "--no-sandbox", "--disable-gpu", "--dump-dom")
    done = subprocess.run(
        [browser, *flags, f"file://{timed}"], capture_output=True, text=True, timeout=120
    )
    found = re.search(r"<title>took ([\d.]+)</title>", done.stdout)
    return float(found[1]) / 1000.0 if found else float("nan")


def main() -> int:
    """Measure all; 1 if a page is too large."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    rows, code = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "first.py").write_text(FIRST, encoding="utf-8")
        (folder / "examples").symlink_to(ROOT / "examples")
        for command, most in PAGES.items():
            page = written(command, folder)
            size = page.stat().st_size
            seconds = min(opened(page, browser) for _ in range(TIMES)) if browser else None
            rows.append({"command": command, "bytes": size, "most": most, "seconds": seconds})
            print(f"{command:45} {size:9} of {most}, opened in {seconds} s", flush=True)
            code |= size > most
    RESULTS.write_text(json.dumps({**describe(), "pages": rows}, indent=1) + "\n")
    return code


if __name__ == "__main__":
    sys.exit(main())
