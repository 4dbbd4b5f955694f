"""Hints name a cause from arrays of values, and stay silent where there is none."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from montecarlo_brdf.checks import _hints
from montecarlo_brdf.judge.hint import hint

RNG = np.random.default_rng(1)


def directions(n: int = 2000) -> Any:
    """Directions that keep clear of the horizon."""
    z, phi = RNG.uniform(0.1, 1.0, n), RNG.uniform(0.0, 2.0 * np.pi, n)
    s = np.sqrt(1.0 - z * z)
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1)


WO, WI = directions(), directions()


def density(wo: Any, wi: Any) -> Any:
    """Not symmetric in anything."""
    return wi[:, 2] * (1.0 + 0.5 * wi[:, 0]) * (2.0 + wo[:, 0] * wi[:, 1])


@pytest.mark.parametrize(
    ("moved", "words"),
    [
        (lambda a, b: density(b, a), "wo and wi swapped"),
        (lambda a, b: density(a, b * _hints.MIRRORED), "mirror direction"),
    ],
)
def test_confused_directions(moved: Any, words: str) -> None:
    truth = density(WO, WI)
    assert words in str(_hints.moved_named(lambda a, b: moved(a, b) / truth, WO, WI))


def test_no_confusion_without_deviation() -> None:
    """A reciprocal f is also right with wo and wi swapped: that is no cause."""
    assert _hints.moved_named(lambda a, b: np.ones(len(a)), WO, WI) is None
    assert _hints.moved_named(lambda a, b: density(a, b) ** 2, WO, WI) is None


def test_whose_fault_a_weight_is() -> None:
    claim: Any = None  # not looked at
    assert "pdf of 0" in str(hint(claim, np.inf, only_own=True))
    assert str(hint(claim, np.inf)).startswith("f is not finite")


def test_dependence() -> None:
    def half(a: Any, b: Any) -> Any:
        h = a + b
        return h[:, 2] / np.sqrt(np.sum(h * h, axis=1))

    one = _hints.dependence_named(lambda a, b: 1.0 + half(a, b) ** 8, WO, WI)
    two = _hints.dependence_named(lambda a, b: 1.0 + a[:, 2] * b[:, 2] ** 2, WO, WI)
    both = _hints.dependence_named(lambda a, b: 1.0 + half(a, b) * b[:, 2], WO, WI)
    assert "distribution" in str(one) and "masking" in str(two) and both is None


def test_widths_and_azimuths() -> None:
    ratio = 0.9 + 0.2 * WI[:, 2]
    assert "narrower" in _hints.wider_named(ratio, WI[:, 2])
    assert "wider" in _hints.wider_named(1.0 / ratio, WI[:, 2])
    assert _hints.wider_named(np.ones(len(WI)), WI[:, 2]) == ""
    phi = np.arctan2(WI[:, 1], WI[:, 0])
    assert "azimuth" in _hints.azimuth_named(1.0 + 0.02 * np.sin(phi), WI)
    assert _hints.azimuth_named(ratio, WI) == ""


def test_what_is_right_nearly_everywhere_has_no_factor() -> None:
    ratio = np.ones(2000)
    ratio[:10] = 0.5
    assert _hints.shape_named(ratio, WO, WI) is None
    assert "1.001 everywhere" in str(_hints.shape_named(np.full(2000, 1.001), WO, WI))
