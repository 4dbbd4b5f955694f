"""Files of the BRDF Explorer against albedos that SciPy's cubature gave of their formulas.

$BRDF_EXPLORER names the folder that has them; none of them is in this repository.
"""
from __future__ import annotations

import os
from pathlib import Path

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.model import channels
from montecarlo_brdf.vectors import from_degrees

FOLDER = Path(os.environ.get("BRDF_EXPLORER", "/nowhere"))
ANGLES = (0.0, 30.0, 60.0, 85.0)
#: A of the green channel at ANGLES, at the defaults; None where f is no number
ALBEDOS: dict[str, tuple[float | None, ...]] = {
    "lambert": (1.0, 1.0, 1.0, 1.0), "minnaert": (1.0, 1.0, 1.0, 1.0),
    "phong": (0.062210, 0.062210, 0.062210, 0.050348),
    "blinnphong": (0.246399, 0.213388, 0.122942, 0.023242),
    "modifiedphong": (1.0, 0.880843, 0.608998, 0.363097),
    "stretchedphong": (1.0, 0.991388, 0.889904, 0.773772),
    "cooktorrance": (1.256637, 1.257606, 1.643777, 6.769028),
    "ward": (1.937552, 1.813360, 1.475690, 1.150754),
    "walter": (0.098830, 0.098608, 0.096912, 0.087313),
    "ashikhman_shirley": (0.967992, 0.940744, 0.796489, 0.480909),
    "schlick": (3.141593, 3.141593, 3.141593, 3.141593),
    "edwards06": (1.0, None, None, None), "orennayar": (None, 0.791965, 0.817478, 0.879295),
    "blinn": (0.124829, 0.124829, 0.124701, 0.117036),
    "disney": (0.453472, 0.453231, 0.473307, 0.584028),
}  # fmt: skip
#: of a file whose f grows to the horizon, what the quadrature says of its own error
RESOLVED = {"edwards06": 1.4e-4}
pytestmark = [
    stored.needs_wheel,
    pytest.mark.skipif(not FOLDER.is_dir(), reason="$BRDF_EXPLORER names no folder of .brdf files"),
]


@pytest.mark.parametrize("name", ALBEDOS)
def test_the_albedo_is_that_of_the_formula(name: str) -> None:
    model = mb.load(str(FOLDER / f"{name}.brdf"))
    sets = channels(model.parameters())
    p = sets[len(sets) // 2]
    for angle, due in zip(ANGLES, ALBEDOS[name], strict=True):
        if due is not None:
            found = _truth.deterministic(model, p, from_degrees(angle, 0.0), 0)
            within = RESOLVED.get(name, 1e-6)
            assert found.estimate.mean == pytest.approx(due, abs=within * max(1.0, due))


def test_every_file_is_translated() -> None:
    for path in sorted(FOLDER.glob("*.brdf")):
        assert mb.load(str(path)).f
