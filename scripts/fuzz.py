"""Long fuzzing of the command line and of every file it reads; the tests run the same for seconds.

    python scripts/fuzz.py [--minutes 60] [--record scripts/results/fuzz.json]

Draws from tests/cli. Each case runs in a child of this warm process, in an empty folder. It
fails if it ends in anything but an answer or one sentence (a traceback, a signal, exit code 70),
takes 20 s of processor time or sleeps for a minute, leaves a half-written file, or loses the
report it was asked for. With --record the hour goes on where it stopped; failures are kept with
what reproduces them.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import io
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from montecarlo_brdf.cli import execute
from montecarlo_brdf.files import write_text

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "cli"))
PROCESSOR_SECONDS, IDLE, TICK = 20, 120, 0.5
RAISED = 99
#: What warms this process, so that a child finds imported and loaded what nearly all need.
WARMING = (
    "furnace --model lambert --samples 64 --threads 1 --export-json r.json",
    "furnace --model warm.py --samples 64 --threads 1 --theta-o 30",
    f"radiance {ROOT}/examples/phong.toml --samples 64 --threads 1 --plot r.svg",
    "run --model lambert --samples 64 --threads 1 --baseline r.json",
    "plot r.json -o r.svg",
    "stress --model ggx --at 0,0,1,0,0,1",
    "show ggx",
    "models",
)


def _file(folder: Path, name: str, content: bytes | str) -> str:
    data = content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass")
    (folder / name).write_bytes(data)
    return str(folder / name)


def _report(drawn: Any, folder: Path) -> str:
    return _file(folder, "report.json", drawn if isinstance(drawn, str) else json.dumps(drawn))


def kinds() -> dict[str, tuple[Any, Callable[[Any, Path], list[str]]]]:
    """What is drawn, and the command line that reads it."""
    import fuzzed_files
    import fuzzing

    few = ["--samples", "2^6", "--threads", "1"]
    furnace = ["furnace", "--theta-o", "30", *few, "--model"]
    baseline = ["run", "--model", "lambert", "--check", "isotropy", "--baseline"]
    return {
        "command line": (fuzzing.command_lines(), fuzzing.in_folder),
        "model file": (fuzzed_files.model_files(),
                       lambda d, at: ["show", _file(at, "fuzzed.py", d)]),
        "model in use": (fuzzed_files.model_files(),
                         lambda d, at: [*furnace, _file(at, "fuzzed.py", d)]),
        "scene": (fuzzed_files.scenes(),
                  lambda d, at: ["radiance", _file(at, "scene.toml", d), *few]),
        "settings": (fuzzed_files.settings(),
                     lambda d, at: ["run", "--config", _file(at, "brdf-check.toml", d)]),
        "report": (fuzzed_files.reports(),
                   lambda d, at: ["plot", _report(d, at), "-o", str(at / "out.svg")]),
        "baseline": (fuzzed_files.reports(), lambda d, at: [*baseline, _report(d, at)]),
    }  # fmt: skip


def examples(strategy: Any) -> Iterator[Any]:
    """Random examples for ever, a hundred at a time: `strategy.example()` is ten times slower."""
    from hypothesis import HealthCheck, Phase, given, settings

    many = settings(max_examples=100, database=None, deadline=None, phases=[Phase.generate],
                    suppress_health_check=list(HealthCheck))  # fmt: skip
    found: list[Any] = []
    fill = many(given(strategy)(lambda drawn: found.append(drawn)))
    while True:
        fill()
        yield from found
        found.clear()


def warm(folder: Path) -> None:
    """Run WARMING in this process."""
    folder.mkdir()
    (folder / "warm.py").write_text("def f(wo, wi, p):\n    return [0.3][0]\n")  # needs numba
    before = os.getcwd()
    os.chdir(folder)
    for line in WARMING:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            execute(line.split())
    os.chdir(before)


def attempt(arguments: list[str], folder: Path) -> tuple[str, str | None]:
    """(how it ended, what was wrong with that or None) of one command line in a child."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        _in_child(arguments, folder)
    idle = 0
    while idle < IDLE:
        before = _work_of(child)
        signal.sigtimedwait([signal.SIGCHLD], TICK)
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return judged(os.waitstatus_to_exitcode(status), arguments, folder)
        idle = idle + 1 if before and _work_of(child) == before else 0
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "hang", "did not end"


def _work_of(process: int) -> list[str] | None:
    """Processor time of a process that waits; None of one that would run if it could."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return fields[11:13] if fields[0] == "S" else None


def _in_child(arguments: list[str], folder: Path) -> None:
    """Run a command line with its streams in files, and leave."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGCHLD])
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS))
    streams = (folder.parent / "stdout", folder.parent / "stderr")
    for number, path in enumerate(streams, start=1):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
    os.chdir(folder)
    code = RAISED
    try:
        code = execute(arguments)
        sys.stdout.flush()
    except BaseException:  # the point is that nothing escapes
        traceback.print_exc()
    sys.stderr.flush()
    os._exit(code)


def judged(code: int, arguments: list[str], folder: Path) -> tuple[str, str | None]:
    """What is wrong with how a command line ended, from its exit code, streams and files."""
    import fuzzing

    out, err = ((folder.parent / s).read_text(errors="replace") for s in ("stdout", "stderr"))
    last = (err.strip().splitlines() or [""])[-1]
    problem = None
    if code not in fuzzing.ANSWERS:
        problem = f"exit {code}: {err[-3000:]}"
    elif "Traceback" in err or "Warning:" in err.replace("Warning: the weights", ""):
        problem = f"exit {code} with {err[-3000:]}"
    elif code in (2, 4, 5) and not last.startswith("Error: ") and "Usage: " not in out + err:
        problem = f"exit {code} without a sentence: {last}"
    elif code in (0, 1, 3) and _lost(arguments, folder, out):
        problem = "the report asked for was lost"
    elif half := [p.name for p in folder.rglob(".*")]:
        problem = f"left behind: {half}"
    return str(code), problem


def _lost(arguments: list[str], folder: Path, out: str) -> bool:
    """Whether --export-json was given and no whole report came of it."""
    wanted = [b for a, b in zip(arguments, arguments[1:], strict=False) if a == "--export-json"]
    if arguments[:1] != ["furnace"] or not wanted or out.startswith("Usage: "):
        return False
    try:
        return "results" not in json.loads(Path(wanted[-1]).read_text())
    except (OSError, ValueError):
        return True


def commit() -> str:
    """The commit under test, and whether the package differs from it."""
    git = ["git", "-C", str(ROOT)]
    head = subprocess.run([*git, "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    changed = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", "montecarlo_brdf"])
    return head.stdout.strip() + (" and changes" if changed.returncode else "")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--record", type=Path)
    parser.add_argument("--only", nargs="*", help="kinds of cases")
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # hypothesis: examples outside a test
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGCHLD])
    state: dict[str, Any] = {"commit": commit(), "seconds": 0.0, "cases": {}, "failures": []}
    if options.record and options.record.exists():
        state = json.loads(options.record.read_text())
    chosen = {
        kind: (examples(strategy), command)
        for kind, (strategy, command) in kinds().items()
        if not options.only or kind in options.only
    }
    with tempfile.TemporaryDirectory() as name:
        os.environ.setdefault("BRDF_CHECK_CACHE_DIR", str(Path(name) / "cache"))
        warm(Path(name) / "warm")
        while state["seconds"] < 60.0 * options.minutes:
            for kind, (drawn, command) in chosen.items():
                one_case(state, kind, next(drawn), command, Path(name) / "case")
            if options.record:
                write_text(options.record, json.dumps(state, indent=1) + "\n")
    print(json.dumps({k: v for k, v in state.items() if k != "failures"}, indent=1))
    print(f"{len(state['failures'])} failures")


def one_case(state: dict[str, Any], kind: str, drawn: Any, command: Any, folder: Path) -> None:
    """Run one case and record how it ended."""
    started = time.monotonic()
    folder.mkdir()
    arguments = command(drawn, folder)
    files = {p.name: repr(p.read_bytes()) for p in folder.iterdir()}
    ended, problem = attempt(arguments, folder)
    shutil.rmtree(folder, ignore_errors=True)
    counts = collections.Counter(state["cases"].get(kind, {}))
    counts[ended] += 1
    state["cases"][kind] = dict(sorted(counts.items()))
    state["seconds"] += min(time.monotonic() - started, PROCESSOR_SECONDS)
    if problem:
        failure = {"kind": kind, "arguments": arguments, "files": files, "problem": problem}
        state["failures"].append(failure)
        print(json.dumps(failure), flush=True)


if __name__ == "__main__":
    main()
