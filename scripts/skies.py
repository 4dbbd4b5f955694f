"""No false fail under narrow light: all built-in models under a grid of skies, at default settings.

With their defaults and the first and last of their verified parameters. From a constant sky over
powers of a cosine up to 10^7 to caps of 0.01 degrees, around the normal, tilted, and on the
horizon. Energy is asked under the constant sky alone, as it does not depend on the sky. Everything
is a fail, not resolved (with both numbers), or a pass; models that disclaim energy have known
failures.

    python scripts/skies.py [--models ggx,phong] [--skies cap:1,cosine:1e5] [--samples 4194304]

Resumable: models and skies that scripts/results/skies.json holds are not asked again.
"""
from __future__ import annotations

import argparse
import collections
import json
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.scene.read import scene_of
from montecarlo_brdf.verify.question import SAMPLES

TARGET = Path(__file__).parent / "results" / "skies.json"
ANGLES = (0.0, 30.0, 60.0, 85.0)
SKIES = (
    "constant", "gradient", "gradient:60", "quadratic:45", "linear:1:0.5:90",
    *(f"cosine:{m}" for m in ("1", "10", "100", "1e3", "1e4", "1e5", "1e6", "1e7")),
    *(f"cosine:{m}:{t}" for m in ("10", "1e3", "1e5", "1e7") for t in (30, 60, 85, 90)),
    *(f"cap:{a}" for a in ("60", "10", "1", "0.1", "0.01")),
    *(f"cap:{a}:{t}" for a in ("10", "1", "0.1", "0.01") for t in (30, 60, 85, 90)),
)  # fmt: skip


def sets(name: str) -> dict[str, tuple[Any, Any]]:
    """A model with its defaults, and with the first and the last of its verified sets."""
    model = mb.load(name)
    ends = [model.parameters(**p._asdict()) for p in (*model.verified[:1], *model.verified[-1:])]
    found = dict.fromkeys((model.parameters(), *ends))
    return {f"{name}({', '.join(f'{k}={v}' for k, v in p._asdict().items())})": (model, p)
            for p in found}  # fmt: skip


def asked(model: Any, p: Any, sky: str, samples: int) -> dict[str, Any]:
    """Verdicts of a model under a sky, and those findings that are neither pass nor known."""
    scene = scene_of(model, p, sky, ANGLES)
    report = mb.radiance(scene, energy=sky == "constant", samples=samples)
    findings = report.results[0].findings
    counts = collections.Counter(str(f.verdict) for f in findings)
    open_ones = [
        {"at": dict(f.where), "of": f.quantity, "verdict": str(f.verdict), "value": f.value,
         "expected": f.expected, "note": f.note}
        for f in findings if f.verdict in ("fail", "inconclusive")
    ]  # fmt: skip
    return {"verdicts": dict(counts), "open": open_ones}


def main() -> None:
    """Ask everything, and print what is no pass and the sums."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default=",".join(loading.names()))
    parser.add_argument("--skies", default=",".join(SKIES))
    parser.add_argument("--samples", type=int, default=SAMPLES)
    parser.add_argument("--target", type=Path, default=TARGET)
    options = parser.parse_args()
    known = json.loads(options.target.read_text())["models"] if options.target.exists() else {}
    cases = {k: v for name in options.models.split(",") for k, v in sets(name).items()}
    for name, (model, p) in cases.items():
        for sky in options.skies.split(","):
            if sky in known.setdefault(name, {}):
                continue
            found = known[name][sky] = asked(model, p, sky, options.samples)
            for one in found["open"]:
                print(f"{name} {sky} {one}", flush=True)
            study = {**describe(), "angles": ANGLES, "models": known}
            options.target.write_text(json.dumps(study) + "\n")
        print(f"{name:50} {dict(total(known[name]))}", flush=True)
    print(dict(sum(map(total, known.values()), collections.Counter())))


def total(rows: dict[str, Any]) -> collections.Counter[str]:
    """Verdicts of all skies."""
    return sum((collections.Counter(r["verdicts"]) for r in rows.values()), collections.Counter())


if __name__ == "__main__":
    main()
