"""The cause of a refuted model: the simplest repair with which everything that failed holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.diagnosis import of_weight
from montecarlo_brdf.diagnosis.laws import PART_OF, Failures, Law, Laws
from montecarlo_brdf.diagnosis.of_values import of_points
from montecarlo_brdf.diagnosis.repair import Repair, repair
from montecarlo_brdf.diagnosis.stored import Stored
from montecarlo_brdf.diagnosis.table import repairs
from montecarlo_brdf.judge.diagnosis import Part
from montecarlo_brdf.judge.finding import Result


class Examined:
    """A stored model, what fails of it, and the repairs that mend some part."""

    def __init__(self, case: Case, results: Sequence[Result]) -> None:
        self.at = Stored(case, results)
        self.laws = Laws(self.at)
        self.failed: Failures = of_points(self.laws)
        for some in (self.laws.of_draws, self.laws.of_pdf, self.laws.of_weight, self.laws.of_f):
            self.failed |= some()
        if Law.WEIGHT in self.failed and of_weight.on_average(self.laws):
            del self.failed[Law.WEIGHT]
        self.repairs = [r for part in Part if part in self.need for r in self._of(part)]
        self.repairs += self._shared()

    @property
    def need(self) -> frozenset[Part]:
        """What a cause has to mend."""
        return frozenset(PART_OF[law] for law in self.failed)

    def _of(self, part: Part) -> list[Repair]:
        if part in (Part.PDF, Part.WEIGHT) and Part.DRAWS in self.need:
            return []
        return repairs(part, self.laws, self.failed)

    def _shared(self) -> list[Repair]:
        """A factor that f and pdf both have: one mistake in what both use, as D."""
        of_f = {law for law in self.failed if PART_OF[law] is Part.F}
        if not of_f or not of_f <= {Law.ENERGY, Law.REVERSE, Law.ALBEDO}:
            return []
        return [
            repair(Part.F, r.penalty, r.sentence.replace("pdf:", "f and pdf alike:", 1),
                   Part.PDF, Part.WEIGHT)
            for r in self.repairs
            if r.divisor and not self.laws.of_f(r.divisor)
        ]  # fmt: skip

    def chosen(self, fits: Callable[[Repair], bool] = lambda repair: True) -> Repair | None:
        """The simplest repair that mends all of what failed here and fits the rest."""
        good = [r for r in self.repairs if self.need <= r.mends and fits(r)]
        return min(good, key=lambda r: r.penalty, default=None)
