"""Fixtures that all tests share. Kernels compile once per session, into a directory of its own."""
from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest
from hypothesis import settings

import montecarlo_brdf
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.cli import execute as run

#: No deadlines: a busy machine is no error. In CI the same cases every time.
settings.register_profile("ours", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("ours")


class Outcome(NamedTuple):
    """What a command left behind."""

    code: int
    out: str
    err: str


@pytest.fixture(scope="session", autouse=True)
def kernel_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty cache: a test session depends on nothing that was compiled before it, unless
    $BRDF_CHECK_TEST_CACHE names a folder that keeps kernels from one session to the next."""
    root = tmp_path_factory.getbasetemp()
    shared = root.parent if os.environ.get("PYTEST_XDIST_WORKER") else root  # by all workers
    folder = Path(os.environ.get("BRDF_CHECK_TEST_CACHE", shared / "kernels"))
    folder.mkdir(exist_ok=True)
    os.environ["BRDF_CHECK_CACHE_DIR"] = str(folder)
    os.environ["BRDF_CHECK_QUIET"] = "1"  # a cold cache says no more on stderr than a warm one
    return folder


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str]) -> Callable[..., Outcome]:
    """brdf-check in this process."""

    def call(*arguments: object) -> Outcome:
        capsys.readouterr()
        code = run([str(a) for a in arguments])
        return Outcome(code, *capsys.readouterr())

    return call


@pytest.fixture(scope="session")
def process() -> Callable[..., Outcome]:
    """brdf-check in a process of its own, with some environment variables changed."""

    def call(*arguments: object, **environment: str) -> Outcome:
        done = subprocess.run(
            [sys.executable, "-m", "montecarlo_brdf", *map(str, arguments)],
            capture_output=True,
            encoding="utf-8",
            env={**os.environ, **environment},
            timeout=120,
        )
        return Outcome(done.returncode, done.stdout, done.stderr)

    return call


@pytest.fixture
def user_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Path]:
    """Write a user's file; the folder leaves the import path with the test."""
    monkeypatch.setattr(sys, "path", sys.path[:])

    def write(text: str, name: str = "my_brdf.py") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def case_of(user_file: Callable[..., Path]) -> Callable[..., Case]:
    """The case of a model that a test writes down; its parameters may vary over their ranges."""

    def make(text: str, **changed: object) -> Case:
        head = "import math\nfrom typing import NamedTuple\n\n"
        model = montecarlo_brdf.load(str(user_file(head + text)))
        case = Case(model, model.parameters(), (0.0, 45.0), free=searched(model, {}))
        return case._replace(**changed)

    return make
