"""An HLSL or Slang file as a program with our own entry, for Slang's compiler."""

from __future__ import annotations

import re

from montecarlo_brdf.foreign import entry as entries
from montecarlo_brdf.foreign.description import Description, Type
from montecarlo_brdf.foreign.entry import Entry
from montecarlo_brdf.foreign.messages import KEY
from montecarlo_brdf.foreign.scopes import bare, is_set, rewritten

TYPE = r"(?:float|half|double|int|uint|bool)[234]?"
UNIFORM = re.compile(
    rf"\b(?P<static>static\s+)?(?:uniform\s+|extern\s+)?(?P<type>{TYPE})\s+(?P<name>\w+)\s*"
    r"(?:=[^;]*)?;"
)
OTHER = re.compile(r"\b(?:ConstantBuffer\s*<\s*(?P<inner>\w+)\s*>|(?P<type>\w+))\s+(?P<name>\w+)"
                   r"(?P<array>\s*\[[^\]]*\])?\s*(?::\s*register\s*\([^)]*\)\s*)?;")  # fmt: skip
BLOCK = re.compile(r"\bcbuffer\s+\w+\s*(?::[^{]*)?\{(?P<members>[^}]*)\}\s*;?")
#: hints before statements, which Slang does not take before all of them
HINT = re.compile(r"(?:^|(?<=[;{})]))(\s*)\[\s*(?:flatten|branch|forcecase|call)\s*\]", re.M)
#: types of HLSL that Slang does not know
SMALL = " ".join(
    f"typedef {wide}{n} {name}{n};"
    for name, wide in (("min16float", "float"), ("min10float", "float"), ("min16int", "int"),
                       ("min16uint", "uint"))
    for n in ("", 2, 3, 4)
)  # fmt: skip
MAKERS = """\
float3 bc_colour(float x) { return float3(x, x, x); }
float3 bc_colour(float3 x) { return x; }
float3 bc_colour(float4 x) { return x.xyz; }
float3 bc_number(float x) { return float3(x, x, x); }
float3 bc_direction(float3 x) { return x; }
"""


class Program:
    """The text around which entries are written; `text` has its includes resolved."""

    def __init__(self, text: str, path: str, said: Description) -> None:
        self._said = said
        self._parameters = {p.name: p for p in said.parameters}
        self._globals: set[str] = set()
        code = rewritten(HINT.sub(r"\1", bare(text)), BLOCK, self._opened)
        code = rewritten(code, UNIFORM, self._uniform)
        code = rewritten(code, OTHER, self._set)
        stub = f'#line 1 "{KEY}stub"\n{said.stub}' if said.stub else ""
        defines = [f"#define {k} {v}" for k, v in said.defines.items()]
        self._text = "\n".join([
            "RWStructuredBuffer<float> bc;", SMALL, *defines, stub,
            f'#line 1 "{path}"', code, MAKERS,
        ])  # fmt: skip

    def source(self, one: Entry) -> str:
        """The program with an entry."""
        said, first = self._said, entries.end(self._said.parameters)
        before = f'#line 1 "{KEY}before"\n{said.before}' if said.before else ""
        lines = [
            '[shader("compute")][numthreads(1, 1, 1)] void bc_main() {', *self._directions(one),
            *self._assignments(), "{", before, f'#line 1 "{KEY}{one.name}"',
            f"float3 bc_result = {one.maker}({one.expression});",
            *(f"bc[{first + k}] = bc_result.{'xyz'[k]};" for k in range(3)), "}}",
        ]  # fmt: skip
        return self._text + "\n".join(lines) + "\n"

    def _directions(self, one: Entry) -> list[str]:
        """The names that expressions use, but for those that a parameter takes."""
        lines = entries.directions(one, "float3")
        return [text for name, text in lines.items() if name not in self._parameters]

    def _assignments(self) -> list[str]:
        """The parameters: the shader's own variables, or new ones."""
        found = []
        for one, place in entries.places(self._said.parameters):
            kind = {Type.COLOUR: "float3", Type.SWITCH: "bool", Type.WHOLE: "int"}.get(one.type)
            new = "" if one.name in self._globals else f"{kind or 'float'} "
            found.append(f"{new}{one.name} = {entries.value(one, place, 'float3')};")
        return found

    def _uniform(self, match: re.Match[str]) -> str:
        """A variable outside of functions is a uniform: one that is a parameter is ours."""
        if match["name"] not in self._parameters:
            return match[0]
        self._globals.add(match["name"])
        return f"static {match['type']} {match['name']};"

    def _set(self, match: re.Match[str]) -> str:
        """A uniform of any type that `before` fills is ours."""
        kind = match["inner"] or match["type"]
        if kind in ("return", "static", "const") or not is_set(match["name"], self._said.before):
            return match[0]
        return f"static {kind} {match['name']}{match['array'] or ''};"

    def _opened(self, match: re.Match[str]) -> str:
        """A constant buffer as variables, which they are to the shader."""
        members = [m.split(":")[0].strip() for m in match["members"].split(";")]
        return " ".join(f"{m};" for m in members if m).replace("\n", " ")
