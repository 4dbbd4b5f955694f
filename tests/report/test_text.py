"""What is said in words: once, about whom, and with numbers that say no more than is known."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

from conftest import Outcome

from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.report import text

MISSING = "A / c = pi: the factor 1/pi is missing"


def failing(check: str, *hints: str) -> Result:
    found = [
        Finding("A", {"theta_o_deg": 10.0 * k}, Verdict.FAIL, value=2.0, stderr=0.1, samples=9,
                hint=hint, reproduce=f"brdf-check run --check {check}")
        for k, hint in enumerate(hints)
    ]  # fmt: skip
    return Result("my.py", {}, check, found)


def test_a_sentence_is_said_once_with_all_it_is_about() -> None:
    first = "4096 draws without a pdf (first at u = (0.25, 0.5, 0.75))"
    second = "4096 draws without a pdf (first at u = (0.125, 1e-05, 0.5))"
    rows = [failing("furnace", MISSING, MISSING), failing("energy", MISSING)]
    rows += [failing("pdf", first, second)]
    lines = text.render(Report(Command.RUN, {}, rows)).splitlines()
    told = [line for line in lines if line.startswith(("  hint", "  repro"))]
    assert told == [
        f"  hint  furnace, energy: {MISSING} (2 places)",
        f"  hint  pdf: {first} (2 places)",
        "  repro brdf-check run --check furnace",
        "  repro brdf-check run --check energy",
        "  repro brdf-check run --check pdf",
    ]


def test_numbers_say_what_is_known() -> None:
    def shown(value: float, expected: float, stderr: float = 0.0) -> str:
        return Finding("x", {}, Verdict.PASS, "at most", value, stderr, expected, 1e-6).number

    assert shown(5.25115716392344e-16, 0.0) == "0"
    assert shown(1.36509267896942e-09, 0.0) == "1.4e-09(0)"
    assert shown(math.pi / 2, 1.0) == "1.5707963(0)"
    assert shown(4.20488e-40, 0.0, 1.6e-44) == "4.20488(16)e-40"
    assert Finding("load", {}, Verdict.ERROR).number == ""


def test_samples_are_no_more_than_were_allowed(cli: Callable[..., Outcome]) -> None:
    out = cli("run", "--model", "lambert", "--samples", 4096, "--check", "furnace,energy").out
    assert "up to 4096 samples a claim" in out


def test_a_colours_channel_has_its_name(cli: Callable[..., Outcome]) -> None:
    out = cli("furnace", "--model", "lambert", "-p", "albedo=0.5/1", "--theta-o", 0).out
    assert "channel" in out.splitlines()[1]


def test_a_parameter_may_be_called_like_a_column(
    cli: Callable[..., Outcome], user_file: Callable[..., Path]
) -> None:
    params = "from typing import NamedTuple\nclass Params(NamedTuple):\n    channel: float = 0.5\n"
    path = user_file(f"{params}def f(wo, wi, p):\n    return 0.1 * p.channel\n")
    outcome = cli("run", "--model", path, "--check", "isotropy", "-p", "channel=0.25")
    assert outcome.code == 0 and "(channel=0.25)" in outcome.out


def test_too_few_samples_for_anything_are_told(cli: Callable[..., Outcome]) -> None:
    outcome = cli("converge", "--model", "lambert", "--samples", 1)
    assert outcome.code == 2 and "samples must be at least 4096" in outcome.err


def test_what_is_safe_nowhere_is_no_number() -> None:
    where = {"precision": "float16"}
    lost = Finding("smallest safe alpha", where, Verdict.KNOWN, note="none is safe")
    measured = {
        "name": "float16", "eps": 1e-3, "points": 9, "worst": 1.0, "allowed": 0.1, "nan": 0,
        "with_inputs": 1.0, "inf": 0, "negative": 0, "flushed": 0, "parameter": "alpha",
        "safe": math.nan, "length": None,
    }  # fmt: skip
    rows = [Result("m", {}, "stability", [lost])]
    out = text.render(Report(Command.STRESS, {}, rows, {"precisions": [[measured]]}))
    assert "float16: smallest safe alpha: none is safe" in out and "nan" not in out
