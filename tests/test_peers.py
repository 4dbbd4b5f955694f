"""The benchmark beside our peers (scripts/bench) measures what it says; the package needs none."""
from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent
PEERS = ("vegas", "cubepy", "mitsuba", "drjit")


@pytest.fixture
def measure(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """scripts/bench/measure.py."""
    monkeypatch.syspath_prepend(ROOT / "scripts")
    from bench import measure

    yield measure


@pytest.mark.parametrize("name", ["W2", "W3"])
def test_peers_integrate_the_same_function(measure: Any, name: str) -> None:
    """Quadrature by another library agrees with our reference: the workload is what it says."""
    from bench.workloads import WORKLOADS

    work = next(w for w in WORKLOADS if w.name == name)
    runs = dict(measure.METHODS["dblquad"](work))
    assert runs["epsrel 1e-06"](0) == pytest.approx(work.truth(), rel=1e-6)


def test_the_fastest_setting_that_meets_the_target_is_chosen(measure: Any) -> None:
    timing = measure.Timing
    found = [
        (timing("a", "epsrel 0.01", 1.0, 1e-5), None),
        (timing("a", "epsrel 1e-06", 3.0, 1e-9), None),
        (timing("b", "N = 4", 0.1, 1e-2), None),
        (timing(measure.OURS, "target 0.001", 0.1, 1e-9), None),
        (timing(measure.OURS, "target 1e-06", 0.2, 1e-7), None),
    ]
    chosen = measure.fastest(found, 1e-6)
    assert {k: t.setting for k, (t, _) in chosen.items()} == {
        "a, asked": "epsrel 1e-06",
        measure.OURS: "target 1e-06",
    } | {"a": "epsrel 1e-06"}
    assert "b" not in chosen


def test_a_peer_that_is_not_installed_is_left_out_by_name(
    measure: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from bench.workloads import WORKLOADS

    monkeypatch.setitem(sys.modules, "vegas", None)
    assert list(measure.sweep(WORKLOADS[0], ["vegas"])) == []
    assert "W1: vegas left out" in capsys.readouterr().err


def test_the_package_names_no_peer() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "bench" not in extras["optional-dependencies"]
    for path in (ROOT / "montecarlo_brdf").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert not any(f"import {peer}" in text for peer in PEERS), path
