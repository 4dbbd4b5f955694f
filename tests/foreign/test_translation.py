"""A shader's SPIR-V becomes Python that computes the same."""
from __future__ import annotations

import math

import pytest
import stored

import montecarlo_brdf as mb
from montecarlo_brdf.cli import _catalogue
from montecarlo_brdf.mixture import mixture
from montecarlo_brdf.model import channels

WO = (0.6, 0.0, 0.8)
WI = (-0.28, 0.45, math.sqrt(1.0 - 0.28**2 - 0.45**2))


@pytest.mark.parametrize("name", stored.GGX)
def test_ggx_of_every_language_is_the_built_in_one(name: str) -> None:
    ours, known = stored.model(name), mb.load("ggx")
    assert ours.f(WO, WI, ours.parameters()) == pytest.approx(0.3126128, abs=5e-8)
    for wo, wi, drawn in stored.pairs(200):
        alpha = drawn.uniform(0.05, 1.0)
        p, q = ours.parameters(alpha=alpha), known.parameters(alpha=alpha)
        assert ours.f(wo, wi, p) == pytest.approx(known.f(wo, wi, q), rel=1e-12)
        if ours.pdf and known.pdf:
            assert ours.pdf(wo, wi, p) == pytest.approx(known.pdf(wo, wi, q), rel=1e-12)


@pytest.mark.parametrize("name", stored.GGX[:3])
def test_what_is_drawn_is_a_direction(name: str) -> None:
    ours = stored.model(name)
    assert ours.sample
    for wo, u, _ in stored.pairs(50):
        drawn = ours.sample(wo, (abs(u[0]), abs(u[1]), 0.5), ours.parameters())
        assert math.hypot(*drawn) == pytest.approx(1.0, abs=1e-12)


def test_single_precision_rounds_every_step() -> None:
    found = stored.texts("ggx.glsl")
    single, double = stored.functions(found.single), stored.functions(found.double)
    p, q = single["Params"](), double["Params"]()
    error = [single["f"](o, i, p) / double["f"](o, i, q) - 1.0 for o, i, _ in stored.pairs(100)]
    assert 1e-8 < max(map(abs, error)) < 1e-4


def reference_flow(a: stored.Vec, b: stored.Vec, n: int) -> float:
    """`flow` of flow.glsl by hand."""
    values = [a[0], a[1], b[0], b[1]]
    x = early(a[0], n) + values[n % 4]
    values[n % 3] = 2.0
    x += values[0] + 10.0 * values[1] + weight(7 * n % 20)
    y, factor = chosen(n - 3, b[1])
    x += factor * y
    x += matrices(a, b)
    length = math.sqrt(sum(v * v for v in a))
    k = 1.0 - 0.75 * 0.75 * (1.0 - (a[2] / length) ** 2)
    x += 0.75 * -a[0] / length if k >= 0.0 else 0.0
    x += (scrambled(n * 2654435769) >> 8) / 16777216.0
    x += 10 * (n % 3) + n % 2
    k = 0
    while True:
        k += 3
        if k == 9 or k >= n:
            break
    k = max(k + 1, 21 - n)
    return x + k + 1 + int(-2.5 * b[0]) + (-(n // 2) if n & 1 else n % 3)


def early(x: float, n: int) -> float:
    for i in range(n):
        for j in range(n):
            if i * j == 6:
                return x + (i - j)
            if j == i + 2:
                break
            if (i + j) % 3 == 1:
                continue
            x = 0.75 * x + 0.125 * j
        if x > 2.0:
            x -= 1.0
    return x


def weight(k: int) -> float:
    return 0.5 + k if k < 10 else 0.25 + (k - 10)


def chosen(k: int, y: float) -> tuple[float, float]:
    if k == 0:
        return y + 0.5, 1.0
    if k == 1:
        return 2.0 * y + 0.25, 2.0
    if k == 2:
        return y + 0.25, 2.0
    return (y, -1.0) if k == -3 else (-y, 2.0)


def matrices(a: stored.Vec, b: stored.Vec) -> float:
    import numpy as np

    columns = [(1 + a[0], 0.5, 0.25), (0.125, 2 + b[1], 0.5), (a[1], 0.25, 3.0)]
    m = np.array(columns).T
    x, y, z = np.linalg.solve(m, b)
    return float(x + 2.0 * y - z + np.linalg.det(m))


def scrambled(x: int) -> int:
    x &= 0xFFFFFFFF
    x ^= x >> 16
    x = x * 0x7FEB352D & 0xFFFFFFFF
    x ^= x >> 15
    return x * 0x846CA68B & 0xFFFFFFFF


def test_control_flow_arrays_matrices_and_whole_numbers() -> None:
    space = stored.functions(stored.texts("flow.glsl").double)
    for wo, wi, drawn in stored.pairs(300):
        n = drawn.randrange(13)
        found = space["f"](wo, wi, space["Params"](float(n)))
        assert found == pytest.approx(reference_flow(wo, wi, n), rel=1e-11), (wo, wi, n)


def reference_library(x: float, y: float, z: float) -> float:
    """`library` of library.glsl by NumPy."""
    import numpy as np

    v, w = np.array([x, y, z]), np.array([z, x, 0.5])
    t = np.clip((x + 0.5) / 1.0, 0.0, 1.0)
    bits = np.float32(x).view(np.int32) + np.int32(256)
    unit = w / np.linalg.norm(w)
    terms = [
        np.sin(x), 2 * np.cos(y), 3 * np.tan(0.5 * x), 4 * np.arcsin(x), 5 * np.arccos(y),
        np.arctan(x), 2 * np.arctan2(y, x), 3 * np.sinh(x), 4 * np.cosh(y), 5 * np.tanh(z),
        np.arcsinh(x), 2 * np.arccosh(1 + z), 3 * np.arctanh(0.5 * y), np.exp(x), 2 * np.log(z),
        np.exp2(y), 2 * np.log2(z), 3 * np.sqrt(z), 4 / np.sqrt(z), z**x,
        x**3, 2 * abs(x), 3 * np.sign(y), 4 * np.floor(5 * x), 5 * np.ceil(5 * y),
        np.trunc(5 * x), 2 * np.rint(5 * y), 3 * (5 * x - np.floor(5 * x)),
        4 * np.mod(5 * x, 0.75), min(x, y), 2 * max(x, z), 3 * min(max(4 * x, -1.0), y),
        4 * (x * (1 - z) + y * z), float(y >= x), 2 * t * t * (3 - 2 * t), 3 * (x * y + z),
        0.01 * np.degrees(x), np.linalg.norm(v), 2 * np.linalg.norm(v - w), 3 * v @ w,
        np.cross(v, w)[1], z / np.linalg.norm(v), -x if v @ w >= 0 else x,
        2 * (v - 2 * (unit @ v) * unit)[1], np.radians(100 * x), float(bits.view(np.float32)),
        float(int(np.float32(z).view(np.uint32)) & 255), float(np.any(v < w)), 2.0,
    ]  # fmt: skip
    return float(sum(terms))


def test_the_library_of_functions() -> None:
    space = stored.functions(stored.texts("library.glsl").double)
    for wo, wi, _ in stored.pairs(200):
        found = space["f"](wo, wi, space["Params"]())
        assert found == pytest.approx(reference_library(wo[0], wi[0], wo[2]), rel=1e-11, abs=1e-11)


def test_colours_are_channels() -> None:
    model = stored.model("colour.glsl")
    p = model.parameters(base_r=0.9, base_g=0.5, base_b=0.1, layered=0.0, steps=2)
    values = [model.f(WO, WI, one) for one in channels(p)]
    assert values == pytest.approx([c * 0.95**2 / math.pi for c in (0.9, 0.5, 0.1)], rel=1e-12)
    assert model.domain["base_r"] == (0.0, 1.0) and model.pdf
    assert model.pdf(WO, WI, channels(p)[0]) == pytest.approx(WI[2] / math.pi, rel=1e-12)


def test_a_colour_takes_part_in_everything() -> None:
    model = stored.model("colour.glsl")
    report = mb.stress(model, [model.parameters()], precisions=["float32"], quick=True)
    assert report.verdict == "pass"
    mixed = mixture([(0.5, mb.load("lambert")), (0.5, model)], "both")
    assert len(channels(mixed.parameters())) == 3
    assert "channel=0/1/2" in _catalogue.ranges(model)
