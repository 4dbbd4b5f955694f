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
class Place:
    """The worst finding of a check, with the function and line that it is about."""

    check: str
    sentence: str
    where: Mapping[str, Any]
    function: str
    line: int | None = None


@dataclass(frozen=True)
class Diagnosis:
    """One for each refuted model and parameter set."""

    model: str
    params: Mapping[str, Any]
    cause: Cause | None
    places: tuple[Place, ...]  # of what failed and does not follow from the cause
    follows: int = 0  # findings that are consequences of it
    reproduce: str = ""  # the command that shows the worst
    seconds: float = field(default=0.0, compare=False)  # of the processor
