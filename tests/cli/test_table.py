"""brdf-check table: other people's tables and fits, files, and what goes wrong."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import Outcome

from montecarlo_brdf import references
from montecarlo_brdf.table.written import npz

AXES = ("--axis", "mu=0:1:8", "--axis", "alpha=0:1:8")
FITS = """\
def fit(mu):
    return 0.5

def two(mu):
    return 1.0, 2.0

def bad(mu):
    return mu[0]

def other(nu):
    return nu

def nowhere(mu):
    return float("nan") if mu < 0.5 else 0.5
"""
QUICK = ("table", "ggx", *AXES, "--fresh", 32)


@pytest.fixture(scope="module")
def own() -> np.ndarray:
    """E of the same cells, (mu, alpha)."""
    at = [(k + 0.5) / 8 for k in range(8)]
    return np.array([[_truth(mu, a) for a in at] for mu in at])


def _truth(mu: float, alpha: float) -> float:
    found = references.albedo("ggx", mu, alpha=alpha, f0=1.0)
    assert found is not None
    return found.value


def test_a_right_table_passes_and_a_wrong_cell_fails(
    cli: Callable[..., Outcome], own: np.ndarray, tmp_path: Path
) -> None:
    path = tmp_path / "theirs.npy"
    np.save(path, own.T)  # rows run along the first axis
    asked = (*QUICK, "--against", path, "--tolerance", 1e-4)
    assert cli(*asked).code == 0
    wrong = own.copy()
    wrong[3, 5] += 0.01
    np.save(path, wrong.T)
    found = cli(*asked)
    assert found.code == 1 and "mu 0.4375 alpha 0.6875" in found.out and "1.0e-02" in found.out
    assert cli(*asked[:-2]).code == 0  # measured, not judged
    wrong[1, 2] = np.nan
    np.save(path, wrong.T)
    found = cli(*asked)
    assert found.code == 2 and "a value that is not finite: albedo at mu = 0." in found.err


@pytest.mark.parametrize(
    ("done", "words"),
    [
        (lambda e: e.T[::-1], "axis alpha runs the other way"),
        (lambda e: e, "axes mu and alpha are exchanged"),
        (lambda e: 0.5 * e.T, "all values are 0.5 times what they should be"),
    ],
)
def test_what_was_done_to_a_table_is_told(
    cli: Callable[..., Outcome], own: np.ndarray, tmp_path: Path, done, words: str
) -> None:
    path = tmp_path / "theirs.npy"
    np.save(path, done(own))
    found = cli(*QUICK, "--against", path, "--tolerance", 1e-3)
    assert found.code == 1 and words in " ".join(found.out.split())


def test_edges_taken_for_centres_are_told(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    at = np.linspace(0.0, 1.0, 16)
    values = [[_truth(max(mu, 1e-3), max(a, 1e-3)) for mu in at] for a in at]
    np.save(tmp_path / "theirs.npy", values)
    axes = ("--axis", "mu=0:1:16", "--axis", "alpha=0:1:16")
    found = cli("table", "ggx", *axes, "--fresh", 0, "--against", tmp_path / "theirs.npy")
    assert "its values lie at edges of mu and alpha" in " ".join(found.out.split())


def test_fits_by_formula_and_function(cli: Callable[..., Outcome], user_file: Callable[..., Path]
                                      ) -> None:  # fmt: skip
    lossless = ("table", "lambert", "-p", "albedo=0.5", "--axis", "mu=0:1:4", "--fresh", 16)
    assert cli(*lossless, "--against", "0.5", "--tolerance", 1e-9).code == 0
    found = cli(*lossless, "--against", "0.5 + 0.1*mu^2", "--tolerance", 1e-3)
    assert found.code == 1 and "0.0" in found.out
    path = user_file(FITS)
    assert cli(*lossless, "--against", f"{path}:fit", "--tolerance", 1e-9).code == 0
    assert cli(*lossless, "--against", f"{path}:nowhere", "--tolerance", 0.5).code == 1
    for name, code, words in (
        ("two", 4, "returns 2 numbers, but 1 are asked for: albedo"),
        ("bad", 4, "raised TypeError (line 8)"),
        ("other", 2, "no axis 'nu'"),
        ("none", 2, "has no function none"),
    ):
        found = cli(*lossless, "--against", f"{path}:{name}")
        assert found.code == code and words in found.err, name


def test_a_written_table_brings_its_axes_and_passes(
    cli: Callable[..., Outcome], tmp_path: Path
) -> None:
    made = [tmp_path / f"lut{suffix}" for suffix in (".npz", ".csv", ".h")]
    wanted = [w for path in made for w in ("--export", path)]
    assert cli(*QUICK, *wanted, "--seed", 5, "--fit", "chebyshev:3").code == 0
    for path in made[:2]:
        found = cli("table", "ggx", "--fresh", 16, "--against", path, "--tolerance", 3e-5)
        assert found.code == 0 and "8 x 8" in found.out
    assert cli(*QUICK, "--against", made[2], "--tolerance", 3e-5).code == 0
    assert b"lut_albedo_fit(float mu, float alpha)" in made[2].read_bytes()
    other = cli("table", "ggx", "--axis", "mu=0:1:9", "--against", made[0])
    assert other.code == 2 and "has other axes" in other.err


def test_a_report_draws_itself_again(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    report, picture = tmp_path / "table.json", tmp_path / "table.png"
    assert cli(*QUICK, "--fit", "polynomial:3", "--export-json", report).code == 0
    assert len(json.loads(report.read_text())["results"][0]["curves"][0]) == 64
    assert cli("plot", report, "-o", picture).code == 0 and picture.stat().st_size > 10_000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--axis", "mu=0:1:1"), "a single value is no axis"),
        (("--axis", "mu=0:1:1000000", "--axis", "alpha=0:1:1000000"), "1e+12 cells"),
        (("--axis", "mu=0:1"), "an axis is written NAME=LOW:HIGH:SIZE"),
        (("--axis", "mu=0:1:4@middle"), "no placement 'middle'"),
        (("--axis", "roughness=0:1:4"), "no axis of model ggx 'roughness'"),
        (("-p", "alpha=rough^2"), "rough is neither a parameter nor one of"),
        (("-p", "alfa=1"), "no parameter of model ggx 'alfa'"),
        (("-p", "mu=1"), "mu is an axis"),
        (("--quantity", "energy"), "no quantity 'energy'"),
        (("--quantity", "average"), "the average is over all angles"),
        (("--quantity", "split-sum", "--split", "n"), "name it by --split"),
        (("--fit", "polynomial:99"), "a degree from 1 to 16"),
        (("--fit", "spline:3"), "no fit 'spline'"),
        (("--fit", "polynomial:12", "--axis", "mu=0:1:4"), "needs more values of mu"),
        (("--against", "missing.npz"), "cannot read missing.npz"),
        (("--against", "mu +"), "is no formula"),
        (("--export", "lut.txt"), "no format for lut.txt"),
        (("--target-error", "0"), "must be an absolute error"),
        (("--confidence", "1"), "confidence must be a number in (0, 1)"),
        (("--axis", "alpha=0:1:4@edges"), "alpha of model ggx must be a number in [0.0001, 1]"),
    ],
)
def test_mistakes_are_one_sentence(
    cli: Callable[..., Outcome], arguments: tuple[str, ...], words: str
) -> None:
    found = cli("table", "ggx", *arguments)
    assert found.code == 2 and words in found.err and found.err.count("\n") == 1, found.err


def test_f_that_is_not_affine_has_no_split_sum(cli: Callable[..., Outcome]) -> None:
    found = cli("table", "ggx_kulla_conty", "--quantity", "split-sum", "--axis", "mu=0:1:4")
    assert found.code == 2 and "not affine in f0" in found.err and "off a straight" in found.err


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_no_permission_is_told_before_the_work(
    cli: Callable[..., Outcome], tmp_path: Path
) -> None:
    tmp_path.chmod(0o500)
    found = cli(*QUICK, "--export", tmp_path / "lut.npz")
    assert found.code == 5 and "permission denied" in found.err


def test_no_folder_and_no_table_are_told(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    found = cli(*QUICK, "--export", tmp_path / "none" / "lut.npz")
    assert found.code == 5 and "there is no directory" in found.err
    (tmp_path / "short.npy").write_bytes(b"no array")
    found = cli(*QUICK, "--against", tmp_path / "short.npy")
    assert found.code == 2 and "is damaged or no table" in found.err
    np.save(tmp_path / "few.npy", np.zeros(10))
    found = cli(*QUICK, "--against", tmp_path / "few.npy")
    assert found.code == 2 and "has 10 numbers, but 8x8 cells" in found.err
    np.savez(tmp_path / "theirs.npz", a=np.zeros(3))
    found = cli(*QUICK, "--against", tmp_path / "theirs.npz")
    assert found.code == 2 and "was not written here" in found.err
    assert npz.FACTS == "brdf_check"


def test_a_model_that_gives_nan_fails(cli: Callable[..., Outcome], user_file: Callable[..., Path]
                                      ) -> None:  # fmt: skip
    path = user_file("import math\n\ndef f(wo, wi, p):\n    return math.sqrt(wo[2] - 0.5)\n")
    found = cli("table", path, "--axis", "mu=0:1:4", "--fresh", 0)
    assert found.code == 1 and "values are no numbers" in " ".join(found.out.split())
