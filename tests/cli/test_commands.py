"""The command line: options, values, exit codes, help, completion, the terminal."""
from __future__ import annotations

import json
import math
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import pytest
from conftest import Outcome
from hypothesis import given
from hypothesis import strategies as st

from montecarlo_brdf import __version__, load
from montecarlo_brdf.cli._options import WHOLE, numbers, parameter_sets
from montecarlo_brdf.errors import UserError

Command = Callable[..., Outcome]

QUICK = ("--theta-o", "30", "--sampler", "cosine", "--samples", "2^14")


def findings(outcome: Outcome) -> list[dict[str, Any]]:
    return [f for r in json.loads(outcome.out)["results"] for f in r["findings"]]


def test_lambert_passes(cli: Command) -> None:
    outcome = cli("furnace", "--model", "lambert")
    assert outcome.code == 0 and outcome.out.splitlines()[-1].startswith("PASS")


def test_a_missing_pi_fails_and_is_named(cli: Command) -> None:
    broken = cli("furnace", "--model", "lambert_unnormalised", "-p", "c=0.5")
    assert broken.code == 1
    assert "A / c = pi: the factor 1/pi is missing" in broken.out
    assert "1.5707963(0)" in broken.out
    assert cli("furnace", "--model", "lambert_unnormalised").code == 0  # c = 0.25 < 1/pi


def test_inconclusive_has_its_own_code(cli: Command) -> None:
    few = ("furnace", "--model", "ggx", "--theta-o", 30, "--sampler", "own", "--samples", 16)
    assert cli(*few).code == 3
    assert cli(*few, "--inconclusive", "pass").code == 0
    assert cli(*few, "--inconclusive", "fail").code == 1


def test_inconclusive_option_never_hides_a_failure(cli: Command) -> None:
    broken = ("furnace", "--model", "lambert_unnormalised", "-p", "c=0.5", *QUICK)
    assert cli(*broken, "--inconclusive", "pass").code == 1


def test_identities_hold(cli: Command) -> None:
    outcome = cli("identities", "--format", "json")
    assert outcome.code == 0
    exact = {f["quantity"]: f["expected"] for f in findings(outcome)}
    assert exact["int dw"] == 2.0 * math.pi and exact["int cos dw"] == math.pi
    for n in (2, 5, 20):
        assert exact[f"int cos^{n} dw"] == 2.0 * math.pi / (n + 1)
    assert {"area of the unit disk", "Phi_out/Phi_in under L = 1 + 2 cos"} <= set(exact)
    assert exact["A of f = C_d = 1/pi"] == 1.0
    for f in findings(outcome):
        assert abs(f["value"] - f["expected"]) < 10.0 * f["stderr"]  # t(15) > 10: once in 10^7


def test_lists_make_cases_and_slashes_a_colour(cli: Command) -> None:
    lambert = ("furnace", "--model", "lambert", "--format", "json", *QUICK)
    cases = json.loads(cli(*lambert, "-p", "albedo=0.1,0.2,0.3").out)["results"]
    assert [r["params"]["albedo"] for r in cases] == [0.1, 0.2, 0.3]
    (colour,) = json.loads(cli(*lambert, "-p", "albedo=0.9/0.5/0.1").out)["results"]
    values = {f["where"]["channel"]: f["value"] for f in colour["findings"]}
    assert values == pytest.approx({0: 0.9, 1: 0.5, 2: 0.1}, rel=1e-14)


def test_the_seed_decides_and_a_random_one_is_told(cli: Command) -> None:
    ggx = ("furnace", "--model", "ggx", "--format", "json", "--theta-o", 30, "--sampler", "own")
    ggx = (*ggx, "--samples", "2^14")
    values = [findings(cli(*ggx, "--seed", s))[0]["value"] for s in (1, 2, 1)]
    assert values[0] == values[2] != values[1]
    drawn = cli(*ggx, "--seed", "random")
    told = re.fullmatch(r"seed (\d+)\n", drawn.err)
    assert told is not None
    assert findings(cli(*ggx, "--seed", told[1])) == findings(drawn)


def test_tolerance_turns_the_verdict(cli: Command) -> None:
    """A bound of 1 exceeded by 0.57 holds with a tolerance of 0.6: it is stated, so it counts."""
    broken = ("furnace", "--model", "lambert_unnormalised", "-p", "c=0.5", *QUICK)
    assert (cli(*broken).code, cli(*broken, "--tolerance", 0.6).code) == (1, 0)


def test_options_come_from_the_environment_too(
    cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BRDF_CHECK_FURNACE_MODEL", "lambert")
    monkeypatch.setenv("BRDF_CHECK_FURNACE_FORMAT", "json")
    assert json.loads(cli("furnace", *QUICK).out)["results"][0]["model"] == "lambert"


def test_models_and_show(cli: Command) -> None:
    listed = cli("models")
    assert listed.code == 0 and "oren_nayar" in listed.out
    shown = cli("show", "oren_nayar")
    assert shown.code == 0 and "reference: " in shown.out
    for words in ("Oren & Nayar 1994", "[1/sr]", "sigma=0.35 in [0, 1.5708]", "disclaims energy"):
        assert words in shown.out


def test_version(cli: Command) -> None:
    assert cli("--version") == (0, f"brdf-check, version {__version__}\n", "")


def test_help_is_offered_when_nothing_is_asked(cli: Command) -> None:
    asked, nothing = cli("--help"), cli()
    assert (asked.code, asked.err) == (0, "") and asked.out.startswith("Usage: brdf-check")
    assert nothing.code == 2 and "furnace" in nothing.err
    assert cli("-h").out == asked.out


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shell_completion_is_offered(shell: str, process: Command) -> None:
    outcome = process(_BRDF_CHECK_COMPLETE=f"{shell}_source")
    assert outcome.code == 0 and "brdf-check" in outcome.out


def test_completion_knows_commands_and_models(process: Command) -> None:
    complete = {"_BRDF_CHECK_COMPLETE": "bash_complete", "COMP_CWORD": "1"}
    assert "furnace" in process(COMP_WORDS="brdf-check fur", **complete).out
    complete["COMP_CWORD"] = "3"
    outcome = process(COMP_WORDS="brdf-check furnace --model lam", **complete)
    assert "lambert_unnormalised" in outcome.out


IMPORTED = """
import sys
from montecarlo_brdf.cli import execute as run
code = run(sys.argv[1:])
print(*[m for m in ("numba", "scipy", "matplotlib", "numpy", "rich") if m in sys.modules])
sys.exit(code)
"""


def imported(*arguments: str) -> list[str]:
    """Slow packages that a command imported."""
    command = [sys.executable, "-c", IMPORTED, *arguments]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=True)
    return done.stdout.splitlines()[-1].split()


def test_help_imports_nothing_slow() -> None:
    assert imported("--help") == []
    assert imported("furnace", "--help") == []


def test_a_warm_run_imports_neither_compiler_nor_plots() -> None:
    imported("furnace", "--model", "lambert", *QUICK)
    assert not {"numba", "scipy", "matplotlib", "rich"} & set(
        imported("furnace", "--model", "lambert", *QUICK)
    )


def test_a_reader_that_stops_early_is_no_pass() -> None:
    """`brdf-check ... | head -0`: no traceback, and not the exit code of a pass."""
    command = [sys.executable, "-m", "montecarlo_brdf", "models"]
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        command, stdout=writing, stderr=subprocess.PIPE, encoding="utf-8", check=False
    )
    os.close(writing)
    assert (done.returncode, done.stderr) == (5, "")


def test_colour_only_where_it_is_wanted(process: Command) -> None:
    lambert = ("furnace", "--model", "lambert", *QUICK)
    assert "\x1b[" not in process(*lambert).out
    assert "\x1b[" in process(*lambert, FORCE_COLOR="1").out
    assert "\x1b[3" not in process(*lambert, FORCE_COLOR="1", NO_COLOR="1").out


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0,30,60", [0.0, 30.0, 60.0]),
        ("0:80:5", [0.0, 20.0, 40.0, 60.0, 80.0]),
        ("0:20:3,45, 60", [0.0, 10.0, 20.0, 45.0, 60.0]),
        ("0.01:1:log3", [0.01, 0.1, 1.0]),
        ("1e-3", [1e-3]),
    ],
)
def test_lists_and_ranges(text: str, expected: list[float]) -> None:
    assert numbers(text, "x") == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "expected"),
    [("65536", 65536), ("2^16", 65536), ("1e6", 10**6), ("1_000", 1000), ("-3", -3), ("+5", 5)],
)
def test_whole_numbers(text: str, expected: int) -> None:
    assert WHOLE.convert(text, None, None) == expected


@given(st.text(max_size=12))
def test_any_text_is_a_number_or_a_sentence(text: str) -> None:
    import click

    try:
        found = numbers(text, "x")
        assert all(math.isfinite(v) for v in found)
    except UserError as error:
        assert "x" in str(error)
    try:
        assert isinstance(WHOLE.convert(text, None, None), int)
    except click.BadParameter as error:
        assert "not a whole number" in error.message


@given(st.text(max_size=12))
def test_any_assignment_is_a_parameter_set_or_a_sentence(text: str) -> None:
    model = load("lambert")
    try:
        for p in parameter_sets(model, [f"albedo={text}"]):
            values = p.albedo if isinstance(p.albedo, tuple) else (p.albedo,)
            assert all(0.0 <= v <= 1.0 for v in values)
    except UserError as error:
        assert "\n" not in str(error)


def test_main_ends_the_process_with_the_code(process: Command) -> None:
    assert process("furnace", "--model", "lamber").code == 2
    assert process("furnace", "--model", "lambert_unnormalised", "-p", "c=0.5", *QUICK).code == 1


@pytest.mark.skipif(os.name == "nt", reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_closed_streams_are_no_error(closed: str) -> None:
    command = f"{shlex.quote(sys.executable)} -m montecarlo_brdf models {closed}"
    assert subprocess.run(["sh", "-c", command], capture_output=True).returncode == 0


def test_checks_may_be_named_one_by_one(cli: Command) -> None:
    line = ("run", "--model", "lambert", "--effort", 0.01, "--check", "isotropy,positivity")
    told = cli(*line, "--check", "reciprocity", "--check", "isotropy", "--format", "json")
    checks = [result["check"] for result in json.loads(told.out)["results"]]
    assert told.code == 0 and checks == ["positivity", "reciprocity", "isotropy"]
    assert "'all' stands alone" in cli(*line, "--check", "all").err
