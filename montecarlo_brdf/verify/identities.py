"""The identities of the hemisphere."""
from __future__ import annotations

import time

from montecarlo_brdf.judge.finding import Report, Result
from montecarlo_brdf.verify import _identities as identities_check
from montecarlo_brdf.verify.common import (
    SAMPLES,
    Progress,
    check_tolerance,
    decided,
    plan_settings,
    planned,
    reported,
)


def identities(
    *,
    points: str = "sobol",
    samples: int = SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    tolerance: float | None = None,
    progress: Progress | None = None,
) -> Report:
    """The identities of the hemisphere, each estimated and judged."""
    plan = planned(points, samples, seed, threads)
    check_tolerance(tolerance)
    started = time.perf_counter()
    claims = list(identities_check.claims(tolerance))
    findings = decided(claims, plan, None, len(claims), progress)
    settings = {"tolerance": tolerance, **plan_settings(plan)}
    return reported("identities", settings, [Result("", {}, "identities", findings)], started)
