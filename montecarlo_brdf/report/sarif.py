"""SARIF 2.1.0, which code scanning of GitHub, GitLab and editors reads: a result for each model and
check that needs attention, on the function that it is about."""

from __future__ import annotations

import json
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.judge.finding import Report, Result, Verdict
from montecarlo_brdf.report import refuted
from montecarlo_brdf.report.text import (
    case,
    diagnosed,
    explanation,
    line_of,
    most_telling,
    statement,
)

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"  # code scanning wants a name of it
LEVELS = {Verdict.ERROR: "error", Verdict.FAIL: "error"}
LEVELS |= {Verdict.INCONCLUSIVE: "warning", Verdict.KNOWN: "note"}
CONSEQUENCE = "note"  # of a cause that another result tells

if TYPE_CHECKING:
    from montecarlo_brdf.judge.diagnosis import Diagnosis


def render(report: Report) -> str:
    """The report as one run of a tool."""
    told = [r for r in report.results if r.verdict in LEVELS]
    rules = list(dict.fromkeys(r.check for r in report.results))
    driver: dict[str, Any] = {"name": "brdf-check", "rules": list(map(_rule, rules))}
    if version := report.to_dict()["versions"].get("montecarlo_brdf"):
        driver["version"] = version
    run = {
        "tool": {"driver": driver},
        "columnKind": "utf16CodeUnits",
        "results": [_result(r, rules.index(r.check), diagnosed(report, r)) for r in told],
    }
    log = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return json.dumps(log, indent=1) + "\n"


def _rule(check: str) -> dict[str, Any]:
    """A check, with the words that code scanning shows above its results."""
    words = f"the check {check} of brdf-check"
    help = f"brdf-check run --check {check} asks it again; brdf-check docs statistics explains."
    told = {"shortDescription": words, "fullDescription": words, "help": help}
    return {"id": check, **{name: {"text": text} for name, text in told.items()}}


def _result(result: Result, rule: int, found: Diagnosis | None) -> dict[str, Any]:
    finding = most_telling(result)
    cause = [blame] if (blame := refuted.blame(found, finding)) else []
    words = [f"{case(result)} {result.check}: {statement(finding)}".strip(), *cause]
    words += explanation(finding)
    return {
        "ruleId": result.check,
        "ruleIndex": rule,
        "level": CONSEQUENCE if finding.follows else LEVELS[Verdict(result.verdict)],
        "message": {"text": "\n".join(words)},
        "partialFingerprints": {"case/v1": f"{case(result)} {result.check} {finding.quantity}"},
        **({"locations": [_location(result)]} if result.source else {}),
    }


def _location(result: Result) -> dict[str, Any]:
    path = PurePath(result.source["file"])
    uri = path.as_uri() if path.is_absolute() else _escaped(path.as_posix())
    region = {"startLine": max(1, line_of(result))}
    return {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}}


def _escaped(path: str) -> str:
    from urllib.parse import quote

    return quote(path)
