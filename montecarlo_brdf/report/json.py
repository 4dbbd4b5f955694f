"""JSON: the whole report, with a versioned schema; written, and read again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.diagnosis import Cause, Diagnosis, Part, Place
from montecarlo_brdf.judge.finding import SCHEMA, Bound, Command, Finding, Report, Result, Verdict

NUMBER = (int, float)
#: members of a result and of a finding -> their type; others are not looked at
Types = dict[str, type | tuple[type, ...]]
RESULT: Types = {"model": str, "params": dict, "check": str}
RESULT |= {"findings": list, "curves": list, "source": dict}
FINDING: Types = {"quantity": str, "where": dict, "estimators": list, "draws": dict}
FINDING |= dict.fromkeys(("value", "stderr", "expected", "tolerance", "resolves", "level"), NUMBER)


def render(report: Report) -> str:
    """The report as JSON text."""
    return report.to_json()


def read_report(path: Path) -> Report:
    """The report in a JSON file, or a UserError that says what is wrong with the file."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:
        raise UserError(f"{path} is not a report: it is not JSON ({error})") from error
    if not isinstance(data, dict) or not isinstance(data.get("results"), list):
        raise UserError(f"{path} is not a report of brdf-check")
    if data.get("schema") != SCHEMA:
        found = data.get("schema")
        raise UserError(f"{path} has schema {found}; this version reads schema {SCHEMA}")
    command = _command(path, data.get("command"))
    try:
        results = [result_of(result) for result in data["results"]]
        settings, measured = (dict(data.get(name, {})) for name in ("settings", "measured"))
        diagnosis = [diagnosis_of(d, results) for d in data.get("diagnosis", [])]
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        sentence = f"{path} is not a report of brdf-check: its results are damaged"
        raise UserError(sentence) from error
    versions = data.get("versions")
    known = {str(k): str(v) for k, v in versions.items()} if isinstance(versions, dict) else {}
    return Report(command, settings, results, measured, known, diagnosis)


def _command(path: Path, name: Any) -> Command:
    """What a file is a report of; another version may know more commands."""
    try:
        return Command(name)
    except ValueError as error:
        sentence = f"{path} is a report of {name!r}, which this version does not know"
        raise UserError(sentence) from error


def result_of(data: dict[str, Any]) -> Result:
    """The result that its plain data stand for. Raises KeyError, TypeError or ValueError if they
    are something else."""
    known = _known(data, RESULT)
    known.pop("verdict", None)  # that of its findings
    return Result(**{**known, "findings": [_finding(f) for f in known["findings"]]})


def diagnosis_of(data: dict[str, Any], results: list[Result]) -> Diagnosis:
    """The diagnosis of plain data, and of the results that it is about."""
    place, cause = data["place"], data.get("cause")
    of = (r for r in results if (r.model, r.check) == (data["model"], place["check"]))
    some = [f for r in of if r.params == data["params"] for f in r.findings]
    same = [f for f in some if (f.quantity, f.where) == (place["quantity"], place["where"])]
    finding = same[0] if same else Finding(place["quantity"], place["where"], Verdict.FAIL)
    there = Place(place["check"], finding, place["function"], place.get("line"),
                  place["reproduce"])  # fmt: skip
    known = Cause(Part(cause["part"]), cause["sentence"], cause["tested"]) if cause else None
    return Diagnosis(data["model"], data["params"], there, known)


def _finding(data: dict[str, Any]) -> Finding:
    known = _known(data, FINDING)
    verdict, bound = Verdict(known["verdict"]), Bound(known.get("bound", Bound.EQUAL))
    return Finding(**{**known, "verdict": verdict, "bound": bound})


def _known(data: dict[str, Any], types: Types) -> dict[str, Any]:
    """Without what is null: a number that was not finite."""
    known = {name: value for name, value in data.items() if value is not None}
    for name in known.keys() & types.keys():
        if not isinstance(known[name], types[name]):
            raise TypeError(name)
    return known
