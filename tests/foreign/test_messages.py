"""What compilers say becomes one sentence; no compiler is needed to see it."""
from __future__ import annotations

import pytest

from montecarlo_brdf.foreign.messages import complaint

GLSLANG = """\
ERROR: my.glsl:2: 'q' : vector swizzle selection out of range
ERROR: my.glsl:3: 'r' : undeclared identifier
ERROR: 2 compilation errors.  No code generated.
"""
SLANG = """\
error[E30015]: undefined identifier
 --> dir/my.hlsl:4:16
  |
4 |   return a.x + lost;
  |                ^^^^ undefined identifier 'lost'.
--'
"""
KEY = "ERROR: brdf-check key f:1: 'bc_colour' : no matching overloaded function found\n"
INCLUDE = "ERROR: my.glsl:2: '#error' : no file lib / lost . h to include\n"


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (GLSLANG, "my.glsl, line 2: 'q' vector swizzle selection out of range (and 1 more)"),
        (SLANG, "dir/my.hlsl, line 4: undefined identifier 'lost'"),
        (KEY, "x.glsl, key f: it is neither a number nor a colour"),
        (INCLUDE, "my.glsl, line 2: no file lib/lost.h to include"),
        ("internal\n  trouble", "x.glsl: internal trouble"),
        ("", "x.glsl: its compiler said nothing"),
    ],
)
def test_one_sentence(said: str, told: str) -> None:
    assert complaint(said).told("x.glsl") == told
