"""A benchmark as tables of markdown."""
from __future__ import annotations

from typing import Any


def markdown(data: dict[str, Any]) -> str:
    """All tables of one benchmark."""
    lines = [f"# Run time against error\n\n{data['machine']}; {data['versions']}\n"]
    lines.append(
        "Lowest to highest median processor time; in brackets the quartiles over "
        f"{data['rounds']} rounds in turn. Errors are true errors.\n"
    )
    for result in data["results"]:
        lines.append(f"## {result['workload']}: {result['title']}\n")
        for target, rows in result["targets"].items():
            lines += _table(target, rows)
    if data.get("rates"):
        lines += _rates(data["rates"])
    if data.get("growth"):
        lines += _growth(data["growth"])
    return "\n".join(lines) + "\n"


def _table(target: str, rows: list[dict[str, Any]]) -> list[str]:
    lines = [f"Relative error {target}:\n"]
    lines += ["| method | setting | time | ratio |", "|---|---|---|---|"]
    for row in rows:
        low, median, high = (_seconds(s) for s in row["seconds"])
        ratio = "{1:.3g} [{0:.3g}, {2:.3g}]".format(*row["ratio"]) if "ratio" in row else ""
        lines.append(f"| {row['method']} | {row['setting']} | {median} [{low}, {high}] | {ratio} |")
    return [*lines, ""]


def _rates(rows: list[dict[str, Any]]) -> list[str]:
    lines = ["## Time per sample\n"]
    lines += ["| what | ns per sample | ratio to calibration |", "|---|---|---|"]
    for row in rows:
        ns, ratio = row["ns_per_sample"], row["ratio_to_calibration"]
        spread = f"{ratio[1]:.2f} [{ratio[0]:.2f}, {ratio[2]:.2f}]"
        lines.append(f"| {row['what']} | {ns[1]:.2f} | {spread} |")
    return [*lines, ""]


def _growth(series: dict[str, list[tuple[int, float]]]) -> list[str]:
    lines = ["## Growth of cost\n", "| against | count: time |", "|---|---|"]
    for name, points in series.items():
        lines.append(f"| {name} | " + ", ".join(f"{n}: {_seconds(s)}" for n, s in points) + " |")
    return [*lines, ""]


def _seconds(seconds: float) -> str:
    if seconds < 1e-3:
        return f"{1e6 * seconds:.3g} µs"
    return f"{1e3 * seconds:.3g} ms" if seconds < 1.0 else f"{seconds:.3g} s"
