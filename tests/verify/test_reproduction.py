"""The command that a finding carries finds the same again."""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable

from conftest import Outcome


def findings(done: Outcome) -> list[dict[str, object]]:
    results = json.loads(done.out)["results"]
    return [f for r in results for f in r["findings"] if f["verdict"] == "fail"]


def test_a_reproduction_line_reproduces(cli: Callable[..., Outcome]) -> None:
    """Everything that a result depends on stands in the line, with all its digits."""
    model = ("--model", "lambert_unnormalised", "-p", "c=0.123456789,0.5", "--check", "furnace")
    place = ("--theta-o", "12.3456789,60", "--phi-o", "33.25", "--against", "lambert")
    how = ("--points", "independent", "--samples", "20000", "--seed", "7", "--tolerance", "1.5e-3")
    found = findings(cli("run", *model, *place, *how, "--format", "json"))
    assert found
    program, *words = shlex.split(str(found[0]["reproduce"]))
    again = cli(*words, "--format", "json")
    assert program == "brdf-check" and again.code == 1
    assert found[0] in findings(again)
