"""How an estimate is sampled."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.estimate import work

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

REPLICATES = 16


class Choice(StrEnum):
    """Who chooses sampler and points."""

    GIVEN = "given"  # whoever asks
    AUTO = "auto"  # the model and the target


class Plan(NamedTuple):
    """How to sample."""

    points: str = "sobol"
    samples: int = 1 << 16
    replicates: int = REPLICATES
    seed: int = 0
    threads: int = 1
    progress: work.Progress | None = None
    target_error: float | None = None  # relative; None: just the samples asked for
    method: str = Choice.GIVEN  # AUTO also without a target
    sums: PartialSums | None = None  # where long jobs keep how far they are
    effort: float = 1.0  # in (0, 1]: the share of pairs, places and nodes that checks look at
