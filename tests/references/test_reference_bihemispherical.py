"""Bihemispherical albedos, held against integrals over both directions by code of others.

`tests/data/bihemispherical.json`: integrals in three dimensions (four without isotropy), by
tanh-sinh and Gauss rules in polar angles of half and difference vectors, with panels at horizons
and kinks; the difference of two rules is their error. The code was written from the formulas
alone and shares nothing with the references, which integrate the directional albedo. Two of the
values refuted bounds that the references gave then.
"""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from montecarlo_brdf import references

VALUES = json.loads((Path(__file__).parents[1] / "data" / "bihemispherical.json").read_text())


def case(row: dict[str, Any]) -> Any:
    name = ",".join([row["model"], *(f"{k}={v}" for k, v in row["parameters"].items())])
    return pytest.param(row, id=name, marks=[pytest.mark.slow] if row["slow"] else [])


@pytest.mark.parametrize("row", [case(row) for row in VALUES])
def test_values_of_others(row: dict[str, Any]) -> None:
    truth = references.bihemispherical(row["model"], **row["parameters"])
    assert truth is not None
    assert abs(truth.value - row["value"]) <= truth.error + row["error"]
    assert truth.error <= 2e-11 * truth.value
