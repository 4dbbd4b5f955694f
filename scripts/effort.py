"""What is caught at which effort, and in what processor time: mutants by the check meant for each.

    python scripts/effort.py [--efforts 0.01,0.03,0.1,1] [NAME ...]   those not measured yet
    python scripts/effort.py --table                                  for docs/statistics.md

A mutant's claims are decided one by one until one of them is refuted, as tests/mutants does it. Its
kernels are compiled before, at the first effort asked, and timed apart: that is most of the time.
Resumable: scripts/results/effort.json holds what is known; delete it after a change of a check.
"""
from __future__ import annotations

import argparse
import json
import os
import re
import tempfile
import time
from pathlib import Path
from typing import Any

import montecarlo_brdf
from montecarlo_brdf import checks
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.verify.run import ANGLES as RUN_ANGLES
from montecarlo_brdf.verify.run import SAMPLES

ROOT = Path(__file__).parents[1]
MUTANTS = ROOT / "tests" / "mutants"
RESULTS = ROOT / "scripts" / "results" / "effort.json"
EFFORTS = (0.01, 0.03, 0.1, 1.0)


def meant(path: Path) -> str:
    """The check that a mutant's docstring names; "" where it is no mutant."""
    found = re.search(r"^caught by: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else ""


def refuted(path: Path, effort: float) -> bool:
    """Whether a claim of the check meant for a mutant fails at an effort."""
    model = montecarlo_brdf.load(str(path))
    p = model.parameters()
    case = Case(model, p, RUN_ANGLES, free=searched(model, {}), effort=effort)
    plan = Plan(samples=SAMPLES, effort=effort)
    return any(decide(c, plan).verdict == "fail" for c in checks.find(meant(path)).claims(case))


def measured(path: Path, efforts: list[float]) -> dict[str, Any]:
    """Processor seconds of compilation, and by effort of everything else with the verdict."""
    row: dict[str, Any] = {"check": meant(path)}
    began = time.process_time()
    refuted(path, efforts[0])
    first = time.process_time() - began
    for effort in efforts:
        began = time.process_time()
        caught = refuted(path, effort)
        row[f"{effort:g}"] = [caught, round(time.process_time() - began, 3)]
    row["compile"] = round(max(0.0, first - row[f"{efforts[0]:g}"][1]), 2)
    return row


def table(rows: dict[str, Any], efforts: list[float]) -> str:
    """Caught mutants and processor time by check and effort, as Markdown."""
    names = [f"{e:g}" for e in efforts]
    lines = [
        f"| check | mutants | compiling | {' | '.join(f'effort {n}' for n in names)} |",
        "|---|---|---|" + "---|" * len(names),
    ]
    for check in [*checks.names(), "all"]:
        some = [r for r in rows.values() if check in (r["check"], "all")]
        cells = [_cell([r[n] for r in some]) for n in names]
        compiling = sum(r["compile"] for r in some)
        lines.append(f"| {check} | {len(some)} | {compiling:.1f} s | {' | '.join(cells)} |")
    for n in names:
        missed = sorted(stem for stem, r in rows.items() if not r[n][0])
        lines.append(f"\nNot caught at effort {n}: {', '.join(missed) or 'none'}.")
    return "\n".join(lines)


def _cell(found: list[tuple[bool, float]]) -> str:
    return f"{sum(c for c, _ in found)} in {sum(s for _, s in found):.1f} s"


def main() -> None:
    """Measure what is missing, or print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--efforts", default=",".join(f"{e:g}" for e in EFFORTS))
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    efforts = [float(e) for e in options.efforts.split(",")]
    rows = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if options.table:
        print(table(rows, efforts))
        return
    with tempfile.TemporaryDirectory() as folder:
        os.environ["BRDF_CHECK_CACHE_DIR"] = folder
        for path in sorted(MUTANTS.glob("*.py")):
            asked = not options.names or path.stem in options.names
            if asked and meant(path) and path.stem not in rows:
                rows[path.stem] = measured(path, efforts)
                print(path.stem, rows[path.stem], flush=True)
                lines = (f"{json.dumps(k)}: {json.dumps(rows[k])}" for k in sorted(rows))
                RESULTS.write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    main()
