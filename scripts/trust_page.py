"""Writes docs/trust.md from what the studies recorded in scripts/results.

    python scripts/trust_page.py
"""
from __future__ import annotations

import collections
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "scripts" / "results"
TARGET = ROOT / "docs" / "trust.md"


def result(name: str) -> dict[str, Any]:
    """What a study recorded; empty if it was not run."""
    path = RESULTS / f"{name}.json"
    found: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {}
    return found


def table(head: str, rows: list[list[Any]]) -> Iterator[str]:
    """A Markdown table."""
    names = [n.strip() for n in head.split("|")]
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(str(c) for c in row) + " |"
    yield ""


def made(study: dict[str, Any]) -> str:
    """How a result was obtained."""
    versions = study["versions"]
    of = ", ".join(f"{k} {versions[k]}" for k in ("python", "numba", "numpy", "scipy"))
    return f"`{study['command']}`, {study['machine']}, {of}."


def false_alarms() -> Iterator[str]:
    """Pooled p-values."""
    study = result("false_alarms")
    yield "## False alarms\n"
    yield (
        f"p-values at tolerance 0 of {len(study['models'])} honest models "
        f"({', '.join(study['models'])}), each claim asked with "
        "the 2¹⁴ samples of a first look. In brackets what a Poisson count lies in with "
        f"probability 99.9 %. {made(study)}\n"
    )
    rows = []
    for name, r in study["pooled"].items():
        counts = zip(r["below 1e-3, 1e-4, 1e-5"], r["bounds"], strict=True)
        cells = [f"{c} ({lo} to {hi})" for c, (lo, hi) in counts]
        if r["p-values"]:
            rows.append([name, f"{r['p-values']:,}", *cells, "yes" if r["inside"] else "**no**"])
    yield from table("p-values of | number | < 1e-3 | < 1e-4 | < 1e-5 | inside", rows)
    yield (
        "Sixteen shifts of a lattice can have heavier tails than Student's t where one of its "
        "modes dominates: their p-values alone would refute too often. No verdict rests on them "
        "alone: "
        "`run` looks at Sobol points, and nothing fails that 64 fresh scrambles do not refute "
        "again (`confirmations`).\n"
    )


def seeds() -> Iterator[str]:
    """Verdicts over many seeds."""
    study = result("seeds")
    yield "## No false fail\n"
    yield (
        "The random claims of `brdf-check run` with default settings, decided again with other "
        f"seeds. {made(study)}\n"
    )
    rows = []
    for name, found in study["models"].items():
        totals: dict[str, int] = {}
        for r in found.values():
            for verdict, n in r["findings"].items():
                totals[verdict] = totals.get(verdict, 0) + n
        asked = ", ".join(f"{c} {r['seeds']}" for c, r in found.items())
        verdicts = [totals.get(v, 0) for v in ("pass", "known", "inconclusive", "fail")]
        rows.append([name, asked, *verdicts])
    yield from table("model | seeds per check | pass | known | inconclusive | fail", rows)


def skies() -> Iterator[str]:
    """Verdicts under narrow light."""
    study = result("skies")
    totals: dict[str, collections.Counter[str]] = {}
    for found in study["models"].values():
        for sky, r in found.items():
            name, _, rest = sky.partition(":")
            tilted = rest.count(":") == {"gradient": 0, "quadratic": 0, "linear": 2}.get(name, 1)
            kind = f"{name}, tilted" if tilted and rest else name
            totals.setdefault(kind, collections.Counter()).update(r["verdicts"])
    every = sum(totals.values(), collections.Counter())
    asked = every.total()
    yield "## Narrow light\n"
    yield (
        f"`brdf-check radiance` of {len(study['models'])} cases, all built-in models with their "
        "defaults and the first and last of their verified parameters, at "
        f"{', '.join(f'{a:g}' for a in study['angles'])} degrees, under skies from constant to a "
        "cosine to the power of 10⁷ and caps of 0.01 degrees, around the normal and tilted down to "
        f"the horizon: of {asked:,} findings {every['fail']} fail and {every['inconclusive']} "
        f"({100 * every['inconclusive'] / asked:.2g} %) are not resolved. {made(study)}\n"
    )
    verdicts = ("pass", "known", "inconclusive", "fail")
    rows = [[kind, *(found[v] for v in verdicts)] for kind, found in totals.items()]
    yield from table("sky | pass | known | not resolved | fail", rows)


def error_bars() -> Iterator[str]:
    """Coverage."""
    study = result("error_bars")
    yield "## Error bars\n"
    yield f"How often the 95 % and the 99.99 % interval hold the truth. {made(study)}\n"
    rows = []
    for r in study["honest"]:
        shares = [f"{100 * r[k]:.2f}" for k in ("95 %", "99.99 %")]
        p = r["Student's t, p"]
        size = [f"{r['runs']:,}", f"{r['relative stderr']:.0e}"]
        rows.append([r["sampler"], r["case"], r["points"], *size, *shares, f"{p:.2g}"])
    head = "sampler | case | points | runs | stderr | 95 % | 99.99 % | Student's t, p"
    yield from table(head, rows)
    yield (
        "Where a bare spread is not honest, and what becomes of it. `bare` is the coverage of the "
        "95 % and 99.99 % interval from the spread alone, `reported` that of the error bar in the "
        "report, `confirmed` that of the 64 scrambles without which nothing fails.\n"
    )
    rows = []
    for r in study["dishonest"]:
        shares = [
            f"{100 * r[k]['95 %']:.1f}, {100 * r[k]['99.99 %']:.2f}"
            for k in ("bare spread", "as reported", "confirmation")
        ]
        case = f"{r['case']}, {r['sampler']}, {r['points']}"
        rows.append([r["flaw"], case, *shares, r["not used because"] or "used"])
    yield from table("flaw | case | bare | reported | confirmed | the judge", rows)


def methods() -> Iterator[str]:
    """Coverage of charts and methods, and of adaptive estimates."""
    study = result("coverage_of_methods")
    yield "## Charts, methods and targets\n"
    yield (
        f"Coverage of the 95 % interval over {study['seeds']:,} seeds for every built-in model, "
        "verified parameter set, angle (0, 60 and 85°) and method that `auto` would try, with 256 "
        f"to 16,384 samples; below {100 * study['lowest allowed']:.1f} % it counts as too low. "
        f"{made(study)}\n"
    )
    rows = [r for found in study["cases"].values() for r in found]
    asked = [c for r in rows for c in r.get("coverage", {}).values()]
    unfit, low = sum(isinstance(c, str) for c in asked), study["low"]
    yield (
        f"Of {len(asked):,} combinations {unfit:,} are declared unfit by the tool and "
        f"{len(asked) - unfit - len(low):,} are covered; too low: {len(low)}.\n"
    )
    yield from table("case | method | coverage by samples", [_low(r) for r in low])
    worst = min(r["within"] / r["ended"] for r in rows if r.get("ended"))
    yield (
        f"Adaptive estimates to a relative 10⁻⁶: {study['adaptive asked']:,} asked, "
        f"{study['adaptive ended']:,} say that they got there, {study['adaptive within']:,} of "
        f"these are that near to the reference; at least {100 * worst:.1f} % in every case.\n"
    )


def _low(row: dict[str, Any]) -> list[str]:
    parameters = ", ".join(f"{k}={v:g}" for k, v in row["p"].items())
    found = {n: c for n, c in row.get("coverage", {}).items() if not isinstance(c, str)}
    shares = ", ".join(f"{int(n):,}: {100 * c:.1f} %" for n, c in found.items())
    return [f"{row['model']}({parameters}), {row['theta_o']:g}°", row["method"], shares]


def resolves() -> Iterator[str]:
    """How true `resolves` is."""
    study = result("resolves")
    yield "## What a finding resolves\n"
    yield (
        f"Models scaled by 1 ± `resolves` and by 1 ± half of it, refuted in how many of "
        f"{study['seeds']} seeds; at least 88 % and at most 50 % are asked. {made(study)}\n"
    )
    rows = []
    for r in study["findings"]:
        model = r["model"] + "".join(f" {k}={v:g}" for k, v in r["parameters"].items())
        n = r["refuted"]
        where = f"{r['quantity']} at {r['where'].get('theta_o_deg', '')}°"
        relative = [f"{r[k]:.2e}" for k in ("tolerance, relative", "resolves, relative")]
        both = f"{n['+1']}, {n['-1']}", f"{n['+0.5']}, {n['-0.5']}"
        rows.append([model, where, *relative, *both])
    yield from table("model | finding | tolerance | resolves | by ± resolves | by ± half", rows)
    short = sum(not r["holds"] for r in study["findings"])
    if short:
        yield f"{short} of {len(rows)} fall short.\n"


def power() -> Iterator[str]:
    """Small mistakes, and the same by Mitsuba."""
    study, other = result("power"), result("mitsuba_chi2")
    yield "## Power\n"
    yield (
        "Small mistakes in GGX (alpha 0.3, 45°), each run with a fresh seed and empty tables. "
        f"{made(study)}\n"
    )
    rows = []
    for name, r in study["subjects"].items():
        counts = ", ".join(f"{v} {k}" for k, v in r["verdicts"].items())
        times = study.get("times", {}).get(name)
        spent = f"{times['median']:.1f}" if times else "not timed"
        rows.append([name, f"{r['runs']:,}", counts, spent])
    yield from table("run | runs | verdicts | ms per run", rows)
    if other:
        yield (
            f"Mitsuba {other['versions']['mitsuba']}'s chi-square test at its defaults (10⁶ "
            f"samples, level 0.01) on the same machine. {made(other)}\n"
        )
        rows = [
            [n, r["runs"], f"{r['rejected']} rejected", f"{r['milliseconds, median']:.0f}"]
            for n, r in other["subjects"].items()
        ]
        yield from table("run | runs | verdicts | ms per run", rows)


def main() -> None:
    """Write the page."""
    lines = ["# How far verdicts can be trusted\n"]
    lines += ["Measured; every table says by which command. How verdicts come about is told in "
              "[statistics.md](statistics.md).\n"]  # fmt: skip
    parts = {
        "false_alarms": false_alarms,
        "seeds": seeds,
        "skies": skies,
        "error_bars": error_bars,
        "coverage_of_methods": methods,
        "resolves": resolves,
        "power": power,
    }
    for name, part in parts.items():
        lines += part() if result(name) else []
    TARGET.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
