"""What a terminal of 80, 60 or 40 columns shows: every estimate whole, no table wider than it."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.report import text
from montecarlo_brdf.report.json import read_report

pytestmark = pytest.mark.skipif(os.name == "nt", reason="needs a pseudo-terminal")

STYLE = re.compile(r"\x1b\[[\d;]*m")
#: What may be longer than a line: sentences, which the terminal wraps, and the title of a table.
SENTENCE = re.compile(r"  (?!float)\S|  float\d+: |(PASS|FAIL|INCONCLUSIVE)  |\S+\(.*\)")
USER = """
import math


def f(wo, wi, p):
    s = max(0.0, wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1])
    return 0.3 / math.pi + 0.9 * s**12
"""
COMMANDS = {
    "furnace lambert": "furnace --model lambert --theta-o 0,60",
    "furnace ggx": "furnace --model ggx -p f0=0.5/1 --theta-o 30 --samples 2^14",
    "run": "run --model my_brdf.py --check furnace,reciprocity,energy,equality --theta-o 45 "
    "--samples 2^12",
    "run -v": "run --model lambert -v --check furnace,energy,pdf --theta-o 45 --samples 2^12",
    "radiance": "radiance --model my_brdf.py --environment cosine:8 --samples 2^12",
    "converge": "converge --model ggx --samples 2^14 --sampler cosine",
    "stress": "stress --compare ggx textbook_ggx --quick --precision float32,float64",
}


def at_terminal(command: str, columns: int, folder: Path) -> list[str]:
    """The lines that a command prints on a terminal of some columns."""
    import fcntl
    import pty
    import struct
    import termios

    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    unset = ("COLUMNS", "NO_COLOR", "FORCE_COLOR")
    environment = {k: v for k, v in os.environ.items() if k not in unset}
    process = subprocess.Popen(
        [sys.executable, "-m", "montecarlo_brdf", *command.split()],
        stdout=theirs,
        stderr=subprocess.DEVNULL,
        cwd=folder,
        env={**environment, "TERM": "xterm", "PYTHONUTF8": "1"},
    )
    os.close(theirs)
    found = b""
    try:
        while part := os.read(ours, 65536):
            found += part
    except OSError:  # Linux's way to say that the other end is closed
        pass
    os.close(ours)
    assert process.wait() in (0, 1, 3)
    return found.decode().replace("\r\n", "\n").splitlines()


def estimates(report: Report, verbose: bool) -> list[str]:
    """As the table must show them."""
    shown = [f for r in report.results for f in r.findings]
    if report.command == "run" and not verbose:
        shown = [text.most_telling(r) for r in report.results]
    if report.command == "stress":
        shown = [f for f in shown if f.quantity == "error of f"]
    known = [f for f in shown if math.isfinite(f.value)]
    return [f"{f.value:.1e}" if report.command == "stress" else f.number for f in known]


@pytest.mark.parametrize("name", COMMANDS)
def test_no_estimate_is_torn(name: str, tmp_path: Path) -> None:
    (tmp_path / "my_brdf.py").write_text(USER, encoding="utf-8")
    command = f"{COMMANDS[name]} --export-json report.json"
    shown = {40: at_terminal(command, 40, tmp_path)}
    report = read_report(tmp_path / "report.json")
    verbose = "-v" in command
    for columns in (60, 80):
        if name == "stress":  # JSON does not give back what is not finite
            shown[columns] = at_terminal(command, columns, tmp_path)
        else:
            shown[columns] = text.render(report, verbose, columns, colour=True).splitlines()
    for columns, coloured in shown.items():
        assert any("\x1b[" in line for line in coloured)
        lines = [STYLE.sub("", line) for line in coloured]
        words = [set(line.split()) for line in lines]
        found = estimates(report, verbose)
        assert found and [n for n in found if not any(n in line for line in words)] == []
        assert [x for x in lines if len(x) > columns and not SENTENCE.match(x)] == []


def test_a_place_where_nothing_happened_is_not_told() -> None:
    place = {"albedo": 0.8, "theta_o_deg": 30.0}
    numbers = {"stderr": 0.0, "expected": 0.0, "tolerance": 1e-6, "samples": 9}

    def shown(value: float) -> str:
        found = Finding("|f - f'|", place, "pass", "at most", value, **numbers)  # type: ignore[arg-type]
        return text.render(Report(Command.RUN, {}, [Result("m", {}, "reciprocity", [found])]))

    assert "theta_o" not in shown(0.0) and "theta_o 30°" in shown(1e-7)


@pytest.mark.parametrize(
    ("environment", "coloured"),
    [
        ({}, False),
        ({"FORCE_COLOR": "1"}, True),
        ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ({"FORCE_COLOR": "1", "TERM": "dumb"}, False),
    ],
)
def test_colours(
    environment: dict[str, str], coloured: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    from montecarlo_brdf.cli import _terminal

    for name in ("FORCE_COLOR", "NO_COLOR"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert _terminal.colour() is coloured
