"""Measured files: read as the database defines them, sampled as they reflect, refused where they
are none."""

from __future__ import annotations

import importlib.util
import struct
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.bits import double_at
from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.measured import merl
from montecarlo_brdf.model import Model

ROOT = Path(__file__).parent.parent.parent


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("merl_file", ROOT / "scripts" / "merl_file.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def ggx(script: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with GGX of width 0.3."""
    path = tmp_path_factory.mktemp("measured") / "ggx.binary"
    path.write_bytes(script.content(0.3))
    return Path(path)


@pytest.fixture(scope="module")
def nearest(ggx: Path) -> Model:
    return mb.load(f"merl:{ggx}")


def pairs(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Cosine-weighted directions."""
    u = np.random.default_rng(5).random((4, n))
    made = [np.stack([np.sqrt(a) * np.cos(b), np.sqrt(a) * np.sin(b), np.sqrt(1.0 - a)], axis=1)
            for a, b in ((u[0], 2 * np.pi * u[1]), (u[2], 2 * np.pi * u[3]))]  # fmt: skip
    return made[0], made[1]


def place(wo: np.ndarray, wi: np.ndarray) -> np.ndarray:
    """Places in bins, (3, n), by turning wi into the frame of the half vector."""
    h = wo + wi
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    theta, phi = np.arccos(np.clip(h[:, 2], -1.0, 1.0)), np.arctan2(h[:, 1], h[:, 0])
    x = wi[:, 0] * np.cos(phi) + wi[:, 1] * np.sin(phi)
    y = wi[:, 1] * np.cos(phi) - wi[:, 0] * np.sin(phi)
    x, z = x * np.cos(theta) - wi[:, 2] * np.sin(theta), (
        x * np.sin(theta) + wi[:, 2] * np.cos(theta)
    )
    difference, turn = np.arccos(np.clip(z, -1.0, 1.0)), np.mod(np.arctan2(y, x), np.pi)
    return np.stack([90 * np.sqrt(theta / (np.pi / 2)), 90 * difference / (np.pi / 2),
                     180 * turn / np.pi])  # fmt: skip


def table(path: Path) -> np.ndarray:
    """Of the first channel, in 1/sr."""
    values = np.frombuffer(path.read_bytes(), "<f8", offset=12)
    return values[: 90 * 90 * 180].reshape(90, 90, 180) / 1500.0


def trilinear(values: np.ndarray, at: np.ndarray, centre: float) -> np.ndarray:
    """Between values that lie at `centre` within their bins."""
    low = np.floor(at - centre).astype(int)
    t = at - centre - low
    total, weights = np.zeros(at.shape[1]), np.zeros(at.shape[1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod([np.where(c, u, 1.0 - u) for c, u in zip(corner, t, strict=True)], axis=0)
        i, j, k = (row + c for row, c in zip(low, corner, strict=True))
        found = values[np.clip(i, 0, 89), np.clip(j, 0, 89), k % 180]
        total += np.where(found >= 0.0, weight * found, 0.0)
        weights += np.where(found >= 0.0, weight, 0.0)
    return total / np.where(weights > 0.0, weights, 1.0)


def f_of(model: Model, wo: np.ndarray, wi: np.ndarray) -> np.ndarray:
    return Pointwise(model, model.parameters(channel=0.0)).f(wo, wi)


def test_the_bin_that_holds_the_angles_is_read(ggx: Path, nearest: Model) -> None:
    wo, wi = pairs(20_000)
    at = place(wo, wi)
    inside = (np.abs(at - np.rint(at)) > 1e-7).all(axis=0)  # rounding decides at an edge
    i, j, k = np.minimum(at.astype(int), np.array([[89], [89], [179]]))
    expected = np.maximum(table(ggx)[i, j, k], 0.0)
    found = f_of(nearest, wo, wi)
    assert inside.mean() > 0.99
    assert np.allclose(found[inside], expected[inside], rtol=1e-15, atol=0.0)
    assert np.array_equal(found, f_of(nearest, wi, wo))  # reciprocal to the last bit


def test_linear_is_between_centres_and_half_a_bin_off_is_seen(ggx: Path, nearest: Model) -> None:
    linear = nearest.variant(interpolate="linear")
    wo, wi = pairs(5_000)
    found, at = f_of(linear, wo, wi), place(wo, wi)
    right, off = (trilinear(table(ggx), at, centre) for centre in (0.5, 0.0))
    assert np.abs(found - right).max() < 1e-9 * right.max()
    assert np.abs(f_of(linear, wi, wo) - found).max() < 1e-9 * right.max()
    assert np.median(np.abs(off - right)[right > 0] / right[right > 0]) > 0.01


@pytest.mark.parametrize(("theta", "known", "away"), [
    (0.0, 0.877358, 1.8e-4), (60.0, 0.821710, 2.8e-4), (85.0, 0.8984, 9.1e-4),
])  # fmt: skip
def test_what_bins_do_to_the_albedo_of_ggx(
    nearest: Model, theta: float, known: float, away: float
) -> None:
    """Values by an independent program; theirs and ours have errors below 5e-5."""
    p = nearest.parameters(channel=0.0)
    found = mb.directional_albedo(nearest, p, theta, sampler="own", samples=1 << 19)
    assert abs(found.mean / known - 1.0 - away) < 6e-5 + 6.0 * found.stderr


def test_tables_are_no_part_of_kernels(nearest: Model, ggx: Path, tmp_path: Path) -> None:
    """Another file shares all machine code, as tables are found by their address."""
    other = tmp_path / "other.binary"
    other.write_bytes(merl.encoded(0.5 * merl.read(ggx)))
    keys = []
    for model in (nearest, mb.load(f"merl:{other}")):
        p = model.parameters(channel=0.0)
        method = adaptive.methods(model)[0]
        keys.append(adaptive.prepare(model, p, 0, method).looks.key)
    assert keys[0] == keys[1]


def test_all_channels_and_no_others(nearest: Model) -> None:
    assert nearest.parameters().channel == (0.0, 1.0, 2.0)
    assert nearest.prepared(nearest.parameters(channel=2.0)) != nearest.prepared(
        nearest.parameters(channel=1.0)
    )
    with pytest.raises(ModelError, match="channel must be 0, 1 or 2, not 0.5"):
        nearest.prepared(nearest.parameters(channel=0.5))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"short", "is truncated: 5 bytes"),
        (struct.pack("<3i", 90, 90, 360) + bytes(80), "must have dimensions 90 x 90 x 180: not 90"),
        (struct.pack(">3i", 90, 90, 180) + bytes(80), "its bytes are in the wrong order"),
        (struct.pack("<3i", 90, 90, 180) + bytes(80), "is truncated: 92 bytes, where 90 x 90"),
    ],
)
def test_files_that_are_none_are_told(
    cli: Callable[..., Outcome], tmp_path: Path, content: bytes, words: str
) -> None:
    (tmp_path / "bad.binary").write_bytes(content)
    found = cli("furnace", "--model", f"merl:{tmp_path / 'bad.binary'}")
    assert found.code == 4 and words in found.err and found.err.count("\n") == 1


def test_a_file_that_is_scaled_already_is_told(
    cli: Callable[..., Outcome], ggx: Path, tmp_path: Path
) -> None:
    planes = np.frombuffer(ggx.read_bytes(), "<f8", offset=12).reshape(3, 90, 90, 180)
    values = np.where(planes >= 0.0, planes * np.array(merl.SCALES)[:, None, None, None], -1.0)
    path = tmp_path / "scaled.binary"
    path.write_bytes(struct.pack("<3i", 90, 90, 180) + values.tobytes())
    found = cli("show", f"merl:{path}")
    assert found.code == 0 and "Matusik" in found.out
    found = cli("furnace", "--model", f"merl:{path}", "--theta-o", 0)
    assert found.code == 4 and "it is scaled already, write -p scale=one" in found.err
    right = mb.load(f"merl:{path}", scale="one")
    assert f_of(right, *pairs(1)) == pytest.approx(f_of(mb.load(f"merl:{ggx}"), *pairs(1)), 1e-12)
    values[1] = -1.0
    assert merl.encoded(values)[:12] == ggx.read_bytes()[:12]
    path.write_bytes(merl.encoded(values))
    with pytest.raises(ModelError, match="a channel without any measured value"):
        mb.load(f"merl:{path}")


def test_a_missing_file_is_wrong_use(cli: Callable[..., Outcome]) -> None:
    found = cli("furnace", "--model", "merl:none.binary")
    assert found.code == 2 and "no measured file none.binary" in found.err
    with pytest.raises(UserError):
        mb.load("merl:")


def test_no_other_arithmetic_reads_memory() -> None:
    with pytest.raises(TypeError, match="which only a double holds"):
        double_at(np.float32(1.4e14), 0)  # type: ignore[arg-type]


def test_a_file_is_the_same_from_every_folder(
    ggx: Path, nearest: Model, monkeypatch: pytest.MonkeyPatch, cli: Callable[..., Outcome]
) -> None:
    monkeypatch.chdir(ggx.parent)
    assert mb.load("merl:ggx.binary").identity == nearest.identity == "ggx.binary"
    found = cli("furnace", "--model", "ggx.binary")
    assert found.code == 2 and "is named merl:ggx.binary" in found.err
    Path("checks").mkdir()
    listed = Path("checks/brdf-check.toml")
    listed.write_text("[[models]]\nmodel = 'merl:../ggx.binary'\nparams = { channel = 0 }\n"
                      "checks = ['equality']\n")  # fmt: skip
    found = cli("run", "--config", listed)
    assert found.code == 0 and "merl:ggx.binary(channel=0" in found.out, found.err


HALF_A_BIN = """\
import math
import numpy as np

TABLE = np.fromfile({path!r}, dtype="<f8", offset=12)[: 90 * 90 * 180] / 1500.0


def f(wo, wi, p):
    hx, hy, hz = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    dx, dy, dz = wi[0] - wo[0], wi[1] - wo[1], wi[2] - wo[2]
    s = math.sqrt(hx * hx + hy * hy)
    n = math.sqrt(s * s + hz * hz)
    c, e = (hx / s, hy / s) if s > 0.0 else (1.0, 0.0)
    phi = math.atan2(c * dy - e * dx, (hz * (c * dx + e * dy) - s * dz) / n)
    phi = phi + math.pi if phi < 0.0 else phi
    theta_d = math.atan2(math.sqrt(dx * dx + dy * dy + dz * dz), n)
    i = min(89, int(90.0 * math.sqrt(math.atan2(s, hz) / (0.5 * math.pi)) + {off}))
    j = min(89, int(90.0 * theta_d / (0.5 * math.pi) + {off}))
    k = min(179, int(180.0 * phi / math.pi))
    return max(0.0, TABLE[(90 * i + j) * 180 + k])
"""


@pytest.mark.slow
@pytest.mark.parametrize(("off", "code"), [(0.0, 0), (0.5, 1)])
def test_a_reader_that_is_half_a_bin_off_is_refuted(
    cli: Callable[..., Outcome], user_file: Callable[..., Path], ggx: Path, off: float, code: int
) -> None:
    """Of the albedo too: what is off by rounding at an edge of bins is no fault of a reader."""
    path = user_file(HALF_A_BIN.format(path=str(ggx), off=off))
    found = cli("compare", path, f"merl:{ggx}", "-p", "channel=0", "--tolerance", 2e-3,
                "--theta-o", "0,60")  # fmt: skip
    assert found.code == code, found.out


@pytest.mark.slow
def test_measured_files_pass(cli: Callable[..., Outcome], ggx: Path) -> None:
    model = ("--model", f"merl:{ggx}", "-p", "channel=1")
    checks = ("--check", "positivity,energy,reciprocity,isotropy,pdf,sampling,cover")
    found = cli("run", *model, *checks)
    assert found.code == 0, found.out
    found = cli("furnace", *model, "-p", "interpolate=linear", "--theta-o", "0,45,80")
    assert found.code == 0, found.out
