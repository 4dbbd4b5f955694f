"""Cells of tables hold their certificates, whatever the way to them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import montecarlo_brdf as mb
from montecarlo_brdf import references
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table import affine, cells
from montecarlo_brdf.table.axes import Axis, Placement, checked, points
from montecarlo_brdf.table.cell import Terms, integrated
from montecarlo_brdf.table.subject import Subject, measures_of

AXES = checked([Axis("mu", 0.0, 1.0, 64), Axis("alpha", 0.0, 1.0, 64)])
#: 12,288 values at once with 99 % confidence
TERMS = Terms(1e-6, 0.01 / 12288)
GGX = Subject(mb.load("ggx"), AXES, measures_of(["albedo", "split-sum"]))


def truth(mu: float, alpha: float) -> list[float]:
    unit, dark = (references.albedo("ggx", mu, alpha=alpha, f0=f0) for f0 in (1.0, 0.0))
    assert unit is not None and dark is not None
    return [unit.value, unit.value - dark.value, dark.value]


@pytest.mark.parametrize("many", [100, pytest.param(500, marks=pytest.mark.slow)])
def test_certificates_of_ggx_hold_against_references(many: int) -> None:
    """Cells at random; a certificate that does not hold has a chance of 10^-6 in one."""
    every = list(points(AXES))
    some = [every[k] for k in np.random.default_rng(many).integers(len(every), size=many)]
    found = cells.at(GGX, TERMS, some, threads=2)
    known = np.array([truth(*point) for point in some]).T
    assert found.errors.max() <= 1e-6
    assert np.all(np.abs(found.values - known) <= found.errors)


def test_certificates_are_no_wider_than_they_must_be() -> None:
    """The median error is a tenth of its certificate at least: nothing is hidden by a wide bar."""
    small = GGX._replace(axes=checked([Axis("mu", 0.0, 1.0, 8), Axis("alpha", 0.0, 1.0, 8)]))
    found = cells.filled(small, TERMS)
    known = np.array([truth(*point) for point in points(small.axes)]).T.reshape(3, 8, 8)
    ratio = np.abs(found.values - known) / found.errors
    assert np.median(ratio) > 0.01 and ratio.max() < 1.0


def test_threads_and_interruptions_do_not_show(tmp_path: Path) -> None:
    small = GGX._replace(axes=checked([Axis("mu", 0.0, 1.0, 16), Axis("alpha", 0.0, 1.0, 16)]))
    whole = cells.filled(small, TERMS, threads=1)
    kept = tmp_path / "cells.bin"

    class Stopped(Exception):
        pass

    def stop(done: float) -> None:
        if done > 0.4:
            raise Stopped

    with pytest.raises(Stopped):
        cells.filled(small, TERMS, threads=2, progress=stop, resume=kept)
    rest: list[float] = []
    resumed = cells.filled(small, TERMS, threads=2, progress=rest.append, resume=kept)
    assert len(rest) < 4  # pieces of 64 cells: some were done
    assert np.array_equal(whole.values, resumed.values)
    assert np.array_equal(whole.errors, resumed.errors)
    for other in (TERMS._replace(seed=1), TERMS._replace(target=1e-7)):
        with pytest.raises(UserError, match="of another model, table, seed or version"):
            cells.filled(small, other, resume=kept)
    kept.write_bytes(kept.read_bytes()[:-8])
    with pytest.raises(UserError, match="or is damaged"):
        cells.filled(small, TERMS, resume=kept)


def test_the_average_is_the_bihemispherical_albedo() -> None:
    axis = Axis("alpha", 0.001, 1.0, 5, Placement.EDGES)
    subject = Subject(mb.load("ggx"), checked([axis]), measures_of(["average"]))
    found = cells.filled(subject, Terms(1e-6, 1e-6))
    for k, alpha in enumerate(axis.values()):
        known = references.bihemispherical("ggx", alpha=alpha, f0=1.0)
        assert known is not None
        assert abs(found.values[0, k] - known.value) <= found.errors[0, k] <= 1e-6


def test_f_that_is_not_affine_is_told() -> None:
    assert affine.bend(GGX).straight
    curved = GGX._replace(model=mb.load("ggx_kulla_conty"))
    found = affine.bend(curved)
    assert not found.straight and found.size > 1e-3 and "f0" in found.where


def test_a_quadrature_says_the_same() -> None:
    place = GGX.place((0.3, 0.4))
    found = integrated(GGX, place, GGX.weights(), TERMS)
    assert np.all(np.abs(np.array(found.values) - truth(0.3, 0.4)) <= found.errors)


@pytest.mark.parametrize(
    ("axes", "words"),
    [
        ([Axis("mu", 0.0, 1.0, 1)], "axis mu needs 2 values or more, not 1"),
        ([Axis("mu", 0.0, 1.0, 1_000_000), Axis("alpha", 0.0, 1.0, 1_000_000)], "1e[+]12 cells"),
        ([Axis("mu", 0.0, 1.0, 8, Placement.EDGES)], "must lie in .0, 1."),
        ([Axis("mu", 0.5, 0.5, 8)], "must run from low to high"),
        ([Axis("theta", 0.0, 90.0, 8, Placement.EDGES)], "must lie in .0, 90. degrees"),
        ([Axis("mu", 0.0, 1.0, 8)] * 2, "given twice"),
        ([Axis(n, 0.1, 0.9, 2) for n in "abcd"], "1 to 3 axes"),
        ([Axis("mu", 0.0, 1.0, 8), Axis("theta", 0.0, 80.0, 8)], "the same angle"),
    ],
)
def test_axes_that_are_none_are_told(axes: list[Axis], words: str) -> None:
    with pytest.raises(UserError, match=words):
        checked(axes)


def test_centres_and_edges_are_what_they_are_called() -> None:
    centres, edges = Axis("x", 1.0, 3.0, 4), Axis("x", 1.0, 3.0, 5, Placement.EDGES)
    assert centres.values() == [1.25, 1.75, 2.25, 2.75]
    assert edges.values() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert centres.told() == "x = 1 + 2 (i + 0.5)/4" and edges.told() == "x = 1 + 2 i/4"
    assert math.isclose(centres.first + 3 * centres.step, 2.75)
