"""Pictures of radiance reports: L_o against angle with its error bars and what it must be."""

from __future__ import annotations

from typing import Any

CHANNELS = ("#D55E00", "#009E73", "#0072B2", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MOST_SERIES = len(CHANNELS)
KEY = "L_o +- 3 stderr,\nline: truth"
FLOOR = 1e-17  # an exact value has no place on a log axis


def radiance_figure(report: dict[str, Any]) -> Any:
    """L_o above, its error on a log scale below."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 6.0), layout="constrained")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    shown = list(series(report["results"][0]["findings"]).items())
    single = len(shown) == 1
    for k, (label, rows) in enumerate(shown[:MOST_SERIES]):
        _draw(top, bottom, rows, label, "#0072B2" if single else CHANNELS[k])
    more = f" ({MOST_SERIES} of {len(shown)} series)" if len(shown) > MOST_SERIES else ""
    top.set_title(
        f"{report['results'][0]['model']}{more}, verdict {report['verdict']}", fontsize=10
    )
    top.set_ylabel("L_o in the unit of the light's radiance")
    top.set_ylim(0.0, _headroom([f["value"] for _, rows in shown[:MOST_SERIES] for f in rows]))
    bottom.set_yscale("log")
    bottom.set_ylabel("|L_o - truth|")
    bottom.set_xlabel("angle of the viewer theta_o (degrees)")
    bottom.set_title(f"points: error (0 is drawn at {FLOOR:g}), lines: stderr", fontsize=9)
    for axes in (top, bottom):
        axes.grid(alpha=0.25)
    # beside the panel: inside it a legend hides points, and below it needs none
    top.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0), title=KEY, title_fontsize=8)
    return figure


def _headroom(values: list[float]) -> float:
    """The end of an axis from 0: left to itself it puts equal values on its very edge."""
    return 1.08 * max([0.0, *values]) or 1.0


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
        label=label,
    )
    top.plot(theta, [f["expected"] for f in rows], color=colour, linewidth=1.0)
    errors = [max(abs(f["value"] - f["expected"]), FLOOR) for f in rows]
    bottom.plot(theta, errors, "o", markersize=4, color=colour)
    bars = [max(f.get("stderr") or 0.0, FLOOR) for f in rows]
    bottom.plot(theta, bars, color=colour, linewidth=1.0)
