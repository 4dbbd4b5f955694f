"""Causes: what of a refuted model is wrong, each tested by repairing it."""
