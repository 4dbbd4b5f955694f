"""How large the pages of --export report.html are, and what it costs a browser to show them.

python scripts/page_sizes.py writes scripts/results/pages.json: bytes, and with Chromium the
processor seconds of a screenshot of the page beyond those of an empty one, the median of pairs.
"""

from __future__ import annotations

import json
import os
import resource
import shlex
import shutil
import statistics
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
PAIRS = 5
EMPTY = "<!DOCTYPE html><title>nothing</title>"


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


def shown(page: Path, browser: str) -> float:
    """Processor seconds of showing a page, beyond those of showing nothing."""
    empty = page.with_name("empty.html")
    empty.write_text(EMPTY, encoding="utf-8")
    return statistics.median(_spent(page, browser) - _spent(empty, browser) for _ in range(PAIRS))


def _spent(page: Path, browser: str) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    flags = ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1400,1000")
    subprocess.run(
        [browser, *flags, f"--screenshot={page}.png", f"file://{page}"],
        check=True, capture_output=True, timeout=120,
    )  # fmt: skip
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


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
            seconds = round(shown(page, browser), 2) if browser else None
            rows.append({"command": command, "bytes": size, "most": most, "seconds": seconds})
            print(f"{command:45} {size:9} of {most}, shown in {seconds} s", flush=True)
            code |= size > most
    RESULTS.write_text(json.dumps({**describe(), "pages": rows}, indent=1) + "\n")
    return code


if __name__ == "__main__":
    sys.exit(main())
