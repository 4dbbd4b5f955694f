"""`brdf-check bench` measures true errors and processor times of our methods; it judges nothing."""
from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest

import montecarlo_brdf as mb
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.report import bench as report
from montecarlo_brdf.verify.bench import TARGETS, Timing, bench, reached

#: Nothing but f is known: there is no albedo().
USER = """
from typing import NamedTuple

class Params(NamedTuple):
    k: float = 0.5

domain = {"k": (0.0, 1.0)}

def f(wo, wi, p):
    return p.k * wi[2]
"""
FEW = {"seconds": 0.001, "seeds": 2}


def test_errors_are_true_ones() -> None:
    """Cosine sampling of Lambert is exact; uniform sampling errs as much as its estimates do."""
    model = mb.load("lambert")
    p = model.parameters(albedo=0.8)
    data = bench(model, p, method=["cosine x sobol", "uniform x independent"], **FEW)
    first, *_, exact = data["timings"]
    assert exact["method"] == "cosine x sobol" and exact["error"] < 1e-15
    found = [
        mb.directional_albedo(
            model, p, 60.0, sampler="uniform", points="independent", samples=256, seed=seed
        ).mean
        for seed in (1, 2)
    ]
    assert first["samples"] == 256 and first["seconds"] > 0.0
    assert first["error"] == pytest.approx(
        math.sqrt(sum((a / 0.8 - 1.0) ** 2 for a in found) / 2), rel=1e-12
    )


def test_a_method_ends_where_its_error_cannot_be_seen_or_its_time_is_up() -> None:
    model = mb.load("lambert")
    data = bench(model, model.parameters(), method="cosine x sobol", **FEW)
    assert [t["samples"] for t in data["timings"]] == [256]
    data = bench(model, model.parameters(), method="uniform x independent", **FEW)
    assert all(t["seconds"] <= FEW["seconds"] for t in data["timings"])
    assert data["targets"]["1e-06"] == []
    assert "uniform x independent       not within 0.001 s" in report.table(data)


def test_what_reaches_a_target() -> None:
    """The fewest samples from which on no error is above it; auto only as asked."""
    timings = [
        Timing("auto", 1e-2, 64, 1e-9, 1.0),
        Timing("auto", 1e-3, 96, 1e-9, 2.0),
        Timing("lucky", None, 1, 1e-4, 0.1),
        Timing("lucky", None, 2, 1e-1, 0.2),
        Timing("lucky", None, 4, 5e-4, 0.4),
        Timing("lucky", None, 8, 4e-4, 0.8),
        Timing("poor", None, 8, 4e-1, 0.1),
    ]
    rows = reached(timings, 1e-3)
    assert [(r["method"], r["samples"]) for r in rows] == [("lucky", 4), ("auto", 96)]


def test_methods_are_chosen_by_name_sampler_or_point_set() -> None:
    model = mb.load("lambert")
    for words, count in (("auto", 1), ("sobol", 3), ("cosine", 4), (["cosine", "sobol"], 6)):
        chosen = bench(model, model.parameters(), method=words, seconds=1e-9, seeds=1)
        assert len(chosen["methods"]) == count
    with pytest.raises(UserError, match="did you mean 'sobol'"):
        bench(model, model.parameters(), method="sobl")
    with pytest.raises(UserError, match="must be above 0"):
        bench(model, model.parameters(), method="auto", seconds=0.0)


def test_an_albedo_of_zero_has_no_relative_error() -> None:
    model = mb.load("lambert")
    with pytest.raises(UserError, match="reflects nothing"):
        bench(model, model.parameters(albedo=0.0))


def test_a_users_file_is_measured_against_its_own_f(
    cli: Callable, user_file: Callable, tmp_path: Path
) -> None:
    """A = 2 pi k/3, which the file does not say."""
    data, picture = tmp_path / "time.json", tmp_path / "time.svg"
    done = cli(
        "bench", "--model", user_file(USER), "-p", "k=0.3", "--method", "auto,cosine x lattice",
        "--quick", "--export", data, "--plot", picture,
    )  # fmt: skip
    assert done.code == 0, done.err
    read = json.loads(data.read_text())
    assert read["reference"]["value"] == pytest.approx(2.0 * math.pi * 0.3 / 3.0, rel=1e-8)
    assert {t["method"] for t in read["timings"]} == {"auto", "cosine x lattice"}
    assert {*read["targets"]} == {f"{t:g}" for t in TARGETS}
    assert "fastest" in done.out and "cosine x lattice" in done.out
    assert "my_brdf.py(k=0.3) at 60" in done.out and "auto" in picture.read_text()
    assert max(map(len, done.out.splitlines())) <= 80


def test_the_data_replaces_the_tables_on_request(cli: Callable) -> None:
    done = cli("bench", "--model", "lambert", "--method", "auto", "--quick", "--json")
    assert done.code == 0 and json.loads(done.out)["model"] == "lambert"


@pytest.mark.parametrize(
    ("arguments", "code", "sentence"),
    [
        (("--model", "gxx"), 2, "did you mean 'ggx'"),
        (("--model", "lambert", "--method", "oen"), 2, "did you mean 'own'"),
        (("--model", "lambert", "--theta-o", "95"), 2, "[0, 90)"),
        (("--model", "lambert", "-p", "albedo=0.1,0.2"), 2, "one parameter set, not 2"),
        (("--model", "lambert", "--seconds", "0"), 2, "must be above 0"),
        (("--model", "lambert", "--plot", "time.gif"), 2, ".png, .svg or .pdf"),
        (("--model", "lambert", "--export", "/nowhere/time.json"), 5, "cannot write"),
        ((), 2, "--model"),
    ],
)
def test_a_mistake_is_one_sentence(
    cli: Callable, arguments: tuple[str, ...], code: int, sentence: str
) -> None:
    done = cli("bench", *arguments)
    assert done.code == code and sentence in done.err
    assert len(done.err.splitlines()) == 1 and not done.out


def test_a_picture_holds_every_method_and_exact_errors() -> None:
    methods = ["auto", *(f"{s} x {q}" for s in ("mirror", "panels", "uniform", "cosine", "own")
                         for q in ("independent", "stratified", "sobol", "lattice"))]  # fmt: skip
    timings = [Timing(m, None, 256, 0.0, 1e-4)._asdict() for m in methods]
    data = {
        "model": "a_model_of_many_parameters",
        "params": {f"parameter_{k}": 0.123456 for k in range(12)},
        "where": {"theta_o_deg": 60.0},
        "reference": {"value": 1.0, "relative_error": 1e-15},
        "methods": methods,
        "timings": timings,
    }
    figure = report.figure(data)
    figure.draw_without_rendering()
    page = figure.bbox
    for part in (figure.legends[0], figure.axes[0].title):  # nothing is cut
        box = part.get_window_extent()
        assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1
    assert not figure.legends[0].get_window_extent().overlaps(figure.axes[0].get_window_extent())
    assert [t.get_text() for t in figure.legends[0].get_texts()][: len(methods)] == methods
