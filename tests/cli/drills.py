"""What the drills share: the command in a process of its own, a cache that holds its kernels."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

COMMAND = [sys.executable, "-m", "montecarlo_brdf"]
QUICK = [
    "furnace",
    "--model",
    "lambert",
    "--theta-o",
    "0,60",
    "--samples",
    "2^10",
    "--format",
    "json",
]


def start(*arguments: Any, cache: Path | None, **options: Any) -> subprocess.Popen[str]:
    environment = {**os.environ, **options.pop("env", {})}
    environment.pop("BRDF_CHECK_CACHE_DIR", None)
    if cache:
        environment["BRDF_CHECK_CACHE_DIR"] = str(cache)
    for name in [k for k, v in environment.items() if v is None]:
        del environment[name]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
    return subprocess.Popen([*COMMAND, *map(str, arguments)], env=environment, text=True, **streams)


def run(*arguments: Any, cache: Path | None, **options: Any) -> tuple[int, str, str]:
    """Exit code, stdout, stderr; a traceback is never an answer."""
    process = start(*arguments, cache=cache, **options)
    out, err = process.communicate(timeout=120)
    assert "Traceback" not in (err or "")
    return process.returncode, out, err


def results(out: str) -> Any:
    return json.loads(out)["results"]


@pytest.fixture(scope="module")
def warm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache that holds the kernels of QUICK."""
    folder = tmp_path_factory.mktemp("warm")
    assert run(*QUICK, cache=folder)[0] == 0
    return folder


@pytest.fixture(scope="module")
def truth(warm: Path) -> Any:
    return results(run(*QUICK, cache=warm)[1])
