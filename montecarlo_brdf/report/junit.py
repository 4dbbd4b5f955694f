"""JUnit XML as Jenkins, GitLab and GitHub's report actions read it.

A test suite is a model with its parameters, a test case one finding. A refuted claim is a failure,
a model that could not be run an error; an inconclusive finding is an error too, as the run does not
exit with 0, unless --inconclusive says what it counts as. A known one passes, its reason in
system-out.
"""
from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from montecarlo_brdf.judge.finding import Finding, Policy, Report, Result, Verdict
from montecarlo_brdf.report import refuted
from montecarlo_brdf.report.text import (
    case,
    diagnosed,
    explanation,
    grouped,
    origin,
    place,
    statement,
)

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis

OUTCOMES = {Verdict.FAIL: "failure", Verdict.ERROR: "error", Verdict.SKIPPED: "skipped"}
INCONCLUSIVE: dict[str | None, str] = {Policy.PASS: "skipped", Policy.FAIL: "failure"}
#: characters that XML has no way to write
FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def render(report: Report) -> str:
    """The whole report as one <testsuites>."""
    undecided = INCONCLUSIVE.get(report.settings.get("inconclusive"), "error")
    outcomes = {**OUTCOMES, Verdict.INCONCLUSIVE: undecided}
    root = Element("testsuites", name=f"brdf-check {report.command}")
    times = iter(_times(report))
    for group in grouped(report.results):
        _suite(root, group, report, outcomes, [next(times) for _ in group])
    root.set("time", f"{float(report.measured.get('seconds') or 0.0):.3f}")
    counts = [_counts(suite) for suite in root]
    for name in ("tests", "failures", "errors"):
        root.set(name, str(sum(c[name] for c in counts)))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _suite(
    root: Element, group: list[Result], report: Report, outcomes: dict[Verdict, str],
    times: Sequence[float],
) -> None:  # fmt: skip
    name = _legal(case(group[0]) or group[0].check)
    suite = SubElement(root, "testsuite", name=name, time=f"{math.fsum(times):.3f}")
    properties = SubElement(suite, "properties")
    for key in ("seed", "samples", "points"):
        value = str(report.settings.get(key, ""))
        SubElement(properties, "property", name=key, value=value)
    found = diagnosed(report, group[0])
    for result, seconds in zip(group, times, strict=True):
        each = f"{seconds / max(1, len(result.findings)):.4f}"
        # a dot separates packages in a class name, so those of numbers and file names must go
        owner = f"{name.replace('.', '_')}.{result.check}" if result.model else result.check
        for finding, title in zip(result.findings, _titles(result), strict=True):
            test = SubElement(suite, "testcase", classname=owner, name=title, time=each)
            _tell(test, result, finding, outcomes.get(finding.verdict), found)
    for key, number in _counts(suite).items():
        suite.set(key, str(number))


def _times(report: Report) -> list[float]:
    """Seconds of each check: what one is asked shares its time evenly."""
    times = report.measured.get("seconds_of_results")
    known = isinstance(times, list) and len(times) == len(report.results)
    return [float(t) for t in times] if known else [0.0] * len(report.results)  # type: ignore[union-attr]


def _titles(result: Result) -> list[str]:
    """A name for every finding, and no name twice: readers merge cases of equal names.

    They follow a case by its name from run to run, so the place is in it only where it tells
    findings of a quantity apart: that of a worst case is another one after any change.
    """
    alike = Counter(f.quantity for f in result.findings)
    seen: Counter[str] = Counter()
    titles = []
    for f in result.findings:
        title = " ".join(filter(None, (f.quantity, place(f) if alike[f.quantity] > 1 else "")))
        seen[title] += 1
        titles.append(_legal(title if seen[title] == 1 else f"{title} ({seen[title]})"))
    return titles


def _tell(
    test: Element, result: Result, finding: Finding, outcome: str | None, found: Diagnosis | None
) -> None:
    text = _legal("\n".join([statement(finding), *explanation(finding), *origin(result)]))
    if outcome:
        # readers show the message alone: of what was never evaluated only the note tells anything
        told_by_note = outcome == "skipped" or finding.samples is None
        message = finding.note or finding.verdict if told_by_note else statement(finding)
        if blame := refuted.blame(found, finding):
            message = f"{blame}; {message}"
        SubElement(test, outcome, type=finding.verdict, message=_legal(message)).text = text
    else:
        SubElement(test, "system-out").text = text


def _counts(suite: Element) -> dict[str, int]:
    found = {"tests": "testcase", "failures": "failure", "errors": "error", "skipped": "skipped"}
    return {name: len(list(suite.iter(tag))) for name, tag in found.items()}


def _legal(text: str) -> str:
    return FORBIDDEN.sub("\ufffd", text)
