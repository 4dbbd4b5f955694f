"""The difference of two reports, and when it fails a run."""

from __future__ import annotations

from pathlib import Path

import pytest

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.report import baseline
from montecarlo_brdf.report.json import read_report


def report(*verdicts: str, theta: float = 0.0, command: str = "run") -> Report:
    """A report with one finding per verdict."""
    findings = [Finding("A", {"theta_o_deg": theta + k}, v) for k, v in enumerate(verdicts) if v]
    results = [Result("m", {"f0": (1.0, 0.5)}, "furnace", findings)]
    return Report(Command(command), {}, results)


def again(one: Report, folder: Path) -> Report:
    """A report as its JSON file gives it back."""
    path = folder / "report.json"
    path.write_text(one.to_json(), encoding="utf-8")
    return read_report(path)


@pytest.mark.parametrize(
    ("before", "now", "kind", "code"),
    [
        ("pass", "pass", None, 0),
        ("fail", "fail", None, 0),
        ("pass", "fail", "new failure", 1),
        ("known", "fail", "new failure", 1),
        ("inconclusive", "fail", "new failure", 1),
        ("pass", "error", "new failure", 4),
        ("fail", "error", "new failure", 4),
        ("", "fail", "new failure", 1),
        ("pass", "inconclusive", "newly undecided", 3),
        ("fail", "inconclusive", "changed", 0),
        ("fail", "pass", "fixed", 0),
        ("inconclusive", "known", "fixed", 0),
        ("pass", "known", "changed", 0),
        ("pass", "", "gone", 0),
        ("", "pass", None, 0),
        ("", "known", "new", 0),
    ],
)
def test_kinds_and_codes(
    before: str, now: str, kind: str | None, code: int, tmp_path: Path
) -> None:
    found = baseline.changes(report("pass", now), again(report("pass", before), tmp_path))
    assert [c.kind for c in found] == ([kind] if kind else [])
    assert baseline.exit_code(found) == code


def test_a_worst_case_found_elsewhere_is_the_same_finding() -> None:
    assert baseline.changes(report("fail", theta=10.0), report("fail", theta=20.0)) == []
    (change,) = baseline.changes(report("fail", theta=10.0), report("pass", theta=20.0))
    assert str(change) == "new failure: m furnace A theta_o_deg=10.0 (pass -> fail)"


def test_the_worst_comes_first() -> None:
    found = baseline.changes(report("pass", "inconclusive", "fail"), report("fail", "pass", "pass"))
    assert [c.kind for c in found] == ["new failure", "newly undecided", "fixed"]


def test_reports_of_different_commands() -> None:
    with pytest.raises(UserError, match="report of furnace, this is one of run"):
        baseline.changes(report("pass"), report("pass", command="furnace"))


def test_what_still_fails_by_another_value_is_told() -> None:
    def of(value: float, verdict: str = "fail") -> Report:
        found = [Finding("A", {"theta_o_deg": 0.0}, verdict, value=value, stderr=1e-3)]
        return Report(Command.RUN, {}, [Result("m", {}, "furnace", found)])

    assert baseline.moved(of(1.2), of(1.3)) == [
        "still fail: m furnace A theta_o_deg=0.0: 1.3000(10) -> 1.2000(10)"
    ]
    assert baseline.moved(of(1.2), of(1.2)) == []
    assert baseline.moved(of(0.7, "pass"), of(0.8, "pass")) == []
    assert baseline.moved(of(1.2), of(0.9, "pass")) == []
