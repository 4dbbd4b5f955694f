"""The cache of compiled kernels is never stale, never fatal and never shows in a result.

An edit must show at once, in a process of its own, as a user's would. The edits here keep the
length of the file and happen within a second of the run before: nothing may be trusted but content.
"""
from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

from montecarlo_brdf.compile import cache

Write = Callable[..., Path]
Command = Callable[..., Outcome]

#: Where an edited number may hide: (model, other file, what is edited), each with value 0.1.
HIDDEN = {
    "function in another file": (
        "import other\ndef f(wo, wi, p):\n    return other.g(1.0)\n",
        "def g(x):\n    return 0.1 * x\n",
    ),
    "function imported by name": (
        "from other import g\ndef f(wo, wi, p):\n    return g(1.0)\n",
        "def h(x):\n    return 0.1 * x\ndef g(x):\n    return h(x)\n",
    ),
    "constant in another file": (
        "import other\ndef f(wo, wi, p):\n    return other.K\n",
        "K = 0.1\n",
    ),
    "constant that another file's function uses": (
        "import other\ndef f(wo, wi, p):\n    return other.g()\n",
        "K = 0.1\ndef g():\n    return K\n",
    ),
    "jitted function": (
        "import numba\n@numba.njit\ndef g():\n    return 0.1\ndef f(wo, wi, p):\n    return g()\n",
        "",
    ),
    "global constant": ("K = 0.1\ndef f(wo, wi, p):\n    return K\n", ""),
    "literal": ("def f(wo, wi, p):\n    return 0.1\n", ""),
    "default argument": (
        "def g(x=0.1):\n    return x\ndef f(wo, wi, p):\n    return g()\n",
        "",
    ),
    "closure": (
        "def make(k):\n    def g():\n        return k\n    return g\ng = make(0.1)\n"
        "def f(wo, wi, p):\n    return g()\n",
        "",
    ),
    "numpy array": (
        "import numpy as np\nK = np.array([7.0, 0.1])\ndef f(wo, wi, p):\n    return K[1]\n",
        "",
    ),
    "tuple": ("K = (7.0, 0.1)\ndef f(wo, wi, p):\n    return K[1]\n", ""),
    "named tuple": (
        "from typing import NamedTuple\nclass V(NamedTuple):\n    x: float = 0.1\nK = V()\n"
        "def f(wo, wi, p):\n    return K.x\n",
        "",
    ),
    "enumeration": (
        "import enum\nclass K(enum.IntEnum):\n    A = 0x1\n"
        "def f(wo, wi, p):\n    return 0.1 if K.A == 1 else 0.2\n",
        "",
    ),
}


def edited(text: str) -> str:
    """The same text, as long as before, with 0.2 in the place that gave 0.1."""
    old, new = ("0x1", "0x2") if "0x1" in text else ("0.1", "0.2")
    return text.replace(old, new)


def value(outcome: Outcome) -> float:
    assert outcome.code in (0, 1), outcome
    return float(json.loads(outcome.out)["results"][0]["findings"][0]["value"])


def furnace(model: object, *more: object) -> list[object]:
    quick = ["--theta-o", 0, "--sampler", "cosine", "--samples", "2^14", "--format", "json"]
    return ["furnace", "--model", model, *quick, *more]


#: Prints the name of the kernel of every model file given, as a run would ask the cache for it.
KEYS = """
import sys
from montecarlo_brdf import load
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate.moments import kernel_of
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand
for path in sys.argv[1:]:
    sys.modules.pop("other", None)
    sys.path_importer_cache.clear()
    model = load(path)
    sys.path.pop(0)
    layout, _ = pack([model.parameters()], 4)
    mean = integrand(model, Quantity.ALBEDO, "cosine")
    print(kernel_of(model.name, "sobol", [mean], layout).key)
"""


def keys(paths: list[Path]) -> list[str]:
    command = [sys.executable, "-c", KEYS, *map(str, paths)]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=True, timeout=120)
    return done.stdout.split()


def test_an_edit_makes_another_kernel_wherever_it_hides(tmp_path: Path) -> None:
    paths = []
    for k, (model, other) in enumerate(HIDDEN.values()):
        folder = tmp_path / str(k)
        folder.mkdir()
        (folder / "model.py").write_text(model)
        (folder / "other.py").write_text(other)
        paths.append(folder / "model.py")
    before, again = keys(paths), keys(paths)
    assert before == again and len(set(before)) == len(HIDDEN)
    for path in tmp_path.rglob("*.py"):
        path.write_text(edited(path.read_text()))
    after = keys(paths)
    assert [place for place, a, b in zip(HIDDEN, before, after, strict=True) if a == b] == []


@pytest.mark.parametrize(
    "place",
    ["function in another file", pytest.param("numpy array", marks=pytest.mark.slow)],
)
def test_an_edit_shows_at_once(place: str, user_file: Write, process: Command) -> None:
    model, other = HIDDEN[place]
    path = user_file(model)
    user_file(other, "other.py")
    assert value(process(*furnace(path))) == pytest.approx(0.1 * math.pi, rel=1e-14)
    user_file(edited(other), "other.py")
    user_file(edited(model))
    assert value(process(*furnace(path))) == pytest.approx(0.2 * math.pi, rel=1e-14)


def test_an_edit_in_a_module_of_a_module_makes_another_kernel(tmp_path: Path) -> None:
    (tmp_path / "shading").mkdir()
    path = tmp_path / "model.py"
    for name, text in {
        "model.py": "import shading.sub\ndef f(wo, wi, p):\n    return shading.sub.g()\n",
        "shading/__init__.py": "",
        "shading/sub.py": "import shading.table\ndef g():\n    return shading.table.K\n",
        "shading/table.py": "K = 0.1\n",
    }.items():
        (tmp_path / name).write_text(text)
    before = keys([path])
    (tmp_path / "shading/table.py").write_text("K = 0.2\n")
    assert keys([path]) != before


def kernels(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.o"))


CONSTANT = "def f(wo, wi, p):\n    return 0.1\n"


@pytest.mark.parametrize("damage", ["empty", "half", "one bit", "other"])
def test_a_damaged_entry_counts_as_absent(
    damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(tmp_path))
    cache.write("kernel", bytes(range(256)))
    whole = (tmp_path / "kernel.o").read_bytes()
    flipped = whole[:100] + bytes([whole[100] ^ 1]) + whole[101:]
    content = {"empty": b"", "half": whole[:100], "one bit": flipped, "other": b"x" * 300}[damage]
    assert cache.read("kernel") == bytes(range(256))
    (tmp_path / "kernel.o").write_bytes(content)
    assert cache.read("kernel") is None


@pytest.mark.slow  # a drill asks the same
def test_damaged_kernels_are_compiled_again(
    tmp_path: Path, user_file: Write, process: Command
) -> None:
    path, folder = user_file(CONSTANT), tmp_path / "cache"
    clean = process(*furnace(path), BRDF_CHECK_CACHE_DIR=str(folder))
    entries = kernels(folder)
    for entry in entries:
        entry.write_bytes(entry.read_bytes()[:1000])
    again = process(*furnace(path), BRDF_CHECK_CACHE_DIR=str(folder))
    assert (again.code, again.err) == (0, "") and results(again) == results(clean)
    assert kernels(folder) == entries != []
    assert all(entry.stat().st_size > 1000 for entry in entries)


def results(outcome: Outcome) -> str:
    """The results of a report, byte for byte."""
    text = outcome.out
    return text[text.index('"results"') : text.index('"measured"')]


@pytest.mark.parametrize("kind", ["read-only", "a file", "below a file"])
def test_a_cache_that_cannot_be_written_is_no_error(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "cache"
    if kind == "read-only":
        folder.mkdir(mode=0o500)
    else:
        folder.touch()
    monkeypatch.setenv("BRDF_CHECK_CACHE_DIR", str(folder / "x" if "below" in kind else folder))
    cache.write("kernel", b"image")
    if kind != "read-only" or os.geteuid() != 0:  # root may write anywhere
        assert cache.read("kernel") is None


def test_without_a_cache_a_run_is_only_slow(
    tmp_path: Path, user_file: Write, process: Command
) -> None:
    (tmp_path / "cache").touch()
    path, folder = user_file(CONSTANT), str(tmp_path / "cache" / "below a file")
    outcome = process(*furnace(path), BRDF_CHECK_CACHE_DIR=folder)
    assert value(outcome) == pytest.approx(0.1 * math.pi, rel=1e-14)
    assert outcome.code == 0
    (told,) = outcome.err.splitlines()
    assert told.startswith(f"Warning: cannot write to {folder} ") and "compiled anew" in told


def test_two_processes_may_compile_the_same_kernel_at_once(
    tmp_path: Path, user_file: Write, process: Command
) -> None:
    folder = tmp_path / "cache"
    command = [sys.executable, "-m", "montecarlo_brdf", *map(str, furnace(user_file(CONSTANT)))]
    environment = {**os.environ, "BRDF_CHECK_CACHE_DIR": str(folder)}
    both = [
        subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, encoding="utf-8")
        for _ in range(2)
    ]
    outcomes = [Outcome(p.wait(), out, "") for p in both for out in [p.communicate()[0]]]
    assert [o.code for o in outcomes] == [0, 0]
    assert results(outcomes[0]) == results(outcomes[1])
    left = sorted(os.listdir(folder))
    assert left and not any(name.endswith(".part") for name in left)  # nothing half-written
    third = process(*command[3:], BRDF_CHECK_CACHE_DIR=str(folder))
    assert results(third) == results(outcomes[0]) and sorted(os.listdir(folder)) == left


#: Enough samples for threads to share: 2^20 per claim, and an interval that never gets that small.
LONG = ["--points", "independent", "--tolerance", "1e-9", "--samples", "2^20", "--theta-o", "20,70"]


def test_the_same_bytes_for_any_threads_cold_and_warm(tmp_path: Path, process: Command) -> None:
    cold = str(tmp_path / "cold")
    command = ["furnace", "--model", "ggx", "-p", "alpha=0.4", "--format", "json", *LONG]
    first = process(*command, "--threads", 1, BRDF_CHECK_CACHE_DIR=cold)
    assert first.code == 3 and len(first.out) > 1000
    for threads in (1, 2):
        again = process(*command, "--threads", threads, BRDF_CHECK_CACHE_DIR=cold)
        assert results(again) == results(first)


def test_threads_are_really_used(monkeypatch: pytest.MonkeyPatch) -> None:
    """The test before this one proves nothing unless its work is spread over threads."""
    import montecarlo_brdf as mb
    from montecarlo_brdf.estimate import evaluate

    started: list[int] = []

    class Pool(evaluate.ThreadPoolExecutor):
        def __init__(self, threads: int) -> None:
            started.append(threads)
            super().__init__(threads)

    monkeypatch.setattr(evaluate, "ThreadPoolExecutor", Pool)
    model = mb.load("ggx")
    for threads in (1, 2):
        mb.directional_albedo(
            model, model.parameters(), 20.0, points="independent", samples=2**20, threads=threads
        )
    assert started == [2]


def test_another_seed_gives_other_bytes(cli: Command) -> None:
    """Equal bytes mean nothing if they are always equal."""
    command = ["furnace", "--model", "ggx", "--theta-o", 20, "--samples", "2^14"]
    command += ["--format", "json"]
    one, two, again = (results(cli(*command, "--seed", s)) for s in (1, 2, 1))
    assert one != two and one == again
