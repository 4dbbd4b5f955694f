"""Reference values on disk never change a result, are never stale and save importing numpy."""
from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome

from montecarlo_brdf import references, truth
from montecarlo_brdf.compile import cache
from montecarlo_brdf.truth import true_albedo

GIVEN = {"alpha": 0.3, "f0": 0.04}
COMMAND = ["furnace", "--model", "ggx", "-p", "alpha=0.37", "-p", "f0=0.5", "--theta-o", "0,80"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty cache, and a process that remembers nothing, before and after."""
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path))
    forget()
    yield tmp_path
    forget()


def forget() -> None:
    for known in (truth._values, truth._file, truth._dependencies):
        known.cache_clear()


def refuse(*_: Any, **__: Any) -> Any:
    raise AssertionError("computed again")


def test_what_was_asked_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    first = true_albedo("ggx", 0.5, **GIVEN)
    assert first == references.albedo("ggx", 0.5, **GIVEN)
    forget()
    monkeypatch.setattr(references, "albedo", refuse)
    assert true_albedo("ggx", 0.5, **GIVEN) == first
    for other in ({"mu": 0.5000001}, {"alpha": 0.31}, {"f0": 0.041}):
        mu, given = other.pop("mu", 0.5), {**GIVEN, **other}
        with pytest.raises(AssertionError, match="computed again"):
            true_albedo("ggx", mu, **given)
    with pytest.raises(AssertionError, match="computed again"):
        true_albedo("beckmann", 0.5, **GIVEN)


def test_closed_forms_are_not_written(folder: Path) -> None:
    assert true_albedo("lambert", 0.5, albedo=0.8) == references.albedo(
        "lambert", 0.5, albedo=0.8
    )
    assert true_albedo("no_such_model", 0.5) is None and not any(folder.iterdir())


@pytest.mark.parametrize("damage", ["half", "one digit", "other"])
def test_a_damaged_line_counts_as_absent(damage: str, folder: Path) -> None:
    values = [true_albedo("ggx", mu, **GIVEN) for mu in (0.2, 0.5)]
    (file,) = folder.glob("*.txt")
    first, second = file.read_bytes().splitlines(keepends=True)
    half, flipped = first[:70], first.replace(b"0.04", b"0.05")
    file.write_bytes({"half": half, "one digit": flipped, "other": b"\xff\n"}[damage] + second)
    forget()
    left = cache.notes(file.stem)
    assert len(left) == (0 if damage == "half" else 1)  # a torn line takes the next with it
    assert [true_albedo("ggx", mu, **GIVEN) for mu in (0.2, 0.5)] == values


def test_an_edit_of_a_reference_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before, sources = truth._file("ggx"), tmp_path / "references"
    sources.mkdir()
    for path in Path(str(references.__file__)).parent.glob("*.py"):
        (sources / path.name).write_bytes(path.read_bytes())
    monkeypatch.setattr(references, "__file__", str(sources / "__init__.py"))
    forget()
    assert truth._file("ggx") == before
    (sources / "_ggx.py").write_bytes((sources / "_ggx.py").read_bytes().replace(b"4.0", b"4.1"))
    forget()
    assert truth._file("ggx") != before


def test_notes_do_not_grow_for_ever(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "LARGEST_NOTES", 100)
    for i in range(4):
        cache.note("some", f"line {i}")
    assert cache.notes("some") == ["line 3"]  # three lines of 39 bytes are the first over 100


def test_a_second_run_gives_the_same_bytes_without_numpy(process: Callable[..., Outcome]) -> None:
    first, again = (process(*COMMAND, "--format", "json") for _ in range(2))
    results = [o.out[o.out.index('"results"') : o.out.index('"measured"')] for o in (first, again)]
    assert first.code == again.code == 0 and results[0] == results[1]
    assert not imports_numpy(COMMAND)
    unasked = 70.0 + time.time() % 10.0  # also of a cache that is kept from one suite to the next
    assert imports_numpy([*COMMAND[:-1], f"0,{unasked}"])  # or this test would prove nothing


def imports_numpy(command: list[str]) -> bool:
    watched = [sys.executable, "-X", "importtime", "-m", "montecarlo_brdf", *command]
    done = subprocess.run(watched, capture_output=True, encoding="utf-8", env=dict(os.environ))
    assert done.returncode == 0
    return any(line.endswith(" numpy") for line in done.stderr.splitlines())
