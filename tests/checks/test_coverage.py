"""What a run says of lines that were not run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.checks import coverage

Command = Callable[..., Outcome]
Write = Callable[..., Path]

NEVER = """
import ctypes

hypot = ctypes.CDLL(None).hypot
hypot.restype, hypot.argtypes = ctypes.c_double, [ctypes.c_double] * 2

def f(wo, wi, p):
    if wo[2] > 1.5:
        return 3.0
    return 0.1 {}
"""


def said(cli: Command, path: Path) -> Outcome:
    return cli("run", "--model", path, "--check", "coverage", "--effort", 0.03)


def test_a_line_that_was_never_run_is_told_and_fails_nothing(
    cli: Command, user_file: Write
) -> None:
    outcome = said(cli, user_file(NEVER.format("")))
    assert outcome.code == 0
    assert "line 9 of f was never run, not even by a search for it (return 3.0)" in outcome.out


def test_a_function_of_c_has_no_lines(cli: Command, user_file: Write) -> None:
    text = NEVER.format("* hypot(wo[2], wi[2])").replace("wo[2] > 1.5", "wo[2] > 0.5")
    outcome = said(cli, user_file(text))
    assert outcome.code == 0 and "PASS  1 pass" in outcome.out


def test_models_that_come_with_the_program_are_not_asked(user_file: Write) -> None:
    assert not coverage.applies(mb.load("ggx"))
    assert not coverage.applies(mb.load("0.6 lambert + 0.4 ggx"))
    assert coverage.applies(mb.load(str(user_file(NEVER.format("")))))
