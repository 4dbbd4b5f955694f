"""Detection matrix: every known-bad BRDF of tests/mutants against every check, at default settings.

    python scripts/detection_matrix.py [NAME ...]

Resumable: what scripts/results/detection_matrix.json holds of unchanged files and the same version
is not run again. Every mutant runs twice: once with few samples to compile, then timed. Writes the
table docs/detection_matrix.md. A mutant's docstring says which check is meant for it ("caught by:")
and, where a hint can name its cause, words of that hint ("named by:").
"""
from __future__ import annotations

import hashlib
import json
import re
import sys
import time
from pathlib import Path
from typing import Any

import montecarlo_brdf
from montecarlo_brdf import checks

ROOT = Path(__file__).parents[1]
MUTANTS = ROOT / "tests" / "mutants"
RESULTS = ROOT / "scripts" / "results" / "detection_matrix.json"
TABLE = ROOT / "docs" / "detection_matrix.md"
WARM = 1 << 12  # samples of the run that compiles
MARKS = {"fail": "**x**", "inconclusive": "?", "pass": "·", "skipped": " "}


def sources() -> str:
    """A digest of the checks, so that a change of any of them runs everything again."""
    digest = hashlib.sha256()
    for path in sorted((ROOT / "montecarlo_brdf").rglob("checks/*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def said(path: Path, what: str) -> str:
    """The rest of a docstring's line that starts with `what`."""
    found = re.findall(rf"^{what}: (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[0] if found else ""


def examined(path: Path) -> dict[str, Any]:
    """What every check says of a mutant, with samples and seconds."""
    model = montecarlo_brdf.load(str(path))
    montecarlo_brdf.run(model, samples=WARM)
    row: dict[str, Any] = {"caught_by": said(path, "caught by"), "checks": {}}
    for name in checks.names():
        start = time.perf_counter()
        report = montecarlo_brdf.run(model, names=[name])
        findings = [f for r in report.results for f in r.findings]
        row["checks"][name] = {**summary(findings), "seconds": time.perf_counter() - start}
    hints = [h for c in row["checks"].values() for h in c["hints"]]
    named = said(path, "named by")
    row["hint"] = next((h for h in hints if named and named in h), None)
    return row


def summary(findings: list[Any]) -> dict[str, Any]:
    """The worst verdict of a check, its samples, and the hints of what it refutes."""
    verdicts = [f.verdict for f in findings]
    worst = next((v for v in MARKS if v in verdicts), "skipped")
    refuted = [f for f in findings if f.verdict == "fail"]
    return {
        "verdict": worst,
        "samples": sum(f.samples or 0 for f in findings),
        "hints": list(dict.fromkeys(f.hint for f in refuted if f.hint)),
    }


def table(rows: dict[str, Any]) -> str:
    """The results as Markdown."""
    names = checks.names()
    caught = [n for n, r in rows.items() if r["checks"][r["caught_by"]]["verdict"] == "fail"]
    hinted = [n for n, r in rows.items() if r["hint"]]
    slowest = max(sum(c["seconds"] for c in r["checks"].values()) for r in rows.values())
    lines = [
        "# Detection matrix",
        "",
        "Known-bad BRDFs (`tests/mutants`) against all checks at default settings. **x** refuted,",
        "? undecided, · held; the check meant for a mutant stands in its second column.",
        "Written by `python scripts/detection_matrix.py`; values, samples and hints are in",
        "`scripts/results/detection_matrix.json`.",
        "",
        f"{len(caught)} of {len(rows)} are refuted by the check meant for them,",
        f"{len(hinted)} with a hint that names the cause.",
        f"Slowest, all checks, measured on the machine of this run: {slowest:.1f} s.",
        "",
        "| mutant | meant | " + " | ".join(names) + " | cause named |",
        "|---|---|" + "---|" * (len(names) + 1),
    ]
    for n, r in rows.items():
        marks = [MARKS[r["checks"][c]["verdict"]] for c in names]
        said_so = "yes" if r["hint"] else ""
        lines.append(f"| {n} | {r['caught_by']} | " + " | ".join([*marks, said_so]) + " |")
    return "\n".join(lines) + "\n"


def main(chosen: list[str]) -> None:
    """Run what is missing, one mutant after the other, and write after each."""
    known = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    version, rows = sources(), {}
    for path in sorted(p for p in MUTANTS.glob("*.py") if not p.stem.startswith("test_")):
        key = hashlib.sha256(path.read_bytes()).hexdigest()[:12] + version
        old = known.get(path.stem)
        missing = not old or (old["key"] != key and (not chosen or path.stem in chosen))
        rows[path.stem] = {"key": key, **examined(path)} if missing else old
        print(path.stem, "examined" if missing else "known", flush=True)
        RESULTS.parent.mkdir(exist_ok=True)
        RESULTS.write_text(json.dumps({**known, **rows}, indent=1, sort_keys=True) + "\n")
    TABLE.write_text(table(rows), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
