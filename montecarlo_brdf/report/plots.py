"""Pictures of reports: pure functions of the plain data, so they can be drawn again at any time."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.files import write_bytes
from montecarlo_brdf.report.convergence_plots import convergence_figure
from montecarlo_brdf.report.scene_plots import radiance_figure

KINDS = ("png", "svg", "pdf")
#: Okabe and Ito's colours: told apart by everyone. One per parameter set or channel.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
MOST_SERIES = len(COLOURS)


def plot(report: dict[str, Any], path: Path) -> None:
    """Draw a report into a PNG, SVG or PDF file."""
    kind_of(path)
    if report.get("command") not in FIGURES:
        raise UserError(f"there is no picture for a report of {report.get('command')!r}")
    import matplotlib

    matplotlib.use("Agg")
    try:
        figure = FIGURES[report["command"]](report)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        raise UserError(f"the report cannot be drawn: {type(error).__name__} {error}") from error
    save(figure, path)


def save(figure: Any, path: Path) -> None:
    """Write a figure: equal figures give equal files."""
    import matplotlib

    kind = kind_of(path)
    content = io.BytesIO()
    # a fixed hash salt and no date
    with matplotlib.rc_context({"svg.hashsalt": "montecarlo_brdf"}):
        figure.savefig(
            content, format=kind, dpi=150, metadata={"Date": None} if kind == "svg" else {}
        )
    write_bytes(path, content.getvalue())


def kind_of(path: Path) -> str:
    """ "png", "svg" or "pdf", or a UserError."""
    kind = path.suffix.lstrip(".").lower()
    if kind not in KINDS:
        raise UserError(f"cannot draw {path}: the name must end in .png, .svg or .pdf")
    return kind


def albedo_figure(report: dict[str, Any]) -> Any:
    """Albedo against angle with its error band and reference; below it the error on a log scale."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    shown = series(report)[:MOST_SERIES]
    for k, one in enumerate(shown):
        _albedo(top, one, COLOURS[k], MARKERS[k])
        _error(bottom, one, COLOURS[k], MARKERS[k])
    top.axhline(1.0, color="0.4", linewidth=0.8, linestyle=(0, (1, 2)))
    top.set_ylabel("directional albedo A")
    top.set_ylim(0.0, 1.08 * max(1.0, top.dataLim.y1))
    top.set_title(_title(report, len(shown)), fontsize=10)
    if 0.0 < bottom.dataLim.y1 < math.inf:  # else nothing but NaN is drawn
        bottom.set_yscale("log")
    bottom.set_ylabel("|A - reference|")
    bottom.set_xlabel("angle of the viewer theta_o (degrees)")
    bottom.set_xlim(-2.0, 92.0)
    for axes in (top, bottom):
        axes.grid(alpha=0.25)
    _explain(figure, (top, bottom))
    return figure


def _explain(figure: Any, panels: Any) -> None:
    """One legend below the panels, where it hides nothing; every line style named once."""
    named: dict[str, Any] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    figure.legend(named.values(), named.keys(), loc="outside lower center", ncols=3, fontsize=8)


def series(report: dict[str, Any]) -> list[dict[str, Any]]:
    """One series per parameter set and channel: label, findings of A, reference curve."""
    found = []
    for result in report["results"]:
        findings = [f for f in result["findings"] if f["quantity"] == "A"]
        for channel in sorted({f["where"].get("channel", 0) for f in findings}):
            rows = [f for f in findings if f["where"].get("channel", 0) == channel]
            label = _label(result, channel if any("channel" in f["where"] for f in rows) else None)
            curves = result.get("curves") or []
            curve = curves[channel] if channel < len(curves) else None
            found.append({"label": label, "findings": rows, "curve": curve})
    return found


def _label(result: dict[str, Any], channel: int | None) -> str:
    values = {
        k: v[channel] if isinstance(v, list) and channel is not None else v
        for k, v in result["params"].items()
    }
    return ", ".join(
        f"{k}={v:.4g}" if isinstance(v, float) else f"{k}={v}" for k, v in values.items()
    )


def _title(report: dict[str, Any], shown: int) -> str:
    models = ", ".join(dict.fromkeys(r["model"] for r in report["results"]))
    total = len(series(report))
    more = f" ({shown} of {total} parameter sets)" if total > shown else ""
    return f"white furnace: {models}{more}, verdict {report['verdict']}"


def _albedo(axes: Any, one: dict[str, Any], colour: str, marker: str) -> None:
    rows = [f for f in one["findings"] if f.get("value") is not None]
    theta = [f["where"]["theta_o_deg"] for f in rows]
    errors = [3.0 * (f.get("stderr") or 0.0) for f in rows]
    values = [f["value"] for f in rows]
    low = [v - e for v, e in zip(values, errors, strict=False)]
    high = [v + e for v, e in zip(values, errors, strict=False)]
    axes.fill_between(theta, low, high, color=colour, alpha=0.2, linewidth=0)
    axes.errorbar(theta, values, errors, fmt=marker, color=colour, markersize=4, capsize=2,
                  label=f"{one['label'] or 'estimate'} (+- 3 stderr)")  # fmt: skip
    curve = one["curve"] or [
        (f["where"]["theta_o_deg"], f["expected"]) for f in rows if "expected" in f
    ]
    if curve:
        axes.plot(
            *zip(*curve, strict=False), color=colour, linewidth=1.0, label="line above: reference"
        )


def _error(axes: Any, one: dict[str, Any], colour: str, marker: str) -> None:
    rows = [f for f in one["findings"] if "expected" in f and f.get("value") is not None]
    theta = [f["where"]["theta_o_deg"] for f in rows]
    floor = 1e-17  # an exact estimate has no place on a log axis
    errors = [max(abs(f["value"] - f["expected"]), floor) for f in rows]
    axes.plot(theta, errors, marker, color=colour, markersize=4, label="marker below: error")
    axes.plot(theta, [max(f["stderr"], floor) for f in rows], color=colour, linewidth=1.0,
              label="line below: stderr")  # fmt: skip
    axes.plot(theta, [f["tolerance"] for f in rows], color=colour, linewidth=0.8,
              linestyle=(0, (4, 3)), label="dashed: tolerance")  # fmt: skip


def stress_figure(report: dict[str, Any]) -> Any:
    """Heat maps of the error over angle and roughness."""
    from matplotlib.figure import Figure

    from montecarlo_brdf.report import heat

    figure = Figure(figsize=(12.0, 6.5), layout="constrained")
    heat.draw(report, figure)
    return figure


#: What is drawn of the report of each command.
FIGURES = {
    "converge": convergence_figure,
    "furnace": albedo_figure,
    "radiance": radiance_figure,
    "stress": stress_figure,
}
