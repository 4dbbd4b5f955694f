"""Every format is a pure function of the report, and what its readers accept."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from conftest import Outcome
from junit_rules import RULES, faults

from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.report import formats

PLACE = {"theta_o_deg": 45.0}
SOURCE = {"file": "my,brdf.py", "line": 7}
NASTY = 'a <b> & "c" | d, e: 100 %\nnext \x00 \x1b line ]]> *bold*'


def finding(verdict: str, quantity: str = "A <= 1", **more: object) -> Finding:
    numbers = {"value": 1.05, "stderr": 0.001, "expected": 1.0, "tolerance": 1e-5, "samples": 1024}
    return Finding(quantity, dict(PLACE), verdict, "at most", **{**numbers, **more})  # type: ignore[arg-type]


def report(**settings: object) -> Report:
    """All verdicts there are, and text that is hard to write."""
    findings = [
        finding("pass"),
        finding(
            "fail", hint=NASTY, reproduce="brdf-check run --model my_brdf.py --check 'furnace'"
        ),
        finding("fail", value=math.nan, stderr=math.inf),
        finding("known", note="published so"),
        finding("inconclusive", note="undecided at 1024 samples"),
        finding("error", note="raised"),
        Finding("equality", {}, "skipped", note="nothing to compare with"),
    ]
    rows = [
        Result("my_brdf.py", {"alpha": 0.1, "f0": (1.0, 0.5)}, "furnace", findings, [], SOURCE),
        Result("my_brdf.py", {"alpha": 0.1, "f0": (1.0, 0.5)}, "pdf", [finding("pass", NASTY)]),
        Result("", {}, "identities", [finding("pass")]),
        Result("empty", {}, "furnace", []),
    ]
    return Report(Command.RUN, {"seed": 0, "points": "sobol", "samples": 1024, **settings}, rows)


@pytest.mark.parametrize("name", formats.SUFFIXES)
def test_formats_are_pure(name: str) -> None:
    assert formats.render(report(), name) == formats.render(report(), name) != ""
    assert formats.render(Report(Command.RUN, {}, []), name)


def junit(one: Report) -> ElementTree.Element:
    return ElementTree.fromstring(formats.render(one, "junit"))


def test_junit_keeps_the_rules() -> None:
    assert faults(junit(report())) == []


@pytest.mark.parametrize(
    "text",
    [
        "<html/>",
        "<testsuites><testcase name='a'/></testsuites>",
        "<testsuite name='a' tests='1' failures='0' errors='0'/>",
        "<testsuite tests='0' failures='0' errors='0'/>",
        "<testsuite name='a' tests='0' failures='0' errors='0'>text</testsuite>",
        "<testsuite name='a' tests='0' failures='0' errors='0' time='1e3'/>",
        "<testsuites><property name='a' value='b'/></testsuites>",
    ],
)
def test_the_rules_see_faults(text: str) -> None:
    assert faults(ElementTree.fromstring(text))
    assert all(child in RULES for _, _, children in RULES.values() for child in children)


def test_junit_counts_and_names() -> None:
    root = junit(report())
    assert [root.get(k) for k in ("tests", "failures", "errors")] == ["9", "2", "2"]
    for suite in root:
        names = [(t.get("classname"), t.get("name")) for t in suite.iter("testcase")]
        assert len(set(names)) == len(names)
    failure = next(root.iter("failure"))
    assert "1.0500(10)" in str(failure.get("message")) and "f: my,brdf.py:7" in str(failure.text)


def test_junit_calls_a_worst_case_the_same_wherever_it_was_found() -> None:
    def names(*angles: float) -> list[str | None]:
        found = [Finding("A", {"theta_o_deg": a}, "pass") for a in angles]
        suite = junit(Report(Command.RUN, {}, [Result("m", {}, "c", found)]))[0]
        return [test.get("name") for test in suite.iter("testcase")]

    assert names(12.5) == names(80.0) == ["A"]
    assert names(0.0, 45.0) == ["A theta_o 0°", "A theta_o 45°"]


@pytest.mark.parametrize(("policy", "tag"), [("pass", "skipped"), ("fail", "failure")])
def test_junit_follows_the_policy_for_inconclusive(policy: str, tag: str) -> None:
    tests = junit(report(inconclusive=policy)).iter("testcase")
    assert [c.tag for t in tests for c in t if c.get("type") == "inconclusive"] == [tag]


def test_junit_says_why_nothing_was_evaluated() -> None:
    late = Finding("furnace", {}, "inconclusive", note="not begun: --max-time was over")
    root = junit(Report(Command.RUN, {}, [Result("ggx", {}, "furnace", [late])]))
    assert next(root.iter("error")).get("message") == late.note


def decoded(line: str) -> tuple[str, dict[str, str], str]:
    """A workflow command as the runner reads it."""
    found = re.fullmatch(r"::(\w+) (.*?)::(.*)", line)
    assert found
    pairs = (pair.split("=", 1) for pair in found[2].split(","))
    plain = {k: v.replace("%3A", ":").replace("%2C", ",").replace("%25", "%") for k, v in pairs}
    return found[1], plain, found[3].replace("%0A", "\n").replace("%25", "%")


def test_github_points_at_the_line_of_f() -> None:
    *commands, last = formats.render(report(), "github").splitlines()
    levels = [decoded(c)[0] for c in commands]
    assert levels == ["error"]  # one for each check that needs attention
    level, place, message = decoded(commands[0])
    assert (place["file"], place["line"]) == ("my,brdf.py", "7")
    assert "furnace: error" in place["title"] and "raised" in message
    assert last.startswith("brdf-check run: error;")


def test_github_shows_the_worst_first_and_on_its_function() -> None:
    source = {"file": "my.py", "line": 7, "functions": {"f": 7, "sample": 12, "pdf": 20}}
    failing = [finding("fail", hint=NASTY), finding("fail"), finding("pass")]
    checks = {"energy": [finding("known")], "pdf": failing, "sampling": failing}
    rows = [Result("my.py", {}, name, found, [], source) for name, found in checks.items()]
    *commands, _ = formats.render(Report(Command.RUN, {}, rows), "github").splitlines()
    told = [decoded(c) for c in commands]
    assert [(level, place["line"]) for level, place, _ in told] == [
        ("error", "20"), ("error", "12"), ("notice", "7")
    ]  # fmt: skip
    assert "100 %\nnext" in told[0][2] and "and 1 more findings like it" in told[0][2]


def test_csv_has_a_row_per_finding() -> None:
    rows = list(csv.DictReader(io.StringIO(formats.render(report(), "csv"))))
    assert len(rows) == 9
    assert float(rows[0]["value"]) == 1.05 and rows[2]["value"] == ""
    assert rows[0]["params"] == "alpha=0.1 f0=1/0.5" and rows[1]["hint"] == NASTY


def test_markdown_tables_hold_together() -> None:
    text = formats.render(report(), "markdown")
    widths = {len(re.findall(r"(?<!\\)\|", r)) for r in text.splitlines() if r.startswith("|")}
    assert widths == {7}
    assert "`brdf-check run --model my_brdf.py --check 'furnace'`" in text and "<b>" not in text


def test_exports_and_step_summary(
    cli: Callable[..., Outcome], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    summary = tmp_path / "summary.md"
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    files = [tmp_path / f"report{suffix}" for suffix in formats.suffixes()]
    exports = [word for file in files for word in ("--export", file)]
    done = cli(
        "identities", "--samples", "2^14", "--tolerance", "0.1", "--format", "github", *exports
    )
    assert (
        done.code == 0 and done.out == "brdf-check identities: pass; 9 pass\n" or "pass" in done.out
    )
    assert summary.read_text(encoding="utf-8").startswith("## brdf-check identities: PASS")
    texts = {file.suffix: file.read_text(encoding="utf-8") for file in files}
    assert json.loads(texts[".json"])["verdict"] == "pass"
    assert faults(ElementTree.fromstring(texts[".xml"])) == []
    assert texts[".md"] == summary.read_text(encoding="utf-8")


def test_a_suffix_nobody_knows(cli: Callable[..., Outcome], tmp_path: Path) -> None:
    done = cli("identities", "--export", tmp_path / "report.xlsx")
    assert done.code == 2 and ".csv" in done.err and ".xml" in done.err
    assert cli("identities", "--export", tmp_path / "no" / "a.xml").code == 5
