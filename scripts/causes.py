"""Causes named over the corpora of wrong and of honest models: right, places only, none, false.

    python scripts/causes.py [--jobs 2] [--reports DIR] [NAME ...]

A mutant's docstring says what was done to it ("cause:"), before anybody looks at what is said of
it; tests/mutants/causes.toml says which words name that. A cause with other words counts as false,
unless tests/mutants/causes_read.toml says why it is the same: read by hand, after it was told.
DIR keeps the reports of the runs, so that after a change to `diagnosis` only that is done again.
Writes scripts/results/causes.json and docs/causes.md.
"""
from __future__ import annotations

import argparse
import concurrent.futures
import json
import re
import statistics
import time
import tomllib
from pathlib import Path
from typing import Any

import montecarlo_brdf
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.cases.look import look
from montecarlo_brdf.diagnosis import diagnose
from montecarlo_brdf.diagnosis.cause import Examined
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.report.json import read_report
from montecarlo_brdf.verify.run import ANGLES

ROOT = Path(__file__).parents[1]
TESTS = ROOT / "tests"
RESULTS = ROOT / "scripts" / "results" / "causes.json"
PAGE = ROOT / "docs" / "causes.md"
NONE, RIGHT, SAME, FALSE = "none", "right", "same", "FALSE"
READ = tomllib.loads((TESTS / "mutants" / "causes_read.toml").read_text(encoding="utf-8"))
CAUSES = tomllib.loads((TESTS / "mutants" / "causes.toml").read_text(encoding="utf-8"))
OF_F = ("positivity", "reciprocity", "isotropy", "equality", "limits")


def said(path: Path, what: str) -> str:
    """The rest of a docstring's line that starts with `what`."""
    found = re.findall(rf"^{what}: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return str(found[0]) if found else NONE


def reported(path: Path, kept: Path | None) -> Report:
    """The report of the check meant for a mutant and of those that compile nothing but f."""
    file = kept / f"{path.parent.name}-{path.stem}.json" if kept else None
    if file and file.exists():
        return read_report(file)
    names = dict.fromkeys((*OF_F, said(path, "caught by")))
    report = montecarlo_brdf.run(montecarlo_brdf.load(str(path)), names=[*names])
    if file:
        file.write_text(report.to_json(), encoding="utf-8")
    return report


def examined(path: Path, kept: Path | None) -> dict[str, Any]:
    """What is said of one model. An honest one is asked as if something had failed."""
    model = montecarlo_brdf.load(str(path))
    case = Case(model, model.parameters(), ANGLES, free=searched(model, {}))
    look(case)  # which the checks have
    if model.sample:
        _ = look(case).draws
    if path.parent.name == "honest":
        began = time.process_time()
        repair = Examined(case, []).chosen()
        told = {"cause": repair.sentence} if repair else {}
        return {"seconds": round(time.process_time() - began, 3), **told}
    found = diagnose(case, reported(path, kept).results)
    if found is None:
        return {}
    told = {"cause": found.cause.sentence} if found.cause else {}
    return {"seconds": round(found.seconds, 3), "place": found.place.check, **told}


def judged(name: str, cause: str, row: dict[str, Any]) -> str:
    """right, same, none or FALSE."""
    told = row.get("cause")
    if told is None:
        return NONE
    words = CAUSES.get(cause)
    if words and re.search(words, told):
        return RIGHT
    return SAME if told.startswith(READ.get(name, {}).get("told", "-")) else FALSE


def page(rows: dict[str, Any]) -> str:
    """The table as Markdown."""
    mutants = {k: r for k, r in rows.items() if k.startswith("mutants/")}
    honest = [r for k, r in rows.items() if k not in mutants]
    done = {k: said(TESTS / f"{k}.py", "cause") for k in mutants}
    nameable = [k for k in mutants if done[k] != NONE]
    word = {k: judged(k.split("/")[1], done[k], r) for k, r in mutants.items()}
    right = sum(word[k] == RIGHT for k in nameable)
    same = sum(word[k] == SAME for k in nameable)
    others = sum(w == SAME for w in word.values()) - same
    false = sum(w == FALSE for w in word.values())
    costs = sorted(r["seconds"] for r in mutants.values() if "seconds" in r)
    share = 100.0 * right / max(1, len(nameable))
    lines = [
        "# Causes named",
        "",
        "What is named as the cause of the known-bad BRDFs of `tests/mutants`, against what was",
        "done to them, after the check meant for each and those of f alone; and of the honest",
        "models of `tests/honest`, asked as if something had failed, which nobody does: what",
        "holds is not diagnosed. Written by `python scripts/causes.py`.",
        "",
        f"- {right} of {len(nameable)} mutants whose cause has a name are told the right one "
        f"({share:.0f} %), {same} more the same in other words, as are {others} that have no name",
        "(read by hand, with the reasons in `tests/mutants/causes_read.toml`);",
        f"- {false} of {len(mutants)} mutants are told a false one;",
        f"- {sum('cause' in r for r in honest)} of {len(honest)} honest models are told any.",
        "",
        f"A diagnosis takes {statistics.median(costs):.2f} s of a processor (median; 9 in 10",
        f"below {costs[int(0.9 * len(costs))]:.2f} s, at most {costs[-1]:.2f} s), nothing where",
        "all claims hold.",
        "",
        "| mutant | what was done | cause told | seconds |",
        "|---|---|---|---|",
    ]
    for k, r in sorted(mutants.items()):
        mark = "**FALSE** " if word[k] == FALSE else ""
        told = f"{mark}{r.get('cause', '')}".replace("|", "\\|")
        seconds = f"{r['seconds']:.2f}" if "seconds" in r else "held"
        lines.append(f"| {k.split('/')[1]} | {done[k]} | {told} | {seconds} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Examine what is asked for, or everything, then write the page."""
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--reports", type=Path)
    options = parser.parse_args()
    if options.reports:
        options.reports.mkdir(parents=True, exist_ok=True)
    paths = [p for f in ("mutants", "honest") for p in sorted((TESTS / f).glob("*.py"))]
    paths = [p for p in paths if not p.stem.startswith("test_")]
    chosen = [p for p in paths if not options.names or p.stem in options.names]
    rows = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        waiting = {pool.submit(examined, p, options.reports): p for p in chosen}
        for done in concurrent.futures.as_completed(waiting):
            path = waiting[done]
            rows[f"{path.parent.name}/{path.stem}"] = done.result()
            print(path.stem, done.result(), flush=True)
    known = {f"{p.parent.name}/{p.stem}" for p in paths}
    rows = {k: r for k, r in sorted(rows.items()) if k in known}
    RESULTS.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    if set(rows) == known:
        PAGE.write_text(page(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
