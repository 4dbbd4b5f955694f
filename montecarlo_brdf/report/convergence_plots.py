"""Pictures of convergence reports: error against samples, one panel per sampler."""
from __future__ import annotations

import math
from typing import Any

#: Okabe and Ito's colours and a marker of its own for each point set
STYLES = {
    "independent": ("#000000", "o"),
    "stratified": ("#E69F00", "s"),
    "sobol": ("#0072B2", "^"),
    "lattice": ("#D55E00", "D"),
}
GUIDES = (-0.5, -1.0, -2.0)
SMALLEST = 1e-16  # an exact estimate has no place on a log axis
ROOM = 0.4  # of the decades above the reference's error, below it for the legend


def convergence_figure(report: dict[str, Any]) -> Any:
    """Relative error against samples per randomisation, for the first parameter set."""
    from matplotlib.figure import Figure

    result = report["results"][0]
    findings = [f for f in result["findings"] if f.get("estimators")]
    samplers = list(dict.fromkeys(f["where"]["sampler"] for f in findings))
    columns = min(2, max(1, len(samplers)))
    rows = max(1, math.ceil(len(samplers) / columns))
    figure = Figure(figsize=(4.2 * columns + 0.6, 3.6 * rows + 0.6), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, sampler in zip(panels.flat, samplers, strict=False):
        _panel(axes, [f for f in findings if f["where"]["sampler"] == sampler], sampler)
    for axes in list(panels.flat)[len(samplers) :]:
        axes.set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel("samples per randomisation N")
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error of A")
    figure.suptitle(_title(result, report), fontsize=10)
    return figure


def _title(result: dict[str, Any], report: dict[str, Any]) -> str:
    shown = {k: f"{v:.4g}" if isinstance(v, float) else v for k, v in result["params"].items()}
    values = ", ".join(f"{k}={v}" for k, v in shown.items())
    theta = report["settings"]["theta_o_deg"]
    return f"convergence: {result['model']}({values}) at {theta:g}°, {report['verdict']}"


def _panel(axes: Any, findings: list[dict[str, Any]], sampler: str) -> None:
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    for finding in findings:
        _curve(axes, finding)
    _guides(axes, findings)
    floor = max(f["reference"]["error"] for f in findings)
    dashes = (0, (4, 3))
    axes.axhline(floor, color="0.4", linewidth=0.8, linestyle=dashes, label="reference's error")
    axes.set_title(sampler.replace("_", "-"), fontsize=10)
    axes.grid(alpha=0.25)
    low, high = axes.get_ylim()  # panels share it: room for the legend, made once
    axes.set_ylim(min(low, floor * (floor / high) ** ROOM), high)
    axes.legend(fontsize=7, loc="lower left")


def _curve(axes: Any, finding: dict[str, Any]) -> None:
    colour, marker = STYLES[finding["where"]["points"]]
    levels = finding["estimators"]
    for level in levels:
        each = [max(e, SMALLEST) for e in level["randomisations"]]
        axes.plot([level["samples"]] * len(each), each, ".", color=colour, alpha=0.12, markersize=3)
    slope = finding.get("value")
    fitted = isinstance(slope, float) and math.isfinite(slope)
    label = finding["where"]["points"] + (f", slope {slope:.2f}" if fitted else "")
    axes.plot([v["samples"] for v in levels], [max(v["value"], SMALLEST) for v in levels],
              color=colour, marker=marker, markersize=4, linewidth=1.2, label=label)  # fmt: skip


def _guides(axes: Any, findings: list[dict[str, Any]]) -> None:
    """Thin lines of known slope from the first error of the panel, each with its name."""
    samples = sorted({v["samples"] for f in findings for v in f["estimators"]})
    first = max(f["estimators"][0]["value"] for f in findings)
    for slope in GUIDES:
        errors = [3.0 * first * (n / samples[0]) ** slope for n in (samples[0], samples[-1])]
        axes.plot([samples[0], samples[-1]], errors, color="0.6", linewidth=0.7, zorder=0)
        axes.annotate(f"$N^{{{slope:g}}}$", (samples[-1], errors[1]), fontsize=8, color="0.3",
                      ha="right", va="bottom")  # fmt: skip
