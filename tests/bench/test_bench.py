"""The benchmark measures what it says: right answers, own peers left out, honest choice."""
from __future__ import annotations

import json

import pytest

from montecarlo_brdf.bench import measure, workloads
from montecarlo_brdf.bench.measure import Timing


@pytest.mark.parametrize("name", ["W2", "W3"])
def test_peers_integrate_the_same_function(name):
    """Quadrature by another library agrees with our reference: the workload is what it says."""
    work = next(w for w in workloads.WORKLOADS if w.name == name)
    runs = dict(measure.METHODS["dblquad"](work))
    assert runs["epsrel 1e-06"](0) == pytest.approx(work.truth(), rel=1e-6)


def test_the_fastest_setting_that_meets_the_target_is_chosen():
    found = [
        (Timing("a", "epsrel 0.01", 1.0, 1e-5), None),
        (Timing("a", "epsrel 1e-06", 3.0, 1e-9), None),
        (Timing("b", "N = 4", 0.1, 1e-2), None),
        (Timing(measure.OURS, "target 0.001", 0.1, 1e-9), None),
        (Timing(measure.OURS, "target 1e-06", 0.2, 1e-7), None),
    ]
    chosen = measure.fastest(found, 1e-6)
    assert {k: t.setting for k, (t, _) in chosen.items()} == {
        "a, asked": "epsrel 1e-06",
        measure.OURS: "target 1e-06",
    } | {"a": "epsrel 1e-06"}
    assert "b" not in chosen


@pytest.mark.slow
def test_command_writes_tables_and_timings(cli, tmp_path):
    files = {k: tmp_path / f"bench.{k}" for k in ("json", "md", "png")}
    outcome = cli(
        "bench", "--workload", "W1", "--method", "brdf-check", "--rounds", 3,
        "--export-json", files["json"], "--markdown", files["md"], "--plot", files["png"],
    )  # fmt: skip
    assert outcome.code == 0, outcome.err
    data = json.loads(files["json"].read_text())
    assert {t["method"] for t in data["results"][0]["timings"]} == {"brdf-check"}
    assert all(t["error"] < 1e-3 for t in data["results"][0]["timings"])
    assert "W1: lambert" in files["md"].read_text() and files["png"].stat().st_size > 1000


def test_unknown_names_are_one_sentence(cli):
    outcome = cli("bench", "--method", "nunpy")
    assert outcome.code == 2 and "did you mean 'numpy'" in outcome.err
