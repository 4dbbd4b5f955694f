"""The JSON schema of reports as tables, and in full."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from montecarlo_brdf.report.schema import REPORT

Schema = Mapping[str, Any]


def made() -> str:
    """A table for a report, a result and a finding, and the schema itself."""
    lines = [*_table("The report", REPORT)]
    for name in ("result", "finding"):
        lines += _table(f"A {name}", REPORT["$defs"][name])
    full = json.dumps(REPORT, indent=1)
    return "\n".join([*lines, "## The schema itself", "", f"```json\n{full}\n```", ""])


def _table(title: str, schema: Schema) -> Iterator[str]:
    yield from (f"## {title}", "", "| member | type | always there | |", "|---|---|---|---|")
    for name, one in schema["properties"].items():
        always = "yes" if name in schema["required"] else ""
        yield f"| `{name}` | {kind(one)} | {always} | {one.get('description', '')} |"
    yield ""


def kind(schema: Schema) -> str:
    """A type in words."""
    if "$ref" in schema:
        return str(schema["$ref"]).rpartition("/")[2]
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    if schema.get("type") == "array" and "items" in schema:
        return f"list of {kind(schema['items'])}"
    types = schema.get("type", "")
    return " or ".join(types) if isinstance(types, list) else str(types)
