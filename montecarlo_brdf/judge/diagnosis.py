"""What a refuted model's author has to change, or where to look: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from montecarlo_brdf.judge.finding import Finding


class Part(StrEnum):
    """What of a model is at fault."""

    VALUES = "values"  # f is not a number, or negative
    DRAWS = "draws"
    PDF = "pdf"
    WEIGHT = "weight"
    F = "f"


@dataclass(frozen=True)
class Cause:
    """What was done wrong: with it repaired, everything that failed holds."""

    part: Part
    sentence: str
    tested: str  # how


@dataclass(frozen=True)
class Place:
    """The worst finding of what is at fault, and the function that it is about."""

    check: str
    finding: Finding
    function: str
    line: int | None = None
    reproduce: str = ""  # the command that shows it

    def told(self) -> dict[str, Any]:
        """As plain data."""
        line = {"line": self.line} if self.line else {}
        return {"check": self.check, "quantity": self.finding.quantity, **line,
                "where": dict(self.finding.where), "function": self.function,
                "reproduce": self.reproduce}  # fmt: skip


@dataclass(frozen=True)
class Diagnosis:
    """One for each refuted model and parameter set; what follows from it is marked in findings."""

    model: str
    params: Mapping[str, Any]
    place: Place
    cause: Cause | None = None  # None: no repair mends all that failed
    seconds: float = field(default=0.0, compare=False)  # of the processor; not reported

    def told(self) -> dict[str, Any]:
        """As plain data."""
        cause = {"cause": vars(self.cause)} if self.cause else {}
        return {"model": self.model, "params": dict(self.params), **cause,
                "place": self.place.told()}  # fmt: skip
