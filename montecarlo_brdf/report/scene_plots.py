"""Pictures of radiance reports: L_o against angle with its error bars and what it must be."""

from __future__ import annotations

from typing import Any

CHANNELS = ("#D55E00", "#009E73", "#0072B2", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MOST_SERIES = len(CHANNELS)


def radiance_figure(report: dict[str, Any]) -> Any:
    """L_o above, its error on a log scale below."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    shown = list(series(report["results"][0]["findings"]).items())
    single = len(shown) == 1
    for k, (label, rows) in enumerate(shown[:MOST_SERIES]):
        _draw(top, bottom, rows, label, "#0072B2" if single else CHANNELS[k])
    more = f" ({MOST_SERIES} of {len(shown)} series)" if len(shown) > MOST_SERIES else ""
    top.set_title(
        f"{report['results'][0]['model']}{more}, verdict {report['verdict']}", fontsize=10
    )
    top.set_ylabel("reflected radiance L_o (line: truth)")
    top.set_ylim(bottom=0.0)
    bottom.set_yscale("log")
    bottom.set_ylabel("|L_o - truth|")
    bottom.set_xlabel("angle of the viewer theta_o (degrees)")
    for axes in (top, bottom):
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8, loc="best")
    return figure


def series(findings: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Findings of L_o by channel or wavelength and azimuth."""
    found: dict[str, list[dict[str, Any]]] = {}
    for f in findings:
        if f["quantity"] == "L_o" and f.get("value") is not None:
            where = {k: v for k, v in f["where"].items() if k != "theta_o_deg"}
            name = ", ".join(f"{k.removesuffix('_deg')} {v:g}" for k, v in where.items())
            found.setdefault(name or "estimate", []).append(f)
    return {k: sorted(v, key=lambda f: f["where"]["theta_o_deg"]) for k, v in found.items()}


def _draw(top: Any, bottom: Any, rows: list[dict[str, Any]], label: str, colour: str) -> None:
    theta = [f["where"]["theta_o_deg"] for f in rows]
    bars = [3.0 * (f.get("stderr") or 0.0) for f in rows]
    top.errorbar(
        theta,
        [f["value"] for f in rows],
        bars,
        fmt="o",
        markersize=4,
        capsize=2,
        color=colour,
        label=f"{label} (+- 3 stderr)",
    )
    top.plot(theta, [f["expected"] for f in rows], color=colour, linewidth=1.0)
    floor = 1e-17  # an exact value has no place on a log axis
    errors = [max(abs(f["value"] - f["expected"]), floor) for f in rows]
    bottom.plot(theta, errors, "o", markersize=4, color=colour, label=f"{label}: error")
    bottom.plot(
        theta,
        [max(f.get("stderr") or 0.0, floor) for f in rows],
        color=colour,
        linewidth=1.0,
        label="stderr",
    )
