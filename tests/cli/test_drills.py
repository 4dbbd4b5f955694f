"""What goes wrong around the program: each drill ends in a clear sentence or a right result."""

# ruff: noqa: F401, F811 (fixtures are imported, and named by arguments)

from __future__ import annotations

import resource
import shutil
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from drills import QUICK, results, run, start, truth, warm


def slow(value: str) -> Any:
    """A variation of a drill, only for `-m slow`."""
    return pytest.param(value, marks=pytest.mark.slow)


def limited(size: int) -> Callable[[], None]:
    """No file may grow beyond `size` bytes: what a full disk looks like to a program."""

    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return limit


def test_disk_full_while_a_report_is_written(warm: Path, tmp_path: Path) -> None:
    target = tmp_path / "report.json"
    target.write_text("older report")
    code, _, err = run(*QUICK, "--export-json", target, cache=warm, preexec_fn=limited(256))
    assert code == 5 and "cannot write" in err
    assert [p.name for p in tmp_path.iterdir()] == ["report.json"]
    assert target.read_text() == "older report"


def test_disk_full_while_a_kernel_is_stored(tmp_path: Path, truth: Any) -> None:
    code, out, _ = run(*QUICK, cache=tmp_path, preexec_fn=limited(256), stdout=subprocess.PIPE)
    assert code == 0 and results(out) == truth
    assert {p.name for p in tmp_path.iterdir()} <= {"uses.txt"}  # how often it was of use


def test_stdout_full(warm: Path) -> None:
    with open("/dev/full", "w") as full:
        code, _, err = run(*QUICK, cache=warm, stdout=full)
    assert code == 5 and "cannot write to stdout" in err


@pytest.mark.parametrize("place", [slow("/proc/1/no_such_folder"), "a file"])
def test_cache_that_cannot_be_written(place: str, tmp_path: Path, truth: Any) -> None:
    (tmp_path / "a file").write_text("")
    cache = tmp_path / place / "cache"  # an absolute place stays what it is
    code, out, _ = run(*QUICK, cache=cache)
    assert code == 0 and results(out) == truth


@pytest.mark.slow  # test_cache asks the same of two kernels
def test_two_processes_compile_at_once(tmp_path: Path, truth: Any) -> None:
    both = [start(*QUICK, cache=tmp_path) for _ in range(2)]
    for process in both:
        out, err = process.communicate(timeout=120)
        assert process.returncode == 0 and results(out) == truth, err
    assert not list(tmp_path.glob("*.part"))
    assert results(run(*QUICK, cache=tmp_path)[1]) == truth


@pytest.mark.parametrize("damage", ["cut", *map(slow, ("flipped", "empty", "other"))])
def test_damaged_kernels_are_not_used(damage: str, warm: Path, tmp_path: Path, truth: Any) -> None:
    cache = tmp_path / "cache"
    shutil.copytree(warm, cache)
    for path in cache.glob("*.o"):
        content = path.read_bytes()
        middle = len(content) // 2
        path.write_bytes(
            {
                "cut": content[:middle],
                "flipped": content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :],
                "empty": b"",
                "other": b"\0" * len(content),
            }[damage]
        )
    code, out, _ = run(*QUICK, cache=cache)
    assert code == 0 and results(out) == truth


@pytest.mark.parametrize("home", [None, *map(slow, ("/proc/1/no_such_home", ""))])
def test_no_home(home: str | None, tmp_path: Path, truth: Any) -> None:
    # XDG_CACHE_HOME stands for what the user database would say, which tests must not write to
    code, out, _ = run(*QUICK, cache=None, env={"HOME": home, "XDG_CACHE_HOME": str(tmp_path)})
    assert code == 0 and results(out) == truth


def test_full_home(tmp_path: Path, truth: Any) -> None:
    full = {"HOME": str(tmp_path), "XDG_CACHE_HOME": None}
    code, out, _ = run(*QUICK, cache=None, env=full, preexec_fn=limited(0))
    assert code == 0 and results(out) == truth


TEXTS = [
    QUICK[:-2],
    ["models"],
    ["show", "oren_nayar"],
    ["furnace", "--help"],
    ["show", "\u00f8re"],
]


@pytest.mark.parametrize(
    "text", TEXTS, ids=lambda t: " ".join(t[:2]).encode("ascii", "replace").decode()
)
def test_locales_without_unicode(text: list[str], warm: Path) -> None:
    plain = {"LC_ALL": "C", "LANG": "C", "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    code, out, err = run(*text, cache=warm, env=plain)
    assert code in (0, 2), err


@pytest.mark.parametrize("text", TEXTS[:4], ids=lambda t: " ".join(t[:2]))
def test_terminal_of_one_column(text: list[str], warm: Path) -> None:
    assert run(*text, cache=warm, env={"COLUMNS": "1", "TERM": "dumb"})[0] == 0


def test_no_terminal_at_all(warm: Path, truth: Any) -> None:
    code, out, _ = run(*QUICK, cache=warm, env={"TERM": None}, stdin=subprocess.DEVNULL,
                       start_new_session=True)  # fmt: skip
    assert code == 0 and results(out) == truth


@pytest.mark.parametrize("text", TEXTS[:4], ids=lambda t: " ".join(t[:2]))
def test_closed_pipe(text: list[str], warm: Path) -> None:
    with start(*text, cache=warm) as process:
        assert process.stdout and process.stderr
        process.stdout.close()
        err = process.stderr.read()
    assert process.returncode in (0, 5) and "Traceback" not in err and "Exception" not in err
