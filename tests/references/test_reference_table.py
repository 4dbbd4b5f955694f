"""Every albedo, reverse albedo and bihemispherical albedo of the table of true values."""

from collections import defaultdict
from typing import Any

import pytest
from reference_data import Entry, cosine, load

from montecarlo_brdf import references

CLOSED, QUADRATURE = 1e-13, 1e-11  # relative: what the two kinds of reference promise


def _groups() -> dict[tuple[str, ...], list[Entry]]:
    groups = defaultdict(list)
    for entry in load("albedo", "reverse_albedo", "bihemispherical"):
        choices = [v for v in entry.parameters.values() if isinstance(v, str)]
        groups[entry.model, entry.quantity, *choices].append(entry)
    return groups


def _truth(entry: Entry) -> Any:
    angle = () if entry.theta is None else (cosine(entry.theta),)
    return getattr(references, entry.quantity)(entry.model, *angle, **entry.parameters)


def _complaint(entry: Entry) -> str | None:
    truth, expected = _truth(entry), float(entry.value)
    tolerance = CLOSED if truth.kind == "closed form" else QUADRATURE
    error = abs(truth.value - expected)
    if error > tolerance * abs(expected) + entry.resolution:
        return f"{entry}: {truth} is off by {error:.2g}"
    if error > truth.error + entry.resolution:
        return f"{entry}: {truth} is off by {error:.2g}, more than its bound"
    if truth.error > 1e-10 * abs(expected):
        return f"{entry}: {truth} has an absurd bound"
    return None


GROUPS = _groups()


def _marked(group: tuple[str, ...]) -> Any:
    """The dearest ones, double integrals with V-cavities or Fresnel terms, only for `-m slow`."""
    double = {"bihemispherical", "cook_torrance"}.issubset(group)
    dear = double and ("v_cavity" in group or "one" not in group)
    return pytest.param(group, id="-".join(group), marks=pytest.mark.slow if dear else ())


@pytest.mark.parametrize("group", [_marked(g) for g in GROUPS])
def test_table(group: tuple[str, ...]) -> None:
    complaints = [c for c in map(_complaint, GROUPS[group]) if c]
    assert not complaints, "\n".join(complaints[:5])
