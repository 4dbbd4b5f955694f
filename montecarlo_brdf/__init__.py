"""montecarlo_brdf: a Monte Carlo verifier of BRDFs whose verdicts can be trusted.

Conventions (one place for all of them):

    frame         tangent frame, normal n = (0, 0, 1); theta from n, phi azimuth
    wo, wi        unit vectors away from the surface; wo towards the viewer is given, wi towards the
                  light is drawn or integrated over
    f(wo, wi, p)  BRDF in 1/sr without the cosine, 0 below the horizon
    pdf           density per solid angle, 1/sr
    alpha         GGX/Beckmann width (alpha = roughness^2)
    angles        a name says _deg or it is in radians
    A(wo)         directional albedo, int f cos(theta_i) dwi; R(wi) = int f cos(theta_o) dwo

Reading order, each resting on those before it (CONTRIBUTING.md has a picture):

    vectors       directions as plain tuples
    compile       templates with holes become machine code: `compile.kernel`, `compile.bind`
    sampling      points of the unit cube, and ways from them to a direction
    model         what a BRDF says of itself; models are its files, references their truth
    foreign       a shader becomes the text of a model file: `foreign.translate`
    estimate      quantity times direction: a number with its error bar, and whether to believe it
    cases         what is looked at: a model, parameters, directions
    judge         a claim becomes a finding: `judge.claim`, `judge.decide`
    checks        one question per file; scene and stability ask theirs in the same way
    verify        a question becomes a Report
    report, cli   a Report becomes text, a file, a picture; one file per command
"""
from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "load": "loading",
    "Model": "model",
    "UserError": "errors",
    "ModelError": "errors",
    "Estimate": "statistics",
    "directional_albedo": "estimate.estimators",
    "reverse_albedo": "estimate.estimators",
    "bihemispherical_albedo": "estimate.estimators",
    "hemisphere_integral": "estimate.estimators",
    "furnace": "verify.furnace",
    "identities": "verify.identities",
    "read_scene": "scene.read",
    "radiance": "verify.radiance",
    "render": "scene.render",
    "run": "verify.run",
    "stress": "verify.stress",
}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: `brdf-check --help` must feel instant."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value
