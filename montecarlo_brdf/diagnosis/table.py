"""All repairs, in order: values, draws, pdf, weight, f; those that say more with fewer words cost
less, and the cheapest that mends everything wins."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from montecarlo_brdf.diagnosis import of_densities, of_f, of_pdf, of_values, of_weight
from montecarlo_brdf.diagnosis.laws import Failures, Laws
from montecarlo_brdf.diagnosis.lobes import lobes
from montecarlo_brdf.diagnosis.of_pdf import Known
from montecarlo_brdf.diagnosis.repair import Repair
from montecarlo_brdf.judge.diagnosis import Part

Find = Callable[[Laws, Failures], Iterator[Repair]]
OfPdf = Callable[[Known, Failures], Iterator[Repair]]

OF_PDF: tuple[OfPdf, ...] = (
    of_pdf.rejected, of_pdf.factors, of_pdf.folded, of_pdf.moved, of_pdf.parameters, lobes,
    of_densities.densities, of_pdf.clamped, of_pdf.fitted, of_pdf.uncovered, of_pdf.azimuth,
)  # fmt: skip
ENOUGH = 2.4  # penalty of a repair of pdf after which dearer ones are not looked for
TABLE: dict[Part, tuple[Find, ...]] = {
    Part.VALUES: (of_values.regions,),
    Part.DRAWS: (of_values.draws,),
    Part.WEIGHT: (of_weight.weights, of_values.draws),
    Part.F: (of_f.declared_model, of_f.declared_albedo, of_f.reciprocity, of_f.by_pdf,
             of_f.identified, of_f.two_terms, of_f.undeclared),
}  # fmt: skip


def repairs(part: Part, laws: Laws, failed: Failures) -> list[Repair]:
    """What mends a part, of all kinds."""
    if part is not Part.PDF:
        return [r for find in TABLE[part] for r in find(laws, failed)]
    known, found = Known(laws, failed), list[Repair]()
    for find in OF_PDF if known.index else ():
        if not found or min(r.penalty for r in found) > ENOUGH:
            found += find(known, failed)
    return found
