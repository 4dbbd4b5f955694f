"""Reading an exported report."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.report.findings import SCHEMA


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
    return data
