"""The JSON schema of reports (draft 2020-12), for programs that read them."""

from __future__ import annotations

from typing import Any

from montecarlo_brdf.judge.diagnosis import Part
from montecarlo_brdf.judge.finding import SCHEMA, Bound, Verdict

TEXT = {"type": "string"}
NUMBER = {"type": "number"}
OBJECT = {"type": "object"}
#: what is not finite is null: JSON has no name for it
PERHAPS = {"type": ["number", "null"]}
WHOLE = {"type": "integer", "minimum": 0}
VERDICT = {"enum": [v.value for v in Verdict]}


def _object(required: dict[str, Any], **more: Any) -> dict[str, Any]:
    properties = {**required, **more}
    return {"type": "object", "required": [*required], "properties": properties}


def _said(schema: dict[str, Any], what: str) -> dict[str, Any]:
    return {**schema, "description": what}


FINDING = _object(
    {
        "quantity": _said(TEXT, "what was claimed, as 'A <= 1'"),
        "where": _said(OBJECT, "the place: angles in degrees, parameters, channel"),
        "verdict": VERDICT,
        "bound": {"enum": [b.value for b in Bound]},
        "value": _said(PERHAPS, "what was found"),
        "stderr": _said(PERHAPS, "its standard error, or a bound on its error"),
    },
    expected=_said(PERHAPS, "what it is held against"),
    tolerance=_said(PERHAPS, "the deviation that is allowed"),
    resolves=_said(PERHAPS, "the deviation that would have been refuted"),
    level=_said(PERHAPS, "the chance of a false alarm"),
    samples=WHOLE,
    estimator=_said(TEXT, "by what it was estimated"),
    reference=_said(OBJECT, "from where the expected value is known"),
    estimators=_said({"type": "array", "items": OBJECT}, "what each estimator said"),
    note=TEXT,
    hint=_said(TEXT, "the likely cause"),
    reproduce=_said(TEXT, "a command line that gives the finding again"),
    draws=_said(OBJECT, "counts of draws in cells of equal probability, and the edges of these"),
    follows={
        "enum": [p.value for p in Part],
        "description": "the part of the model whose cause it is a consequence of",
    },
)
DIAGNOSIS = _object(
    {
        "model": TEXT,
        "params": OBJECT,
        "place": _object(
            {
                "check": TEXT, "quantity": TEXT, "where": OBJECT,
                "function": _said(TEXT, "the function of the model that it is about"),
                "reproduce": _said(TEXT, "a command line that shows it"),
            },
            line=_said(WHOLE, "where the function stands"),
        ),
    },
    cause=_said(
        _object(
            {
                "part": {"enum": [p.value for p in Part]},
                "sentence": _said(TEXT, "what has to be changed"),
                "tested": _said(TEXT, "what holds with it repaired"),
            }
        ),
        "absent where no repair mends all that failed",
    ),
)  # fmt: skip
RESULT = _object(
    {
        "model": TEXT, "params": OBJECT, "check": TEXT, "verdict": VERDICT,
        "findings": {"type": "array", "items": {"$ref": "#/$defs/finding"}},
    },
    source=_object({"file": TEXT, "line": WHOLE}, functions={"additionalProperties": WHOLE}),
    curves=_said({"type": "array"}, "references between the angles, for pictures"),
)  # fmt: skip
REPORT: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "Report of brdf-check",
    **_object(
        {
            "schema": _said({"const": SCHEMA}, "the version of this schema"),
            "command": TEXT,
            "verdict": VERDICT,
            "versions": {"type": "object", "additionalProperties": TEXT},
            "settings": OBJECT,
            "results": {"type": "array", "items": {"$ref": "#/$defs/result"}},
            "measured": _said(OBJECT, "times and what else may differ between equal runs"),
        },
        diagnosis=_said(
            {"type": "array", "items": {"$ref": "#/$defs/diagnosis"}},
            "one for each model and parameter set that was refuted",
        ),
    ),
    "$defs": {"finding": FINDING, "result": RESULT, "diagnosis": DIAGNOSIS},
}
