"""Comments of a shader say which expression is what."""
from __future__ import annotations

import pytest

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.description import (
    Cosine,
    Description,
    Measure,
    Type,
    described,
    statements,
)


def read(text: str) -> Description:
    return described(statements(text, "a.glsl"))


TEXT = """
// brdf-check: f = a == b ? g(wo) : vec3(0)
//   brdf-check: before = one();
// brdf-check: before = two();
int x; // brdf-check: pdf = not a line of its own
// brdf-check: cosine = included
// brdf-check: measure = projected
// brdf-check: param rough = 1e-1 in [0.01, 1]
// brdf-check: param base = color(1, .5, 0) in [0, 1]
// brdf-check: param thin = true
// brdf-check: define PI = 3.25
// brdf-check: disclaims energy = a term
// brdf-check: isotropic = false
"""


def test_every_key() -> None:
    said = read(TEXT)
    assert said.f == "a == b ? g(wo) : vec3(0)" and said.before == "one();\ntwo();\n"
    assert not said.pdf and said.cosine is Cosine.INCLUDED and said.measure is Measure.PROJECTED
    rough, base, thin = said.parameters
    assert rough.fields() == {"rough": 0.1} and rough.ends == (0.01, 1.0)
    assert base.fields() == {"base_r": 1.0, "base_g": 0.5, "base_b": 0.0}
    assert thin.type is Type.SWITCH and said.defines == {"PI": "3.25"}
    assert said.members == {"disclaims": {"energy": "a term"}, "isotropic": False}


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("cosine = with", "no cosine 'with'"),
        ("disclaims magic = no", "no property 'magic'"),
        ("param = 1", "write `param NAME = value`"),
        ("f g = 1", "write `f = value`"),
        ("param c = color(1, 2)", "the colour c needs three numbers"),
        ("isotropic = maybe", "isotropic must be true or false"),
        ("precision = half", "no precision 'half'"),
    ],
)
def test_a_mistake_has_its_line(line: str, told: str) -> None:
    with pytest.raises(Complaint, match="^a.glsl, line 2: ") as raised:
        read(f"\n// brdf-check: {line}\n")
    assert told in str(raised.value)


@pytest.mark.parametrize("line", ["f = a", "param x = 1"])
def test_nothing_is_said_twice(line: str) -> None:
    with pytest.raises(Complaint, match="a.glsl, line 2: .* given twice"):
        read(f"// brdf-check: {line}\n// brdf-check: {line}\n")
