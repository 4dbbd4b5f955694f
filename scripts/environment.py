"""Where a recorded result was obtained."""
from __future__ import annotations

import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

PACKAGES = ("numba", "llvmlite", "numpy", "scipy", "click")


def processor() -> str:
    """The name of the processor."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
        return text.split("model name")[1].split(":")[1].split("\n")[0].strip()
    except (OSError, IndexError):
        return platform.processor()


def installed(package: str) -> str:
    """Version of a package."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "absent"


def describe() -> dict[str, Any]:
    """Machine, command and versions."""
    script = Path(sys.argv[0]).name
    return {
        "command": " ".join(["python", f"scripts/{script}", *sys.argv[1:]]),
        "machine": f"{platform.system()} {platform.machine()}, {processor()}",
        "versions": {"python": platform.python_version(), **{p: installed(p) for p in PACKAGES}},
    }
