"""Detection matrix: every known-bad BRDF of tests/mutants against every check, default settings.

    python scripts/detection_matrix.py [--jobs 2] [NAME ...]  verdicts, as far as they are missing
    python scripts/detection_matrix.py --time [--minutes 3]   seconds of a warm `brdf-check run`

Resumable: what scripts/results/detection_matrix.json holds of an unchanged mutant and an unchanged
check (with what it imports of `checks`, `cases` and `judge`) is not run again. Writes
docs/detection_matrix.md. A mutant's docstring says which check is meant for it ("caught by:") and
what was done to it ("cause:"); tests/mutants/causes.toml says which words of a hint name a cause.
"""
from __future__ import annotations

import argparse
import ast
import concurrent.futures
import functools
import hashlib
import json
import re
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import montecarlo_brdf
from montecarlo_brdf import checks

ROOT = Path(__file__).parents[1]
PACKAGE = Path(montecarlo_brdf.__file__).parent
MUTANTS = ROOT / "tests" / "mutants"
RESULTS = ROOT / "scripts" / "results" / "detection_matrix.json"
TABLE = ROOT / "docs" / "detection_matrix.md"
MARKS = {"fail": "**x**", "inconclusive": "?", "pass": "·", "skipped": " "}
CAUSES = tomllib.loads((MUTANTS / "causes.toml").read_text(encoding="utf-8"))
FOLDERS = ("checks", "cases", "judge")
LIMIT = 10.0  # seconds that a mutant may take


def digest(*texts: bytes) -> str:
    """A short hash."""
    return hashlib.sha256(b"\0".join(texts)).hexdigest()[:12]


@functools.cache
def reached(path: Path) -> frozenset[Path]:
    """The files of FOLDERS that a file of the package imports, itself included."""
    found, waiting = set(), {path}
    while waiting:
        found.add(file := waiting.pop())
        waiting |= set(imported(file)) - found
    return frozenset(found)


def imported(path: Path) -> Iterator[Path]:
    """Files of FOLDERS that a file names in an import."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        parts = (getattr(node, "module", None) or "").split(".")[1:]
        if isinstance(node, ast.ImportFrom) and parts[:1] and parts[0] in FOLDERS:
            names = [parts, *([*parts, alias.name] for alias in node.names)]
            files = (PACKAGE.joinpath(*n).with_suffix(".py") for n in names)
            yield from (f for f in files if f.is_file())


@functools.cache
def version(check: str) -> str:
    """Changes with a check and with how it is judged."""
    files = reached(PACKAGE / "checks" / f"{check}.py") | reached(PACKAGE / "judge" / "decide.py")
    return digest(*(f.read_bytes() for f in sorted(files)))


def said(path: Path, what: str) -> str:
    """The rest of a docstring's line that starts with `what`."""
    found = re.findall(rf"^{what}: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[0] if found else ""


def mutants() -> Iterator[Path]:
    """All files of the corpus."""
    return (p for p in sorted(MUTANTS.glob("*.py")) if not p.stem.startswith("test_"))


def examined(path: Path, row: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """What checks say of a mutant, where that is not known yet, added to what is."""
    row = dict(row)
    for name in names:
        key = digest(path.read_bytes(), version(name).encode())
        if row.get(name, {}).get("key") != key:
            report = montecarlo_brdf.run(montecarlo_brdf.load(str(path)), names=[name])
            findings = [f for r in report.results for f in r.findings]
            row[name] = {"key": key, **summary(findings)}
    return row


def summary(findings: list[Any]) -> dict[str, Any]:
    """The worst verdict of a check, its samples, and the hints of what it refutes."""
    verdicts = [f.verdict for f in findings]
    refuted = [f for f in findings if f.verdict == "fail"]
    return {
        "verdict": next((v for v in MARKS if v in verdicts), "skipped"),
        "samples": sum(f.samples or 0 for f in findings),
        "hints": list(dict.fromkeys(f.hint for f in refuted if f.hint)),
    }


def timed(path: Path) -> dict[str, Any]:
    """Wall seconds of a whole process that runs every check, kernels being there already."""
    command = [sys.executable, "-m", "montecarlo_brdf", "run", "--model", str(path)]
    subprocess.run(command, capture_output=True, check=False)
    start = time.perf_counter()
    code = subprocess.run(command, capture_output=True, check=False).returncode
    return {"seconds": round(time.perf_counter() - start, 2), "exit": code}


def named(path: Path, row: dict[str, Any]) -> str:
    """The hint that names a mutant's cause, if there is one."""
    words = CAUSES.get(said(path, "cause"))
    hints = [h for name in checks.names() for h in row[name]["hints"]]
    return next((h for h in hints if words and re.search(words, h)), "")


def table(rows: dict[str, Any]) -> str:
    """The results as Markdown."""
    names, paths = checks.names(), list(mutants())
    caught = [p for p in paths if rows[p.stem][said(p, "caught by")]["verdict"] == "fail"]
    hinted = [p for p in paths if named(p, rows[p.stem])]
    lines = [
        "# Detection matrix",
        "",
        "Known-bad BRDFs (`tests/mutants`) against all checks at default settings. **x** refuted,",
        "? undecided, · held, nothing: does not apply. **meant** is the check meant for a mutant,",
        "**cause** whether a hint names what was done to it, by the words of",
        "`tests/mutants/causes.toml`. Samples are those of all checks together. Written by",
        "`python scripts/detection_matrix.py`, seconds by `--time`; verdicts, samples and hints",
        "are in `scripts/results/detection_matrix.json`.",
        "",
        f"{len(caught)} of {len(paths)} are refuted by the check meant for them; a hint names the",
        f"cause of {len(hinted)}.",
        *_times(rows, paths),
        "",
        f"| mutant | meant | {' | '.join(names)} | samples | seconds | what was done | cause |",
        "|---|---|" + "---|" * (len(names) + 4),
    ]
    return "\n".join([*lines, *(_line(p, rows[p.stem], names) for p in paths)]) + "\n"


def _times(rows: dict[str, Any], paths: list[Path]) -> list[str]:
    seconds = [rows[p.stem]["run"]["seconds"] for p in paths if "run" in rows[p.stem]]
    if not seconds:
        return []
    slow = sum(s > LIMIT for s in seconds)
    return [
        f"Seconds of a whole warm `brdf-check run` on a quiet machine, {len(seconds)} timed:",
        f"median {sorted(seconds)[len(seconds) // 2]:.1f}, slowest {max(seconds):.1f}, "
        f"{slow} above {LIMIT:g}.",
    ]


def _line(path: Path, row: dict[str, Any], names: list[str]) -> str:
    marks = [MARKS[row[c]["verdict"]] for c in names]
    samples = sum(row[c]["samples"] for c in names)
    seconds = f"{row['run']['seconds']:.1f}" if "run" in row else ""
    cells = [path.stem, said(path, "caught by"), *marks, f"{samples:.1e}", seconds]
    return f"| {' | '.join([*cells, said(path, 'cause'), 'yes' if named(path, row) else ''])} |"


def main() -> None:
    """Run what is missing, write after each mutant, then the table if nothing is missing."""
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*")
    parser.add_argument("--check", help="some checks only, separated by commas")
    parser.add_argument("--jobs", type=int, default=1, help="processes; 1 is used with --time")
    parser.add_argument("--time", action="store_true")
    parser.add_argument("--minutes", type=float, default=1e9)
    options = parser.parse_args()
    rows = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    chosen = [p for p in mutants() if not options.names or p.stem in options.names]
    if options.time:
        time_all(chosen, rows, 60.0 * options.minutes)
    else:
        names = options.check.split(",") if options.check else checks.names()
        examine_all(chosen, rows, names, options.jobs)
    if all(set(checks.names()) <= set(rows.get(p.stem, {})) for p in mutants()):
        TABLE.write_text(table(rows), encoding="utf-8")


def examine_all(paths: list[Path], rows: dict[str, Any], names: list[str], jobs: int) -> None:
    """Verdicts of many mutants, by several processes."""
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        waiting = {pool.submit(examined, p, rows.get(p.stem, {}), names): p for p in paths}
        for done in concurrent.futures.as_completed(waiting):
            path = waiting[done]
            rows[path.stem] = done.result()
            keep(rows, path)


def time_all(paths: list[Path], rows: dict[str, Any], seconds: float) -> None:
    """Seconds of those that are not timed yet, one after the other."""
    until = time.monotonic() + seconds
    for path in paths:
        row = rows.setdefault(path.stem, {})
        if "run" not in row and time.monotonic() < until:
            row["run"] = timed(path)
            keep(rows, path)


def keep(rows: dict[str, Any], path: Path) -> None:
    """Write what is known."""
    print(path.stem, rows[path.stem].get("run", ""), flush=True)
    RESULTS.write_text(json.dumps(rows, indent=1, sort_keys=True) + "\n")


if __name__ == "__main__":
    main()
