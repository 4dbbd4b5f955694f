"""What somebody gets who installs the wheel: every example of every help runs as it is printed.

python scripts/wheel_examples.py [WORD ...] builds the wheel, installs it into an empty environment
in a folder whose name has blanks, and runs the examples there (with words: those that have one of
them) with nothing else of this repository at hand. Exit code 1 if one does not run. A folder that
BRDF_CHECK_CACHE_DIR names spares the compiling.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "cli")]

from test_help_examples import FILES, all_examples  # noqa: E402

#: what stands there already when a user types an example
BEFORE = (
    "examples --copy examples",
    "init",
    "furnace --model lambert --theta-o 0 --export report.json --export furnace.json "
    "--export run.json",
    "bench --model lambert --quick --export time.json",
)
RAN = (0, 1, 3)  # exit codes of an example that runs
ENDLESS, PATIENCE = "--watch", 30  # an example that a user ends, and after how long


def installed(folder: Path) -> Path:
    """brdf-check of an environment that has the wheel."""
    quiet = ("--quiet", "--disable-pip-version-check")
    pip = [sys.executable, "-m", "pip", "wheel", *quiet, "--no-deps", "-w", folder, ROOT]
    subprocess.run(pip, check=True)
    (wheel,) = folder.glob("*.whl")
    place = folder / "an environment"
    venv.create(place, with_pip=True)
    programs = place / ("Scripts" if os.name == "nt" else "bin")
    subprocess.run([programs / "python", "-m", "pip", "install", *quiet, wheel], check=True)
    return programs / "brdf-check"


def run(program: Path, line: str, work: Path) -> subprocess.CompletedProcess[str]:
    """A command line as a shell reads it, in a folder of its own."""
    unset = ("PYTHONPATH", "BRDF_CHECK_QUIET")
    there = {k: v for k, v in os.environ.items() if k not in unset}
    path = f"{program.parent}{os.pathsep}{there['PATH']}"
    process = subprocess.Popen(
        f"exec {line}" if ENDLESS in line else line, shell=True, cwd=work,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        env={"BRDF_CHECK_CACHE_DIR": str(program.parents[1] / "cache"), **there, "PATH": path},
    )  # fmt: skip
    try:
        out, err = process.communicate(timeout=PATIENCE if ENDLESS in line else None)
    except subprocess.TimeoutExpired:
        process.terminate()
        out, err = process.communicate()
    return subprocess.CompletedProcess(line, process.returncode, out, err)


def prepared(program: Path, work: Path) -> None:
    """A user's folder."""
    work.mkdir()
    for name, text in FILES.items():
        (work / name).parent.mkdir(parents=True, exist_ok=True)
        (work / name).write_text(text, encoding="utf-8")
    for line in BEFORE:
        run(program, f"brdf-check {line}", work).check_returncode()


def main() -> int:
    """Run all."""
    failed = 0
    with tempfile.TemporaryDirectory(prefix="a folder with blanks ") as name:
        folder = Path(name)
        program = installed(folder)
        lines = [x for x in dict.fromkeys(all_examples())
                 if not sys.argv[1:] or {*sys.argv[1:]} & {*shlex.split(x)}]  # fmt: skip
        prepared(program, folder / "prepared")
        for k, line in enumerate(lines):
            work = folder / f"work {k}"
            if "--copy" in line or " init" in line:  # these write what stands there else
                work.mkdir()
            else:
                shutil.copytree(folder / "prepared", work)
            began = time.perf_counter()
            done = run(program, line, work)
            right = done.returncode in (RAN if ENDLESS not in line else (-signal.SIGTERM,))
            failed += not right
            print(f"{'ok  ' if right else 'FAIL'} {done.returncode} "
                  f"{time.perf_counter() - began:6.1f} s  {line}", flush=True)  # fmt: skip
            if not right:
                print(done.stderr[-600:], flush=True)
        print(f"{len(lines) - failed} of {len(lines)} examples run")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
