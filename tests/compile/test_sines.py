"""sin and cos of a model's own code: polynomials, as precise as docs/models.md says."""
from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import mpmath as mp
import numpy as np

import montecarlo_brdf as mb
from montecarlo_brdf.compile import sines
from montecarlo_brdf.estimate.places import Pointwise

Write = Callable[..., Path]
TEXT = """
import math
def f(wo, wi, p):
    return math.sin(wi[0])
def pdf(wo, wi, p):
    return math.cos(wi[0])
"""
PLACES = 200  # of each magnitude


def evaluated(path: Path, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """sin and cos as kernels have them."""
    model = mb.load(str(path))
    functions, w = Pointwise(model, model.parameters()), np.zeros((len(x), 3))
    w[:, 0] = x
    return functions.f((0.0, 0.0, 1.0), w), functions.pdf((0.0, 0.0, 1.0), w)


def arguments() -> np.ndarray:
    """All magnitudes, and next to where sin or cos are zero."""
    rng = np.random.default_rng(1)
    sizes = (1e-300, 1e-8, 1.0, 6.3, 1e3, 1e6, 1e9, 2.0**40, sines.LARGEST)
    near = [float(k * mp.pi / 2) for k in (1, 2, 3, 7, 100, 12345, 10**6 + 1, 10**9 + 7, 10**13)]
    beside = [np.nextafter(near, 0.0), near, np.nextafter(near, math.inf)]
    return np.concatenate([rng.uniform(-s, s, PLACES) for s in sizes] + beside)


def test_they_are_right_to_two_units_in_the_last_place(user_file: Write) -> None:
    x = arguments()
    with mp.workprec(200):
        found = zip((mp.sin, mp.cos), evaluated(user_file(TEXT), x), strict=True)
        for truth, values in found:
            exact = [truth(mp.mpf(float(v))) for v in x]
            units = [math.ulp(float(t)) for t in exact]
            errors = [abs(y - t) / u for y, t, u in zip(values, exact, units, strict=True)]
            assert max(errors) < 2.0


def test_beyond_all_angles_they_are_no_number(user_file: Write) -> None:
    x = np.array([sines.LARGEST, -1e16, math.inf, math.nan])
    for values in evaluated(user_file(TEXT), x):
        assert np.isnan(values).all()


def test_where_rounding_is_looked_at_they_are_those_of_libm(user_file: Write) -> None:
    x = np.linspace(-10.0, 10.0, 500)
    for values, usual in zip(
        evaluated(user_file("STRICT = True\n" + TEXT), x), (math.sin, math.cos), strict=True
    ):
        assert values.tolist() == [usual(v) for v in x]
