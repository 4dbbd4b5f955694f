"""Integrands evaluated for a subject by a plan: kernels compiled, run, and their sums judged."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import moments, work
from montecarlo_brdf.estimate.plan import Plan, check_samples
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.estimate.samplers import Subject, query, subject_of
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES, PointSet, stream
from montecarlo_brdf.statistics import Estimate, estimate
from montecarlo_brdf.vectors import Vec


def estimates(
    model: Model,
    p: ParameterSet,
    fixed: Vec,
    integrands: Sequence[Integrand],
    plan: Plan,
    label: tuple[object, ...],
) -> list[list[Estimate]]:
    """Estimates of several integrands on the same points: result[channel][integrand]."""
    return evaluate(subject_of(model, p), query(model, p, fixed), integrands, plan, label)


def evaluate(
    subject: Subject,
    fixed: Sequence[float],
    integrands: Sequence[Integrand],
    plan: Plan,
    label: tuple[object, ...],
    common: bool = False,
) -> list[list[Estimate]]:
    """The same for any subject; `label` names the stream with it.

    common: the same random numbers for every direction, so that what is searched is smooth.
    """
    check_samples(plan.samples)
    if plan.points not in SETS:
        raise UserError(unknown("point set", plan.points, SETS))
    replicates = max(1, min(plan.replicates, plan.samples))
    per_replicate = _per_replicate(plan, replicates)
    place = () if common else fixed
    key = stream(plan.seed, plan.points, *subject.identity, *label, *place)
    suited = [i.for_lattice() if plan.points == PointSet.LATTICE else i for i in integrands]
    rows = []
    for group in _groups(subject.sets, len(suited)):
        layout, numbers = pack(group, moments.QUERY)
        kernel = moments.kernel_of(subject.name, plan.points, suited, layout)
        width = len(group) * len(suited)
        reals = (*(*fixed, 0.0)[: moments.QUERY], *numbers)
        shape = SHAPES[plan.points](per_replicate) if plan.points in SHAPES else NONE
        job = work.Job(kernel, reals, width, key, replicates, per_replicate, shape)
        results = [estimate(m) for m in work.run(job, plan.threads, plan.progress, plan.sums)]
        rows += [results[i : i + len(suited)] for i in range(0, width, len(suited))]
    return rows


def _groups(sets: list[Any], width: int) -> list[list[Any]]:
    """Channels that share a kernel: as many as fit a small stack."""
    size = max(1, 16 // width)
    return [sets[i : i + size] for i in range(0, len(sets), size)]


def _per_replicate(plan: Plan, replicates: int) -> int:
    """Samples in each replicate, rounded up to what the point set needs."""
    each = -(-plan.samples // replicates)
    most, power_of_two = SETS[plan.points]
    each = 1 << (each - 1).bit_length() if power_of_two else each
    if each > most:
        raise UserError(f"{plan.points} points allow {most} samples per replicate, not {each}")
    return each
