"""Analytic fits that renderers use, transcribed from where they were published, and what
`brdf-check table` certifies of them.

    python scripts/published_fits.py        # scripts/results/published_fits.json, docs/figures
    brdf-check table ggx --axis mu=0:1:64 --axis alpha=0:1:64 --quantity split-sum \\
        --against scripts/published_fits.py:materialx
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
TARGET = ROOT / "scripts" / "results" / "published_fits.json"
FIGURES = ROOT / "docs" / "figures"


def karis(mu: float, roughness: float) -> tuple[float, float]:
    """(scale, bias): Karis 2014, "Physically based shading on mobile", Unreal Engine blog, after
    Lazarov 2013, "Getting more physical in Call of Duty: Black Ops II", SIGGRAPH course."""
    x, y, z, w = (1.0 - roughness, 0.0425 - 0.0275 * roughness, 1.04 - 0.572 * roughness,
                  -0.04 + 0.022 * roughness)  # fmt: skip
    a004 = min(x * x, 2.0 ** (-9.28 * mu)) * x + y
    return z - 1.04 * a004, w + 1.04 * a004


#: numerator and denominator of scale and of bias: factors of 1, x, y, xy, xx, yy, xxy, xyy, xxyy
MATERIALX = (
    ((0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448),
     (1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37)),
    ((0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286),
     (1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1)),
)  # fmt: skip


def _dot(factors: tuple[float, ...], powers: tuple[float, ...]) -> float:
    return sum(f * x for f, x in zip(factors, powers, strict=True))


def materialx(mu: float, alpha: float) -> tuple[float, float]:
    """(scale, bias) with F90 = 1, as A = F0 a + F90 b: the rational quadratic fit of MaterialX
    1.38, "GGX directional albedo", pbrlib (Academy Software Foundation, 2021)."""
    x, y = mu, alpha
    powers = (1.0, x, y, x * y, x * x, y * y, x * x * y, x * y * y, x * x * y * y)
    a, b = (_dot(top, powers) / _dot(bottom, powers) for top, bottom in MATERIALX)
    return min(max(a, 0.0), 1.0), min(max(b, 0.0), 1.0)


def fon(mu: float, roughness: float) -> float:
    """E of white FON: Portsmouth, Kutz & Hill 2025, "EON: a practical energy-preserving rough
    diffuse BRDF", JCGT 14(1), listing 1."""
    c = 1.0 - mu
    g = c * (0.0571085289 + c * (0.491881867 + c * (-0.332181442 + c * 0.0714429953)))
    return (1.0 + roughness * g) / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


#: fit -> model, quantities, axes, parameters, formulas
CASES: dict[str, tuple[str, list[str], list[tuple[str, int]], dict[str, Any], dict[str, str]]] = {
    "karis": ("schlick_ggx", ["split-sum"], [("mu", 64), ("roughness", 64)], {},
              {"alpha": "max(roughness^2, 1e-4)"}),
    "materialx": ("ggx", ["split-sum"], [("mu", 64), ("alpha", 64)], {}, {}),
    "fon": ("fon", ["albedo"], [("mu", 64), ("roughness", 64)], {"albedo": 1.0}, {}),
}  # fmt: skip
PICKS = {"karis": {"k": "ibl"}}


def certified(name: str) -> dict[str, Any]:
    """What is said of a fit, and its picture."""
    import montecarlo_brdf as mb
    from montecarlo_brdf.report.pictures import drawn
    from montecarlo_brdf.table.axes import Axis
    from montecarlo_brdf.verify.table import Wish, table

    model, quantities, axes, fixed, formulas = CASES[name]
    wish = Wish(1e-5, fresh_places=4096, against=f"{Path(__file__).as_posix()}:{name}", curve=True)
    answer = table(mb.load(model, **PICKS.get(name, {})), [Axis(n, 0.0, 1.0, k) for n, k in axes],
                   quantities, fixed=fixed, formulas=formulas, wish=wish)  # fmt: skip
    (FIGURES / f"table_fit_{name}.png").write_bytes(drawn(answer.report, "png"))
    found = answer.report.results[-1].findings
    return {"model": model, "rows": [
        {"quantity": f.quantity, "worst": f.value, "certificate": f.stderr, "where": f.where,
         "note": f.note} for f in found
    ]}  # fmt: skip


def split_sum() -> None:
    """The picture of a table, with a polynomial in its place."""
    import montecarlo_brdf as mb
    from montecarlo_brdf.report.pictures import drawn
    from montecarlo_brdf.table.axes import Axis
    from montecarlo_brdf.verify.table import Wish, table

    axes = [Axis("mu", 0.0, 1.0, 64), Axis("alpha", 0.0, 1.0, 64)]
    wish = Wish(1e-6, fit="polynomial:6", curve=True)
    answer = table(mb.load("ggx"), axes, ["split-sum"], wish=wish)
    (FIGURES / "table_split_sum.png").write_bytes(drawn(answer.report, "png"))


def main() -> None:
    """All of them."""
    from environment import describe

    split_sum()
    rows = {name: certified(name) for name in CASES}
    TARGET.write_text(json.dumps({**describe(), "fits": rows}, indent=1) + "\n", encoding="utf-8")
    for name, found in rows.items():
        for row in found["rows"]:
            where = ", ".join(f"{k} = {v:.4g}" for k, v in row["where"].items())
            print(f"{name:10} {row['quantity']:16} {row['worst']:+.3e} +- {row['certificate']:.0e}"
                  f"  at {where}; {row['note']}")  # fmt: skip


if __name__ == "__main__":
    main()
