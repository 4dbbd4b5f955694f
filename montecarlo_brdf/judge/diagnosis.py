"""What a refuted model's author has to change, or where to look: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any


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
class Diagnosis:
    """One for each refuted model and parameter set: what failed stands in its findings."""

    model: str
    params: Mapping[str, Any]
    cause: Cause | None = None
    reproduce: str = ""  # the command that shows the worst finding of what is at fault
    seconds: float = field(default=0.0, compare=False)  # of the processor; not reported

    def told(self) -> dict[str, Any]:
        """As plain data."""
        cause = {"cause": vars(self.cause)} if self.cause else {}
        return {"model": self.model, "params": dict(self.params), **cause,
                "reproduce": self.reproduce}  # fmt: skip
