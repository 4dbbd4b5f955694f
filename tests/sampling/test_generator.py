"""A short form of scripts/generator_battery.py; its long form is recorded in scripts/results."""
from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from montecarlo_brdf import bits
from montecarlo_brdf.sampling import points

SCRIPTS = Path(__file__).parents[2] / "scripts"


@pytest.fixture(scope="module")
def script() -> Any:
    sys.path.insert(0, str(SCRIPTS))
    try:
        import generator_battery
    finally:
        sys.path.remove(str(SCRIPTS))
    return generator_battery


def test_the_script_tests_the_words_of_the_package(script: Any) -> None:
    for key, axis, index in ((1, 0, 0), (2**64 - 1, 4, 12345), (7, 3, 2**40 + 1)):
        word = int(script.words(key, axis, np.array([index], np.uint64))[0])
        assert bits.unit(word) == points.independent_axis(key, index, axis)
        assert bits.unit(word) == points.independent(key, index)[axis]


def test_streams_pass(script: Any) -> None:
    """False alarm rate 1e-6 for all streams together."""
    found = {name: script.battery(s, 14, 1, 3) for name, s in script.STREAMS.items()}
    p = script.avalanche(script.flipped_counters, 1 << 11, 3)
    found["flipped counters"] = {"avalanche": [p]}
    result = script.verdict(found)
    assert result["passed"], result


def test_bad_generators_fail(script: Any) -> None:
    for name, stream in script.MUTANTS.items():
        result = script.verdict({name: script.battery(stream, 14, 1, 3)})
        assert not result["passed"], result


def test_poor_mixing_fails_the_avalanche(script: Any) -> None:
    def changed(inputs: Any, b: int) -> Any:
        """One multiplication alone: its low bits do not depend on high ones."""
        factor = np.uint64(0xBF58476D1CE4E5B9)
        return inputs * factor ^ (inputs ^ np.uint64(1 << b)) * factor

    assert script.avalanche(changed, 1 << 11, 3) < 1e-9
