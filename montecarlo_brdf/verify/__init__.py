"""From a question to a report: the calls behind the commands, one per file."""
from __future__ import annotations

from montecarlo_brdf.verify.common import SAMPLES, Deadline
from montecarlo_brdf.verify.furnace import ANGLES, furnace
from montecarlo_brdf.verify.identities import identities
from montecarlo_brdf.verify.run import RUN_ANGLES, RUN_SAMPLES, run

__all__ = [
    "ANGLES",
    "RUN_ANGLES",
    "RUN_SAMPLES",
    "SAMPLES",
    "Deadline",
    "furnace",
    "identities",
    "run",
]
