"""What a table is of: a model whose viewer and parameters follow from the coordinates of a cell."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.table.axes import Angle, Axis, Point, said
from montecarlo_brdf.table.formula import Formula
from montecarlo_brdf.vectors import Vec

SPLIT = "f0"  # the parameter that a split sum is linear in, if none is named


class Measure(StrEnum):
    """What a cell holds."""

    ALBEDO = "albedo"  # A(wo) = int f cos dwi, also E(mu)
    AVERAGE = "average"  # 2 int A mu dmu
    SCALE = "scale"  # A = scale f0 + bias
    BIAS = "bias"


#: of both numbers of a split sum
SPLIT_SUM = (Measure.SCALE, Measure.BIAS)


class Place(NamedTuple):
    """Where a cell is estimated: the viewer, and one parameter set per number that it needs."""

    wo: Vec
    p: ParameterSet  # a colour, if there are several


class Subject(NamedTuple):
    """A model, axes, and what stays the same in all cells."""

    model: Model
    axes: tuple[Axis, ...]
    measures: tuple[Measure, ...]
    fixed: Mapping[str, Any] = {}  # parameters
    formulas: Mapping[str, Formula] = {}  # parameters that follow from the coordinates
    theta_o_deg: float = 0.0
    phi_o_deg: float = 0.0
    split: str = SPLIT

    @property
    def splits(self) -> bool:
        """Whether scale or bias is asked for."""
        return any(m in SPLIT_SUM for m in self.measures)

    def check(self) -> None:
        """Raise UserError for names that mean nothing, and for measures that cannot be."""
        names = {*self.model.labels.values(), *self.model.Params._fields}  # type: ignore[attr-defined]
        used = {a.name for a in self.axes} - {*map(str, Angle)} - names
        alone = [n for n in used if not self.formulas]
        if alone:
            allowed = (*map(str, Angle), *sorted(names))
            raise UserError(unknown(f"axis of model {self.model.name}", alone[0], allowed))
        angles = [a.name for a in self.axes if a.name in list(Angle)]
        if Measure.AVERAGE in self.measures and angles:
            raise UserError(
                f"the average is over all angles of the viewer: {angles[0]} cannot be an axis of it"
            )
        if self.splits and self.split not in names:
            raise UserError(
                f"scale and bias need a parameter that f is affine in, as Schlick's f0; model "
                f"{self.model.name} has {', '.join(sorted(names)) or 'none'}: name it by --split"
            )
        if self.splits and (self.split in {a.name for a in self.axes} or self.split in self.fixed):
            raise UserError(
                f"scale and bias hold for every {self.split}: it can be neither axis nor fixed"
            )

    def place(self, point: Point) -> Place:
        """The viewer and the parameters there."""
        given = said(self.axes, point)
        return Place(self._viewer(given), self.parameters(given))

    def parameters(self, given: Mapping[str, float]) -> ParameterSet:
        """The parameter set at named coordinates, with one channel per number of the split."""
        known = {*self.model.labels.values(), *self.model.Params._fields}  # type: ignore[attr-defined]
        values: dict[str, Any] = {n: x for n, x in given.items() if n in known}
        values |= {**self.fixed, **{n: formula(given) for n, formula in self.formulas.items()}}
        if self.splits:
            values[self.split] = self.ends()
        try:
            return self.model.parameters(**values)  # type: ignore[no-any-return]
        except UserError as error:
            where = ", ".join(f"{k} = {v:.6g}" for k, v in given.items())
            raise UserError(f"{error}, at {where}") from None

    def ends(self) -> tuple[float, float]:
        """Two values of the parameter that f is affine in, both away from 0: a mean that is small
        would be asked for to a small error of its own."""
        name = next((n for n, told in self.model.labels.items() if told == self.split), self.split)
        low, high = self.model.domain.get(name, (0.0, 1.0))
        low, high = (low, high) if math.isfinite(low) and math.isfinite(high) else (0.0, 1.0)
        return 0.5 * (low + high), high

    def weights(self) -> list[list[float]]:
        """Per measure, what it takes of the albedos of the channels."""
        if not self.splits:
            return [[1.0] for _ in self.measures]
        middle, high = self.ends()
        slope = 1.0 / (high - middle)
        rows = {Measure.SCALE: [-slope, slope],
                Measure.BIAS: [1.0 + middle * slope, -middle * slope],
                Measure.ALBEDO: [0.0, 1.0], Measure.AVERAGE: [0.0, 1.0]}  # fmt: skip
        return [rows[m] for m in self.measures]

    def _viewer(self, given: Mapping[str, float]) -> Vec:
        theta = math.radians(given.get(Angle.THETA, self.theta_o_deg))
        mu = given.get(Angle.MU, math.cos(theta))
        side = math.sqrt((1.0 - mu) * (1.0 + mu)) if Angle.MU in given else math.sin(theta)
        phi = math.radians(given.get(Angle.PHI, self.phi_o_deg))
        return side * math.cos(phi), side * math.sin(phi), mu


def measures_of(names: Sequence[str]) -> tuple[Measure, ...]:
    """Measures by their names; 'split-sum' is both scale and bias. Raises UserError for others."""
    found: list[Measure] = []
    for name in names:
        if name not in (*Measure, "split-sum"):
            raise UserError(unknown("quantity", name, (*Measure, "split-sum")))
        found += SPLIT_SUM if name == "split-sum" else (Measure(name),)
    if len({*found}) < len(found):
        raise UserError("a quantity is given twice")
    if Measure.AVERAGE in found and {Measure.ALBEDO, *SPLIT_SUM} & {*found}:
        raise UserError("the average has no angle: it takes a table of its own")
    return tuple(found)
