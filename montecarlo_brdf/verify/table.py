"""Tables: every cell with a certificate, what is lost between them, and what may stand for them."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf import __version__
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.plan import Progress
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.text import called
from montecarlo_brdf.table import affine, findings, mistakes, polynomial, theirs
from montecarlo_brdf.table.accord import Truth
from montecarlo_brdf.table.axes import Axis, checked, points
from montecarlo_brdf.table.cell import Terms
from montecarlo_brdf.table.cells import filled
from montecarlo_brdf.table.formula import formula_of
from montecarlo_brdf.table.fresh import Stand, fresh
from montecarlo_brdf.table.spot import spots
from montecarlo_brdf.table.subject import Subject, measures_of
from montecarlo_brdf.table.written.finished import Finished
from montecarlo_brdf.verify.question import (
    Settings,
    part_of,
    probed,
    reported,
    shown_parameters,
    source,
)

TARGET, CONFIDENCE, FRESH = 1e-5, 0.99, 512
PART = 0.1  # of a tolerance, that cells are known to where nothing is said
SMALLEST = 1e-12  # absolute error that may be asked for
MOST_FRESH = 1_000_000
OTHERS = 10_000  # values besides those of cells and fresh places: nodes of fits, climbs

Curves = Sequence[Sequence[tuple[float, ...]]]


class Answer(NamedTuple):
    """A table as a report, as plain data for files, and a polynomial in its place."""

    report: Report
    finished: Finished
    fit: polynomial.Fit | None = None

    def fitted(self) -> dict[str, str]:
        """The polynomials as expressions of x, y, z, and what these are."""
        if self.fit is None:
            return {}
        found = {n: self.fit.text(k) for k, n in enumerate(self.finished.values)}
        return {**self.fit.letters(), **found}


class Wish(NamedTuple):
    """How closely to look, and what besides the cells is wanted."""

    target_error: float | None = None  # absolute; None for TARGET, or a part of the tolerance
    confidence: float = CONFIDENCE  # that all certificates hold at once
    fresh_places: int = FRESH  # where interpolation, fits and others are measured besides the cells
    fit: str | None = None  # "polynomial:6" or "chebyshev:6"
    against: str | None = None  # as `theirs_of` takes it
    curve: bool = False  # the report holds all cells


def table(
    model: Model, axes: Sequence[Axis], quantities: Sequence[str] = ("albedo",), *,
    fixed: Mapping[str, Any] | None = None, formulas: Mapping[str, str] | None = None,
    theta_o_deg: float = 0.0, phi_o_deg: float = 0.0, split: str = "f0", wish: Wish = Wish(),
    tolerance: float | None = None, seed: int = 0, threads: int | None = None,
    resume: Path | None = None, progress: Progress | None = None, command: str = "",
) -> Answer:  # fmt: skip
    """A table of what a model reflects, to an absolute error in every cell.

    model: from `load`. axes: one to three, of mu, theta (degrees), phi (degrees) and parameters.
    quantities: of "albedo", "average", "scale", "bias" and "split-sum", which is the last two.
    fixed: values of other parameters. formulas: parameters as formulas of the axes' names, which
    may then be others. theta_o_deg, phi_o_deg: the viewer where no axis says. split: the parameter
    that scale and bias are of. tolerance: absolute, of a fit and of what stands against the table;
    None to measure only. seed: 0 to 2^64 - 1. threads: no result depends on them. resume: a file
    that keeps the cells on the way. progress: is called with the fraction done. command: what files
    say they were made by.

    Raises UserError for a bad value, ModelError if the model does not run.
    """
    settings = Settings.of(seed=seed, threads=threads, tolerance=tolerance)
    began = time.perf_counter()
    wish = _checked(wish, tolerance)
    axes, measures = checked(axes), measures_of(quantities)
    made = {n: formula_of(f, [a.name for a in axes]) for n, f in (formulas or {}).items()}
    subject = Subject(model, axes, measures, fixed or {}, made, theta_o_deg, phi_o_deg, split)
    _look(subject, seed)
    way = polynomial.read(wish.fit) if wish.fit else None
    other = theirs.theirs_of(wish.against, axes, measures) if wish.against else None
    truth = _truth(subject, wish, settings, resume, progress)
    fit = polynomial.fitted(subject, truth.terms, truth.cells, *way, truth.threads) if way else None
    results = [*_of_itself(truth, wish), *_of_others(truth, wish, fit, other, tolerance)]
    told = _told(truth, wish, formulas or {}, tolerance)
    facts = {"command": command or "montecarlo_brdf.verify.table", "version": __version__, **told}
    return Answer(reported(Command.TABLE, told, results, began), _finished(truth, facts), fit)


def _checked(wish: Wish, tolerance: float | None) -> Wish:
    """With a target. Raises UserError for values that are not allowed."""
    usual = TARGET if tolerance is None else min(TARGET, max(SMALLEST, PART * tolerance))
    target = usual if wish.target_error is None else wish.target_error
    if not SMALLEST <= target < 1.0:
        allowed = f"an absolute error in [{SMALLEST:g}, 1)"
        raise UserError(f"target-error must be {allowed}, not {target}")
    if not 0.0 < wish.confidence < 1.0:
        raise UserError(f"confidence must be a number in (0, 1), not {wish.confidence}")
    if not 0 <= wish.fresh_places <= MOST_FRESH:
        raise UserError(f"fresh must be a whole number from 0 to {MOST_FRESH}")
    return wish._replace(target_error=target)


def _look(subject: Subject, seed: int) -> None:
    """A first look at the model, and whether what is asked of it means anything."""
    subject.check()
    *_, last = points(subject.axes)
    for point in (next(points(subject.axes)), last):
        place = subject.place(point)
    probed(subject.model.of(place.p), place.p)
    found = affine.bend(subject, seed) if subject.splits else None
    if found and not found.straight:
        where = ", ".join(f"{k} = {v:.4g}" for k, v in found.where.items())
        raise UserError(
            f"f of model {subject.model.name} is not affine in {subject.split}, so that scale and "
            f"bias do not give it: at {where} it is {found.size:.1e} off a straight line"
        )


def _truth(
    subject: Subject, wish: Wish, settings: Settings, resume: Path | None,
    progress: Progress | None,
) -> Truth:  # fmt: skip
    """All cells and all fresh places."""
    cells = math.prod(axis.size for axis in subject.axes)
    values = len(subject.measures) * (cells + 2 * wish.fresh_places + OTHERS)
    level = (1.0 - wish.confidence) / values
    terms = Terms(wish.target_error or TARGET, level, settings.plan.seed)
    many = settings.plan.threads
    found = filled(subject, terms, many, part_of(progress, 0, 1), resume)
    return Truth(subject, terms, found, fresh(subject, terms, wish.fresh_places, many), many)


def _of_itself(truth: Truth, wish: Wish) -> list[Result]:
    """What is said of the cells, and between them."""
    checked_again = spots(truth.subject, truth.terms, truth.cells)
    curves = findings.curve(truth, truth.cells.values) if wish.curve else []
    found = [_result(truth, "cells", findings.of_cells(truth, checked_again), curves)]
    if len(truth.fresh.points):
        found.append(_result(truth, "interpolation", findings.of_interpolation(truth)))
    return found


def _of_others(
    truth: Truth, wish: Wish, fit: polynomial.Fit | None, other: theirs.Theirs | None,
    tolerance: float | None,
) -> list[Result]:  # fmt: skip
    """What is said of a polynomial, and of somebody else's table or fit."""
    found = []
    if fit:
        rows = findings.of_stand(truth, truth.of_function(fit.at), tolerance)
        found.append(_result(truth, f"fit {wish.fit}", rows, _away(truth, fit.at, wish)))
    if other:
        rows = _of_theirs(truth, other, tolerance)
        found.append(_result(truth, f"against {other.name}", rows, _away(truth, other.stand, wish)))
    return found


def _of_theirs(
    truth: Truth, other: theirs.Theirs, tolerance: float | None
) -> list[Finding]:
    """Of a table the cells are judged; what is between them is told."""
    if other.cells is None:
        return findings.of_stand(truth, truth.of_function(other.stand), tolerance)
    rows = findings.of_stand(truth, truth.of_cells(other.cells), tolerance)
    rows[0] = replace(rows[0], hint=mistakes.likely(truth, other.cells))
    return rows + findings.between_theirs(truth, other.stand)


def _away(truth: Truth, stand: Stand, wish: Wish) -> Curves:
    """Deviations at all cells, for pictures."""
    if not wish.curve:
        return []
    values = stand(np.array(list(points(truth.subject.axes))))
    return findings.curve(truth, values - truth.cells.values.reshape(values.shape))


def _result(truth: Truth, name: str, found: list[Finding], curves: Curves = ()) -> Result:
    model, fixed = truth.subject.model, truth.subject.fixed
    return Result(model.name, {**fixed, **model.picks}, name, found, curves, source(model))


def _told(
    truth: Truth, wish: Wish, formulas: Mapping[str, str], tolerance: float | None
) -> dict[str, Any]:
    """What results depend on."""
    subject, unseen = truth.subject, truth.fresh
    return {
        "axes": [{**a._asdict(), "told": a.told()} for a in subject.axes],
        "quantities": list(subject.measures), "formulas": dict(formulas),
        "theta_o_deg": subject.theta_o_deg, "phi_o_deg": subject.phi_o_deg, "split": subject.split,
        "target_error": wish.target_error, "confidence": wish.confidence, "seed": truth.terms.seed,
        "fresh": len(unseen.points), "left_out": unseen.left_out,
        "unseen": unseen.unseen(1.0 - wish.confidence), "tolerance": tolerance,
    }  # fmt: skip


def _finished(truth: Truth, facts: Mapping[str, Any]) -> Finished:
    subject = truth.subject
    defaults = shown_parameters(subject.model, subject.model.parameters())
    moving = {*subject.fixed, *facts["formulas"], *(a.name for a in subject.axes)}
    moving |= {subject.split} if subject.splits else set()
    still = {k: v for k, v in defaults.items() if k not in moving}
    named = called(subject.model.name, {**still, **subject.fixed, **facts["formulas"]})
    values = dict(zip(subject.measures, truth.cells.values, strict=True))
    errors = dict(zip(subject.measures, truth.cells.errors, strict=True))
    return Finished(named, subject.axes, values, errors, facts)
