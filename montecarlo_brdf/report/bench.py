"""A benchmark of methods in words and as a picture: pure functions of its plain data."""
from __future__ import annotations

import json
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.report.columns import Column, Row
from montecarlo_brdf.report.columns import table as columns_of
from montecarlo_brdf.report.pictures.style import COLOURS
from montecarlo_brdf.report.text import called

#: A line and a marker for each point set, and for "auto"; colours stand for samplers.
STYLES = {"independent": ":o", "stratified": "-.s", "sobol": "--^", "lattice": "-D", "": "-*"}
#: after the method
NUMBERS = (
    Column("samples", fold=2, right=True), Column("error", fold=3, right=True),
    Column("seconds", right=True), Column("ns/sample", fold=1, right=True),
)  # fmt: skip


NEEDED = ("model", "params", "where", "methods", "timings", "reference", "targets", "seeds")


def read(path: Path) -> dict[str, Any] | None:
    """The data of a benchmark in a JSON file; None if it is no file of one."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    if not isinstance(data, dict) or data.get("command") != "bench":
        return None
    if missing := [name for name in NEEDED if name not in data]:
        raise UserError(f"{path} is damaged: it has no {', '.join(missing)}")
    return data


def table(data: dict[str, Any], width: int = 80) -> str:
    """For each target what every method needs, fastest first; then the methods that miss it."""
    lines = [title(data), *_said(data)]
    for target, rows in data["targets"].items():
        columns = (Column(f"to {target}"), *NUMBERS)
        cells = [_row(row, "* " if k == 0 else "  ") for k, row in enumerate(rows)]
        lines += ["", *columns_of(columns, cells, width)] if rows else ["", f"to {target}"]
        lines += [f"  {method:<27} {_late(data)}" for method in _missed(data, rows)]
    return "\n".join([*lines, "", "* fastest"]) + "\n"


def page(data: dict[str, Any], repeat: str = "") -> str:
    """The same with its picture as a page; repeat: the command line, if it is known."""
    from montecarlo_brdf.report import html
    from montecarlo_brdf.report.pictures import encoded, inline

    parts = []
    for k, (target, rows) in enumerate(data["targets"].items()):
        name = f"to an error of {target}"
        cells = [("", list(_row(row))) for row in rows]
        shown = html.Table(name, [Column("method"), *NUMBERS], cells, 0)
        notes = [f"{method}: {_late(data)}" for method in _missed(data, rows)]
        parts.append(html.Part(f"part-{k}", name, "", shown, notes=notes))
    if parts:
        caption = "Relative error against processor time, a line for each method"
        drawn = inline.svg(encoded(figure(data), "svg"))
        parts[0] = parts[0]._replace(picture=drawn, caption=caption)
    settings = {name: data[name] for name in ("seconds", "seeds")}
    facts = html.facts({**settings, **data.get("versions", {})})
    first, second = _said(data)
    chapter = html.Chapter("bench", "", first, second, parts, facts, repeat)
    return html.filled(f"bench: {' '.join(title(data).split())}", "", [chapter])


def _said(data: dict[str, Any]) -> tuple[str, str]:
    """What errors are held against, and what they and times are."""
    known = data["reference"]
    return (
        f"A = {known['value']:.10g} ({known['kind']}, to {known['relative_error']:.0e})",
        f"Relative errors: root mean square of {data['seeds']} seeds. Times: of the processor.",
    )


def _missed(data: dict[str, Any], rows: Sequence[dict[str, Any]]) -> list[str]:
    reached = {row["method"] for row in rows}
    return [method for method in data["methods"] if method not in reached]


def _late(data: dict[str, Any]) -> str:
    return f"not within {data['seconds']:g} s"


def _row(row: dict[str, Any], mark: str = "") -> Row:
    each = 1e9 * row["seconds"] / row["samples"]
    return (
        f"{mark}{row['method']}", str(row["samples"]), f"{row['error']:.1e}",
        f"{row['seconds']:.2g}", f"{each:.3g}",
    )  # fmt: skip


def title(data: dict[str, Any]) -> str:
    """'ggx(alpha=0.3) at 60°', on several lines if it is long."""
    angles = ", ".join(f"{angle:g}°" for angle in data["where"].values())
    return textwrap.fill(f"{called(data['model'], data['params'])} at {angles}", 60)


def figure(data: dict[str, Any]) -> Any:
    """Relative error against processor seconds, one line per method; what is exact at 1e-17."""
    from matplotlib.figure import Figure

    drawn = Figure(figsize=(9.0, 5.5), layout="constrained")
    axes = drawn.subplots()
    axes.set(xscale="log", yscale="log", ylabel="relative error", title=title(data))
    axes.set_xlabel("processor time of one estimate (s)")
    axes.tick_params(which="minor", labelsize=6)  # larger ones overlap
    samplers = [*dict.fromkeys(m.partition(" x ")[0] for m in data["methods"] if " x " in m)]
    for method in data["methods"]:
        sampler, _, points = method.partition(" x ")
        colour = COLOURS[samplers.index(sampler)] if points else "black"
        rows = [t for t in data["timings"] if t["method"] == method]
        times, errors = [t["seconds"] for t in rows], [max(t["error"], 1e-17) for t in rows]
        axes.plot(times, errors, STYLES[points], color=colour, label=method,
                  markersize=4 if points else 9, linewidth=1.2 if points else 2.0)  # fmt: skip
    axes.axhline(data["reference"]["relative_error"], color="0.5", label="error of the known value")
    axes.grid(alpha=0.25)
    drawn.legend(loc="outside right upper", fontsize=8)
    return drawn
