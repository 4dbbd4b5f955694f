"""Reading an exported report."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import SCHEMA


def read_report(path: Path) -> dict[str, Any]:
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
        raise UserError(
            f"{path} has schema {data.get('schema')}; this version reads schema {SCHEMA}"
        )
    if not all(map(_is_result, data["results"])):
        raise UserError(f"{path} is not a report of brdf-check: its results are damaged")
    return data


def _is_result(result: Any) -> bool:
    """Whether this has what every result and every finding has."""
    return (
        isinstance(result, dict)
        and isinstance(result.get("params"), dict)
        and isinstance(result.get("model"), str)
        and isinstance(result.get("check"), str)
        and isinstance(result.get("findings"), list)
        and all(map(_is_finding, result["findings"]))
    )


def _is_finding(finding: Any) -> bool:
    return (
        isinstance(finding, dict)
        and isinstance(finding.get("quantity"), str)
        and isinstance(finding.get("where"), dict)
        and isinstance(finding.get("verdict"), str)
    )
