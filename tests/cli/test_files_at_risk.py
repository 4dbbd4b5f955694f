"""Files that may not be written, and writers that are killed: nothing half is left or used."""

# ruff: noqa: F401, F811 (fixtures are imported, and named by arguments)

from __future__ import annotations

import ctypes
import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from drills import QUICK, results, run, start, truth, warm

from montecarlo_brdf.compile import cache as kernels

PR_CAPBSET_DROP, CAP_DAC_OVERRIDE = 24, 1  # linux/prctl.h, linux/capability.h


def without_privilege() -> None:
    """Permissions hold for root too once it may not override them (Linux: CAP_DAC_OVERRIDE)."""
    if os.geteuid() == 0:
        ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0)


def heeds_permissions(folder: Path) -> bool:
    """Whether a process of ours cannot write to a folder that nobody may write to."""
    script = f"import os; raise SystemExit(os.access({str(folder)!r}, os.W_OK))"
    done = subprocess.run([sys.executable, "-c", script], preexec_fn=without_privilege, timeout=60)
    return done.returncode == 0


@pytest.fixture
def locked(tmp_path: Path) -> Iterator[Path]:
    """A folder that can be read and not written."""
    folder = tmp_path / "locked"
    folder.mkdir()
    folder.chmod(0o555)
    if not (hasattr(os, "geteuid") and heeds_permissions(folder)):
        pytest.skip("this user may write everywhere")
    yield folder
    folder.chmod(0o755)


def test_cache_without_write_permission(locked: Path, truth: Any) -> None:
    code, out, _ = run(*QUICK, cache=locked, preexec_fn=without_privilege)
    assert code == 0 and results(out) == truth
    assert not list(locked.iterdir())


def test_cache_of_another_user(locked: Path, warm: Path, truth: Any) -> None:
    locked.chmod(0o755)
    for path in warm.glob("*.o"):
        shutil.copy(path, locked / path.name).chmod(0o000)
    locked.chmod(0o555)
    code, out, _ = run(*QUICK, cache=locked, preexec_fn=without_privilege)
    assert code == 0 and results(out) == truth


def test_report_without_write_permission(locked: Path, warm: Path) -> None:
    target = locked / "report.json"
    code, _, err = run(*QUICK, "--export-json", target, cache=warm, preexec_fn=without_privilege)
    assert code == 5 and f"cannot write {target}: permission denied" in err


#: Runs the command and dies after half of the first file that it writes, as by `kill -9`.
KILLED = """
import os, signal, sys
from montecarlo_brdf.cli import main

class Half:
    def __init__(self, handle, mode):
        self.handle = handle
    def __enter__(self):
        return self
    def __exit__(self, *about):
        pass
    def write(self, content):
        os.write(self.handle, content[:len(content) // 2])
        os.kill(os.getpid(), signal.SIGKILL)

os.fdopen = Half
main()
"""


def killed_while_writing(*arguments: Any, cache: Path) -> None:
    command = [sys.executable, "-c", KILLED, *map(str, arguments)]
    environment = {**os.environ, "BRDF_CHECK_CACHE_DIR": str(cache)}
    done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, timeout=120)
    assert done.returncode == -signal.SIGKILL


def test_killed_in_the_middle_of_a_report(tmp_path: Path, warm: Path) -> None:
    target = tmp_path / "report.json"
    target.write_text("older report")
    killed_while_writing(*QUICK, "--export-json", target, cache=warm)
    assert target.read_text() == "older report"
    assert run(*QUICK, "--export-json", target, cache=warm)[0] == 0
    assert json.loads(target.read_text())["results"]


def test_killed_in_the_middle_of_a_cache_entry(tmp_path: Path, truth: Any) -> None:
    killed_while_writing(*QUICK, cache=tmp_path)
    (half,) = (p for p in tmp_path.iterdir() if p.name != kernels.folders.USES)
    assert half.suffix == ".part" and half.stat().st_size > 0
    assert results(run(*QUICK, cache=tmp_path)[1]) == truth
    assert half.exists()  # another process may still be writing it
    os.utime(half, (0, 0))
    kernels.clear_leftovers(tmp_path)
    assert not [*tmp_path.glob("*.part")] and [*tmp_path.glob("*.o")]


def test_killed_while_compiling(tmp_path: Path, truth: Any) -> None:
    process = start(*QUICK, cache=tmp_path)
    with pytest.raises(subprocess.TimeoutExpired):
        process.communicate(timeout=0.4)
    process.kill()
    process.communicate()
    (tmp_path / "half.part").write_bytes(b"half a kernel")
    assert results(run(*QUICK, cache=tmp_path)[1]) == truth
