"""Very many replicates of one number in few kernel calls: the material of calibration studies.

The tool estimates a mean from R replicates of a stream. Here a stream is asked for thousands of
them; every R in a row are one estimate, with the same kernel, points and keys as the tool's own
(`evaluate` gives the first R of the stream exactly: `check_against_the_tool`).
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy import stats

from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.evaluate import Call, Job, evaluate
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.estimate.samplers import Subject
from montecarlo_brdf.sampling.points import NONE, SHAPES, stream
from montecarlo_brdf.statistics import least_error

EACH = 1024  # samples of a replicate: what the first look and its confirmation take
BATCH = 1 << 12  # replicates of a call


class Question(NamedTuple):
    """What is averaged: functions bound to a subject, a direction, and a name for the stream."""

    subject: Subject
    fixed: tuple[float, ...]
    integrands: Sequence[Integrand]
    label: tuple[Any, ...]


def means(q: Question, points: str, count: int, seed: int = 0, each: int = EACH) -> Any:
    """Means and mean squared deviations of `count` replicates of `each` samples: (integrands, 2,
    count)."""
    layout, numbers = pack(q.subject.sets, moments.QUERY)
    suited = [i.for_lattice() if points == "lattice" else i for i in q.integrands]
    entry = moments.kernel_of(q.subject.name, points, suited, layout)
    reals = (*(*q.fixed, 0.0)[: moments.QUERY], *numbers)
    key = stream(seed, points, *q.subject.identity, *q.label, *q.fixed)
    shape = SHAPES[points](each) if points in SHAPES else NONE
    found, width = [], len(q.integrands)
    for first in range(0, count, BATCH):
        many = min(BATCH, count - first)
        job = Job(entry, reals, width, key, count, each, shape)
        states = job.states(Call(first, many, 0, each))
        table = np.reshape(states, (many, width, moments.STATE))
        found.append(np.stack([table[:, :, 1], table[:, :, 2] / each]).transpose(2, 0, 1))
    return np.concatenate(found, axis=2)


def check_against_the_tool(q: Question, points: str, replicates: int, seed: int = 0) -> None:
    """Raise unless the tool's own estimate is made of the first replicates of the stream."""
    plan = Plan(points, replicates * EACH, replicates, seed)
    theirs = evaluate(q.subject, q.fixed, q.integrands, plan, q.label)[0]
    for row, e in zip(means(q, points, replicates, seed), theirs, strict=True):
        mean, error = estimates(row, replicates)
        same = np.allclose([mean[0], error[0]], e[:2], rtol=1e-9, atol=1e-18)
        if not (np.array_equal(row[0], e.replicates) and same):
            raise AssertionError(f"{q.label}: not the estimate that the tool makes")


def estimates(rows: Any, many: int, each: int = EACH) -> tuple[Any, Any]:
    """(means, standard errors) of every `many` replicates in a row, as `statistics.estimate`."""
    n = rows.shape[1] // many * many
    groups, squares = (r[:n].reshape(-1, many) for r in rows)
    mean, samples = groups.mean(axis=1), many * each
    spread = groups.var(axis=1)
    variance = squares.mean(axis=1) + spread
    least = [least_error(m, v, samples) for m, v in zip(mean, variance, strict=True)]
    return mean, np.maximum(np.sqrt(spread / (many - 1)), least)


def p_values(rows: Any, many: int, each: int, expected: float, vague: float) -> Any:
    """Two-sided p-values at tolerance 0, the reference being known to within `vague`."""
    mean, error = estimates(rows, many, each)
    deviation = np.maximum(np.abs(mean - expected) - vague, 0.0)
    return 2.0 * stats.t.sf(deviation / error, many - 1)


def continuous(rows: Any, many: int, each: int = EACH) -> bool:
    """Whether an estimate's error bar is its spread, never the least that is allowed."""
    mean, error = estimates(rows, many, each)
    spread = rows[0][: len(mean) * many].reshape(-1, many).var(axis=1)
    return bool(np.all(error <= np.sqrt(spread / (many - 1)) * (1.0 + 1e-12)))
