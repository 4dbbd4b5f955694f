"""Lattices and jittered grids: structure, generators, charts, independence of how work is cut."""
from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

import montecarlo_brdf as mb
from montecarlo_brdf.sampling import charts
from montecarlo_brdf.sampling.lattice import GENERATORS, generator
from montecarlo_brdf.sampling.points import SETS, SHAPES, grid, lattice, stratified
from montecarlo_brdf.vectors import from_degrees

SIZES = [1, 2, 8, 64, 512]


@pytest.mark.parametrize("size", SIZES)
def test_lattice_is_a_shifted_group(size):
    """Differences of any two points are lattice points again: i z/N modulo 1."""
    points = [lattice(7, i, generator(size)) for i in range(size)]
    z = (1, *GENERATORS[size.bit_length() - 1])
    for axis, component in enumerate(z):
        for i, point in enumerate(points):
            expected = i * component % size / size
            apart = abs((point[axis] - points[0][axis] - expected + 0.5) % 1.0 - 0.5)
            assert apart < 1e-15
    assert all(0.0 <= c < 1.0 for p in points for c in p)


@pytest.mark.parametrize("m", range(4, 13))
def test_generators_are_the_best_of_all_korobov_lattices(m):
    """With the dual lattice looked through directly, unlike the script's continued fractions."""
    n = 1 << m
    dual = range(1, n // 2 + 1)

    def zaremba(z):
        return min(h * max(1, min(h * z % n, n - h * z % n)) for h in dual)

    best = zaremba(GENERATORS[m][0])
    step = 2 if m < 9 else 2 * (1 << (m - 8)) + 2
    assert best >= max(zaremba(z) for z in range(1, n // 2, step))


@pytest.mark.parametrize("size", SIZES)
def test_every_cell_of_the_grid_has_one_point(size):
    shape = grid(size)
    rows, columns = shape[1], size // shape[1]
    points = [stratified(11, i, shape) for i in range(size)]
    for a, b in ((0, 1), (2, 3)):
        assert len({(int(p[a] * columns), int(p[b] * rows)) for p in points}) == size
    assert len({int(p[4] * size) for p in points}) == size


def test_shifts_differ_between_keys_and_axes():
    first = [lattice(k, 0, generator(16)) for k in range(50)]
    assert len({c for p in first for c in p}) == 250


@given(st.floats(0.0, 1.0))
def test_smooth_step_and_its_complement_add_up(u):
    w, rest, slope = charts.smooth_step(u)
    assert w + rest == pytest.approx(1.0, abs=2e-15)
    assert 0.0 <= slope <= 1.875 and min(w, rest) >= 0.0


HORIZONS = {"half_vector": charts.half_horizon, "mirror": charts.mirror_horizon}


def made(chart, wo, u1, u2, width):
    """(x, y, z, solid angle) of a point, by all steps of a chart."""
    return getattr(charts, chart)(wo, HORIZONS[chart](wo, charts.polar(u1, u2)), width)


@given(st.floats(0.0, 89.9), st.floats(0.0, 360.0), st.floats(1e-3, 0.999), st.floats(0.0, 0.999),
       st.floats(1e-3, 1.0))  # fmt: skip
def test_charts_give_unit_vectors_above_the_horizon(theta, phi, u1, u2, width):
    wo = from_degrees(theta, phi)
    for chart in HORIZONS:
        x, y, z, area = made(chart, wo, u1, u2, width)
        assert z > 0.0 and area >= 0.0
        assert math.hypot(x, y, z) == pytest.approx(1.0, abs=1e-13)


@pytest.mark.parametrize("chart", ["half_vector", "mirror"])
@pytest.mark.parametrize("theta", [0.0, 45.0, 85.0])
def test_charts_cover_the_hemisphere_once(chart, theta):
    """Mean solid angle 2 pi and mean projected solid angle pi, on a grid of midpoints."""
    n, wo = 200, from_degrees(theta, 30.0)
    solid = projected = 0.0
    for i in range(n):
        for j in range(n):
            *_, z, area = made(chart, wo, (i + 0.5) / n, (j + 0.5) / n, 0.4)
            solid += area / n**2
            projected += area * z / n**2
    assert solid == pytest.approx(2.0 * math.pi, rel=2e-4)
    assert projected == pytest.approx(math.pi, rel=1e-5)


def test_panels_cover_the_hemisphere_once():
    n, wo = 64, from_degrees(50.0, 30.0)
    total = 0.0
    for i in range(n):
        for j in range(n):
            both = charts.panels(wo, (i + 0.5) / n, (j + 0.5) / n)
            for high, (x, y, z, area) in ((True, both[:4]), (False, both[4:])):
                assert math.hypot(x, y, z) == pytest.approx(1.0, abs=1e-13)
                assert (z >= wo[2]) == high and x * wo[0] + y * wo[1] >= -1e-16
                total += 2.0 * area / n**2
    assert total == pytest.approx(math.pi, rel=1e-6)


@pytest.mark.parametrize("chart", ["half_vector", "mirror"])
def test_area_bounds_the_solid_angle(chart):
    """What the probe takes for the largest solid angle at a direction is never too small."""
    wo = from_degrees(70.0, 20.0)
    for i in range(1, 40):
        for j in range(40):
            x, y, z, area = made(chart, wo, i / 40, j / 40, 0.1)
            _, _, slope = charts.smooth_step(i / 40)
            bound = getattr(charts, f"{chart}_area")(wo, (x, y, z), 0.1)
            assert area == pytest.approx(bound * slope / 1.875, rel=1e-9)


@pytest.mark.parametrize("points", sorted(SETS))
def test_results_do_not_depend_on_threads(points):
    model = mb.load("ggx")
    one, two = (
        mb.directional_albedo(
            model, model.parameters(), 60.0, points=points, samples=1 << 21, threads=t, seed=3
        )
        for t in (1, 2)
    )
    assert one == two


@pytest.mark.parametrize("points", [pytest.param("stratified", marks=pytest.mark.slow), "lattice"])
def test_other_quantities_agree_with_sobol(points):
    """Within 8 standard errors: t with 15 degrees of freedom exceeds that with chance 9e-7."""
    model = mb.load("ggx")
    p = model.parameters(alpha=0.5)
    for call, fixed in ((mb.reverse_albedo, (40.0,)), (mb.bihemispherical_albedo, ())):
        b = call(model, p, *fixed, sampler="own", points="sobol", samples=1 << 14, seed=1)
        for sampler in ("cosine", "half_vector"):
            a = call(model, p, *fixed, sampler=sampler, points=points, samples=1 << 14)
            assert abs(a.mean - b.mean) < 8.0 * math.hypot(a.stderr, b.stderr)


def test_registry_says_what_sets_need():
    assert set(SHAPES) == {"stratified", "lattice"}
    assert SETS["lattice"][0] == 1 << max(GENERATORS)
