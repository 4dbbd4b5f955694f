"""Geometry of directions, in Python and for any direction that hypothesis can think of.

Tolerances: a unit vector made from three rounded components is off by 2 eps at most, a sum of three
products of such components by 4 eps; nothing here may cancel, so each bound is a few eps.
"""
from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from montecarlo_brdf.vectors import (
    NORMAL,
    Vec,
    clamped_cosine,
    cross,
    dot,
    from_degrees,
    half_vector,
    length,
    mirrored,
    normalised,
    reflect,
    tangent_frame,
)

EPS = 2.0**-52
POLES = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (-0.0, -0.0, 1.0), (0.0, -0.0, -1.0)]

component = st.floats(-1.0, 1.0)
raw = st.tuples(component, component, component).filter(lambda v: length(v) > 1e-100)
tiny = st.floats(0.0, 1e-6)
near_poles = st.builds(lambda x, y, z: (x, -y, z), tiny, tiny, st.sampled_from([1.0, -1.0]))
near_horizon = st.builds(lambda phi, z: (math.cos(phi), math.sin(phi), z), st.floats(0, 7), tiny)
directions = st.one_of(st.sampled_from(POLES), raw, near_poles, near_horizon).map(normalised)


def distance(a: Vec, b: Vec) -> float:
    return max(abs(x - y) for x, y in zip(a, b, strict=True))


@given(directions)
def test_directions_are_unit_vectors(a: Vec) -> None:
    assert abs(length(a) - 1.0) <= 2 * EPS


@given(st.floats(0.0, 90.0), st.floats(-360.0, 360.0))
def test_degrees_are_radians(theta: float, phi: float) -> None:
    t, p = math.radians(theta), math.radians(phi)
    turned = (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t))
    assert distance(from_degrees(theta, phi), turned) <= 2 * EPS


def test_steep_degrees_keep_their_cosine() -> None:
    assert from_degrees(90.0) == (1.0, 0.0, 0.0)
    assert from_degrees(90.0 - 2.0**-30)[2] == math.sin(math.radians(2.0**-30))
    assert from_degrees(0.0) == NORMAL


@given(directions, directions)
def test_reflection_keeps_length_and_angle_and_undoes_itself(light: Vec, normal: Vec) -> None:
    r = reflect(light, normal)
    assert abs(length(r) - 1.0) <= 12 * EPS
    assert abs(dot(r, normal) - dot(light, normal)) <= 12 * EPS
    assert distance(reflect(r, normal), light) <= 24 * EPS


@given(directions)
def test_reflection_about_the_surface_normal_is_the_mirror(light: Vec) -> None:
    assert distance(reflect(light, NORMAL), mirrored(light)) <= EPS
    assert mirrored(mirrored(light)) == light


@given(directions, directions)
def test_reflection_lies_in_the_plane_of_incidence(light: Vec, normal: Vec) -> None:
    assert abs(dot(reflect(light, normal), cross(light, normal))) <= 12 * EPS


@given(directions, directions)
def test_half_vector_lies_halfway(wi: Vec, wo: Vec) -> None:
    size = length((wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]))
    if size < 1e-3:  # opposite directions leave nothing but rounding
        return
    h = half_vector(wi, wo)
    tolerance = 12 * EPS / size  # the sum is known to eps, so its direction to eps/size
    assert abs(length(h) - 1.0) <= 4 * EPS
    assert abs(dot(h, wi) - dot(h, wo)) <= tolerance
    assert dot(h, wi) >= 0.0
    assert distance(reflect(wo, h), wi) <= 2 * tolerance
    assert half_vector(wo, wi) == h


def test_opposite_directions_have_no_half_vector() -> None:
    with pytest.raises(ZeroDivisionError):  # in Python; compiled code gives NaN
        half_vector((0.6, 0.0, 0.8), (-0.6, 0.0, -0.8))


@given(directions)
def test_tangent_frame_is_orthonormal_and_right_handed(n: Vec) -> None:
    t, b = tangent_frame(n)
    for product, exact in ((dot(t, t), 1), (dot(b, b), 1), (dot(t, b), 0), (dot(t, n), 0)):
        assert abs(product - exact) <= 1e-15
    assert abs(dot(b, n)) <= 1e-15
    assert distance(cross(t, b), n) <= 1e-15


@pytest.mark.parametrize("n", POLES)
def test_tangent_frame_at_both_poles_is_exact(n: Vec) -> None:
    t, b = tangent_frame(n)
    assert (dot(t, t), dot(b, b), dot(t, b), dot(t, n), dot(b, n)) == (1.0, 1.0, 0.0, 0.0, 0.0)
    assert cross(t, b) == n


@given(directions, directions)
def test_clamped_cosine(a: Vec, b: Vec) -> None:
    assert clamped_cosine(a, b) == max(0.0, dot(a, b)) >= 0.0
    assert clamped_cosine(a, (-a[0], -a[1], -a[2])) == 0.0
