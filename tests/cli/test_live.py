"""Results appear on a terminal as they are decided, and are gone when the report comes."""
from __future__ import annotations

import io
from pathlib import Path

import pytest
from terminals import BEGIN, Session, screen

from montecarlo_brdf.cli import _live
from montecarlo_brdf.judge.finding import Finding, Result, Verdict

AT_ONCE = "from montecarlo_brdf.cli import _terminal as t; t.PATIENCE = t.INTERVAL = 0.0; "
MODEL = "import sys\nprint('a word of the model')\n\n\ndef f(wo, wi, p):\n    return -0.1\n"
QUESTION = ["run", "--model", "my.py", "--check", "positivity,isotropy", "--effort", "0.01"]
XTERM = {"TERM": "xterm", "NO_COLOR": "1", "COLUMNS": "118", "LINES": "40"}


def test_results_appear_and_are_gone(tmp_path: Path) -> None:
    (tmp_path / "my.py").write_text(MODEL)
    session = Session(tmp_path, AT_ONCE + BEGIN, *QUESTION, **XTERM)
    sent = session.rest()
    assert session.process.wait() == 1
    session.close()
    plain = Session(tmp_path, AT_ONCE + BEGIN, *QUESTION, **{**XTERM, "TERM": "dumb"})
    report = plain.rest()
    plain.close()
    assert "so far" not in report
    early, *_ = sent.partition("  cause ")
    assert "FAIL         positivity   smallest f / f around it -1(0), allowed >= 0" in early
    assert "pass         isotropy     1 claim\n" in early and "so far" in early and "##" in early
    assert screen(sent) == report


def result(check: str, verdict: str = "pass", model: str = "m") -> Result:
    return Result(model, {}, check, [Finding("A", {}, Verdict(verdict), value=1.0, samples=1)])


def test_a_board_keeps_what_needs_attention(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setenv("LINES", "6")
    board = _live.Board(colour=False)
    board.hear(result("pdf"), False)
    board.hear(result("energy", "fail"), True)
    assert [line.split() for line in board.lines()] == [
        ["...", "pdf", "1", "claim", "so", "far"],
        ["FAIL", "energy", "A:", "found", "1"],
    ]
    board.hear(result("pdf", model="other"), True)
    fail, passed = board.lines()
    assert fail.startswith("FAIL         m energy     A: found 1") and passed.startswith("pass")
    for k in range(9):
        board.hear(result(f"check{k}", model="a model with a long name"), True)
    assert len(board.lines()) == 4 and all(len(line) < 60 for line in board.lines())


def test_what_others_write_goes_above() -> None:
    terminal = io.StringIO()
    bottom = _live.Bottom(terminal)
    bottom.write("before\n")
    bottom.draw(["one", "two"], "bar")
    bottom.write("half a ")
    bottom.write("line\nand")
    assert screen(terminal.getvalue()) == "before\nhalf a line\none\ntwo\nbar"
    bottom.draw(["three"], "bar of more")
    assert screen(terminal.getvalue()) == "before\nhalf a line\nthree\nbar of more"
    bottom.clear()
    assert screen(terminal.getvalue()) == "before\nhalf a line\nand"
