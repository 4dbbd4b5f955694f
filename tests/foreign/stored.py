"""Shaders of our own with their SPIR-V beside them: the translator is tested in any environment.

`python scripts/shader_fixtures.py` makes the SPIR-V anew.
"""
from __future__ import annotations

import dataclasses
import math
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from montecarlo_brdf import contract
from montecarlo_brdf.foreign import glsl, translate, translation, wheel
from montecarlo_brdf.foreign.model_text import Texts
from montecarlo_brdf.model import Model
from montecarlo_brdf.vectors import Vec

FOLDER = Path(__file__).parent
SHADERS = FOLDER / "shaders"
GGX = ("ggx.glsl", "ggx.hlsl", "ggx.slang", "ggx.brdf")

#: of tests that compile shaders
needs_wheel = pytest.mark.skipif(
    wheel.folder() is None, reason=f"needs the package {wheel.PACKAGE}: pip install '.[shaders]'"
)


def texts(name: str) -> Texts:
    """The translation of a shader from its stored SPIR-V."""
    shader = translate.opened(SHADERS / name)
    shader.said.parameters = [glsl.declared(shader.text, p) for p in shader.said.parameters]
    files = sorted((FOLDER / "spirv").glob(f"{name}.*.spv"))
    binaries = {p.name.split(".")[2]: p.read_bytes() for p in files}
    assert binaries
    return translate.texts(shader, binaries, optimise=False)


def functions(text: str) -> dict[str, Any]:
    """What the text of a model file defines."""
    return vars(translation.module(Path("shader"), text))


def model(name: str) -> Model:
    """The model that a stored shader is."""
    found = texts(name)
    made = contract.build(name, functions(found.double))
    return dataclasses.replace(made, single=lambda: functions(found.single))


def pairs(count: int, seed: int = 1) -> Iterator[tuple[Vec, Vec, random.Random]]:
    """Pairs of directions, and the numbers that they were drawn by."""
    drawn = random.Random(seed)
    for _ in range(count):
        yield direction(drawn), direction(drawn), drawn


def direction(drawn: random.Random) -> Vec:
    """A direction above the horizon."""
    z, phi = drawn.uniform(0.02, 1.0), drawn.uniform(0.0, 2.0 * math.pi)
    s = math.sqrt(1.0 - z * z)
    return s * math.cos(phi), s * math.sin(phi), z
