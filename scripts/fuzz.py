"""Long fuzzing of the command line, model files and reports; the tests run the same for seconds.

    python scripts/fuzz.py [--minutes 60] [--seed 0] [--record fuzz.json]

Draws from tests/robustness/fuzzing.py. A failure is an exit code that is no answer (70 is an
internal error), an exception, or a case slower than 20 s. With --record the count goes on where it
stopped.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

from montecarlo_brdf.cli import run  # before a command of that name replaces it

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "robustness"))
SLOW = 20.0


def case(kind: str, drawn: Any, folder: Path) -> list[str]:
    """The command line of one drawn example, its file written."""
    import fuzzing

    if kind == "command line":
        return fuzzing.in_folder(drawn, folder)
    if kind == "model file":
        (folder / "fuzzed.py").write_bytes(drawn)
        return ["show", str(folder / "fuzzed.py")]
    (folder / "report.json").write_text(drawn if isinstance(drawn, str) else json.dumps(drawn))
    return ["plot", str(folder / "report.json"), "-o", str(folder / "out.svg")]


def attempt(arguments: list[str]) -> str | None:
    """What was wrong with the answer, or None."""
    import fuzzing

    started = time.monotonic()
    quiet = io.StringIO()
    try:
        with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet):
            code = run(arguments)
    except BaseException as error:  # the point is that nothing escapes
        return repr(error)
    if code not in fuzzing.ANSWERS:
        return f"exit {code}: {quiet.getvalue()[-200:]}"
    seconds = time.monotonic() - started
    return f"{seconds:.0f} s" if seconds > SLOW else None


def main() -> None:
    import fuzzing

    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--record", type=Path)
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # hypothesis: examples outside a test
    state = {"seed": options.seed, "cases": 0, "seconds": 0.0, "failures": []}
    if options.record and options.record.exists():
        state = json.loads(options.record.read_text())
    strategies = {
        "command line": fuzzing.command_lines(),
        "model file": fuzzing.model_files(),
        "report": fuzzing.reports(),
    }
    end = time.monotonic() + 60.0 * options.minutes
    with tempfile.TemporaryDirectory() as name:
        os.environ.setdefault("BRDF_CHECK_CACHE_DIR", str(Path(name) / "cache"))
        while time.monotonic() < end:
            started = time.monotonic()
            for kind, strategy in strategies.items():
                arguments = case(kind, strategy.example(), Path(name))
                problem = attempt(arguments)
                state["cases"] += 1
                if problem:
                    state["failures"].append([kind, arguments, problem])
                    print(kind, arguments, problem, flush=True)
            state["seconds"] += time.monotonic() - started
            if options.record:
                options.record.write_text(json.dumps(state))
    print(f"{state['cases']} cases in {state['seconds']:.0f} s, {len(state['failures'])} failures")


if __name__ == "__main__":
    main()
