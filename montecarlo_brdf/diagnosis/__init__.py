"""Causes: what of a refuted model is wrong, each tested by repairing it.

Where checks failed and at a few places besides, values are stored and all laws asked of them
(`diagnosis.stored`, `diagnosis.laws`); then again as a list of repairs would make them
(`diagnosis.table`). A cause is named only if with its repair everything that failed holds.
"""

from montecarlo_brdf.diagnosis.diagnose import diagnose, marked

__all__ = ["diagnose", "marked"]
