"""The table of true values in tests/data/reference.json, in the names of this package."""

import json
import math
from pathlib import Path
from typing import Any, NamedTuple

FILE = Path(__file__).parents[1] / "data" / "reference.json"
MODELS = {
    "oren_nayar_qualitative": "oren_nayar",
    "phong_modified": "phong",
    "phong_modified_unnormalised": "phong_unnormalised",
    "phong_original_normalised": "phong_original",
    "phong_original_unnormalised": "phong_original",
    "phong_modified_unclamped": "phong_unclamped",
}
DISTRIBUTIONS = {"ggx": "ggx", "beckmann": "beckmann", "blinn": "blinn_phong"}
MASKINGS = {"corr": "smith", "sep": "separable", "vcavity": "v_cavity"}
NOT_HERE = {"mixture"}  # tests/models/test_mixtures.py


class Entry(NamedTuple):
    model: str
    parameters: dict[str, Any]
    theta: float | None  # degrees, None if bihemispherical
    quantity: str
    value: str  # all its digits are correct
    resolution: float  # what the printed digits leave open, absolute


def cosine(theta_degrees: float) -> float:
    """cos of an angle in degrees, to full relative accuracy at grazing and exactly 1 at 0."""
    return math.sin(math.radians(90.0 - theta_degrees))


def _fresnel(text: str) -> dict[str, Any]:
    name, _, values = text.partition(":")
    pairs = (pair.split("=") for pair in values.split(",") if pair)
    return {"fresnel": name} | {key.lower(): float(value) for key, value in pairs}


def _parameters(model: str, raw: dict[str, Any]) -> dict[str, Any]:
    if "D" in raw:
        rest = {key: raw[key] for key in ("alpha", "n") if key in raw}
        choices = {"distribution": DISTRIBUTIONS[raw["D"]], "masking": MASKINGS[raw["G"]]}
        return choices | _fresnel(raw["F"]) | rest
    if model in ("ggx_kulla_conty", "ggx_turquin"):
        return {"alpha": raw["alpha"], "f0": _fresnel(raw["F"]).get("f0", 1.0)}
    albedo = "c" if model in ("lambert", "minnaert") else "rho"
    names = {albedo: "albedo", "base": "albedo", "r": "roughness", "Rd": "rd", "Rs": "rs"}
    renamed = {names.get(key, key): value for key, value in raw.items()}
    norms = {"phong_original_normalised": "n+1", "phong_original_unnormalised": "none"}
    if model == "phong_modified_unclamped":
        return renamed | {"parity": "odd" if raw["n"] % 2 else "even"}
    return renamed | ({"norm": norms[model]} if model in norms else {})


def load(*quantities: str) -> list[Entry]:
    entries = []
    for e in json.loads(FILE.read_text()):
        if e["quantity"] in quantities and e["model"] not in NOT_HERE:
            name = MODELS.get(e["model"], e["model"])
            parameters = _parameters(e["model"], e["params"])
            resolution = abs(float(e["value"])) * 10.0 ** (1 - e["digits"])
            item = (name, parameters, e["theta_o_deg"], e["quantity"], e["value"], resolution)
            entries.append(Entry(*item))
    return entries
