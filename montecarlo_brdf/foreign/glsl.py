"""A GLSL file as a program with our own entry: what a compiler for Vulkan wants is rewritten, line
by line, and everything else stays."""

from __future__ import annotations

import re

from montecarlo_brdf.foreign import entry as entries
from montecarlo_brdf.foreign.description import Description, Parameter, Type
from montecarlo_brdf.foreign.entry import Entry
from montecarlo_brdf.foreign.messages import KEY
from montecarlo_brdf.foreign.scopes import bare, depths, is_set, rewritten

#: compiled first: the functions of later versions take the compiler a tenth of a second to learn
VERSION = 430
NEWEST = 460
#: GLSL allows to define these anew, its compiler does not
NAMES = """
    sin cos tan asin acos atan pow exp log exp2 log2 sqrt inversesqrt abs sign floor trunc round
    ceil fract mod min max clamp mix step smoothstep length distance dot cross normalize faceforward
    reflect refract isnan isinf fma radians degrees sinh cosh tanh transpose inverse determinant
"""
BUILT_IN = frozenset(NAMES.split())
TYPE = r"(?:float|double|int|uint|bool|[biud]?vec[234]|mat[234](?:x[234])?)"
DEFINITION = re.compile(rf"^[ \t]*(?:void|{TYPE})\s+(\w+)\s*\(", re.M)
HEAD = re.compile(r"^[ \t]*#[ \t]*version[^\n]*$|^[ \t]*precision\s+\w+\s+\w+\s*;", re.M)
#: Godot's own directives
ENGINE = re.compile(r"^[ \t]*#[ \t]*(?:\[\w+\]|[A-Z_]+)[ \t]*$", re.M)
#: calls by names that the compiler keeps for other things
SAMPLING = re.compile(r"\b(?:texture(?:1D|2DRect|2D|3D|Cube)|shadow[12]D)"
                      r"(Proj)?(Lod|Grad)?(?:EXT|ARB)?(?=\s*\()")  # fmt: skip
EXTENSION = re.compile(r"^[ \t]*#[ \t]*extension[^\n]*$", re.M)
LAYOUT = r"(?:layout\s*\([^)]*\)\s*)?"
QUALIFIERS = r"(?:(?:highp|mediump|lowp|flat|smooth|noperspective|centroid|readonly)\s+)*"
UNIFORM = re.compile(
    rf"{LAYOUT}\buniform\s+{QUALIFIERS}(?P<type>\w+)\s+(?P<name>\w+)"
    r"(?P<array>\s*\[[^\]]*\])?\s*(?:=[^;]*)?;"
)
STAGE = re.compile(
    rf"{LAYOUT}{QUALIFIERS}\b(?P<way>varying|attribute|in|out)\s+{QUALIFIERS}"
    r"(?P<type>\w+)\s+(?P<name>\w+)(?P<array>\s*\[[^\]]*\])?\s*;"
)
LOCAL_SIZE = re.compile(r"layout\s*\([^)]*local_size[^)]*\)\s*in\s*;")
BLOCK = re.compile(rf"{LAYOUT}\buniform\s+\w+\s*\{{(?P<members>[^}}]*)\}}\s*;")
NAMED = re.compile(
    rf"{LAYOUT}{QUALIFIERS}\b(?P<way>uniform|in|out)\s+(?P<type>\w+)\s*"
    r"(?P<members>\{[^}]*\})\s*(?P<name>\w+)(?P<array>\s*\[[^\]]*\])?\s*;"
)
OPAQUE = re.compile(r"[iu]?(?:sampler|image|texture)\w*|subpassInput\w*|atomic_uint")
ENTRY = "bc_entry_"  # how the names of our functions begin
MAKERS = """\
vec3 bc_colour(float x) { return vec3(x); }
vec3 bc_colour(vec3 x) { return x; }
vec3 bc_colour(vec4 x) { return x.xyz; }
vec3 bc_number(float x) { return vec3(x); }
vec3 bc_direction(vec3 x) { return x; }
"""


class Program:
    """The text around which entries are written; `text` has its includes resolved."""

    def __init__(self, text: str, path: str, said: Description) -> None:
        self._said, self._path = said, path
        self._bindings = 1  # 0 is our own buffer
        self._parameters = {p.name: p for p in said.parameters}
        code = bare(text)
        extensions = EXTENSION.findall(code)
        for pattern in (HEAD, EXTENSION, LOCAL_SIZE, ENGINE):
            code = pattern.sub("", code)
        code = SAMPLING.sub(r"texture\1\2", code)
        code = rewritten(code, BLOCK, _opened)
        code = rewritten(code, NAMED, self._block)
        code = rewritten(code, UNIFORM, self._uniform)
        code = rewritten(code, STAGE, self._stage)
        self._globals = {p for p in self._parameters if _is_global(code, p)}
        own = sorted(set(DEFINITION.findall(code)) & BUILT_IN)
        names = [*(f"#define {n} own_{n}" for n in own), "#define main bc_user_main"]
        names += [f"#define {k} {v}" for k, v in said.defines.items()]
        stub = f'#line 1 "{KEY}stub"\n{said.stub}' if said.stub else ""
        self._text = "\n".join([
            f"#version {VERSION}",
            *dict.fromkeys(x.strip() for x in extensions),
            "layout(std430, binding = 0) buffer bc_buffer { float bc[]; };",
            "vec4 bc_FragColor;", "#define gl_FragColor bc_FragColor",
            *names, stub, f'#line 1 "{path}"', code, "#undef main", MAKERS,
        ])  # fmt: skip

    def source(self, every: list[Entry]) -> str:
        """The program with all entries, as functions that its main calls."""
        calls = "".join(f" {ENTRY}{one.name}();" for one in every)
        functions = "".join(map(self._function, every))
        return f"{self._text}{functions}void main() {{{calls} }}\n"

    def _function(self, one: Entry) -> str:
        said, first = self._said, entries.end(self._said.parameters)
        before = f'#line 1 "{KEY}before"\n{said.before}' if said.before else ""
        lines = [
            f"void {ENTRY}{one.name}() {{", *self._directions(one), *self._assignments(), "{",
            before,
            f'#line 1 "{KEY}{one.name}"', f"vec3 bc_result = {one.maker}({one.expression});",
            *(f"bc[{first + k}] = bc_result.{'xyz'[k]};" for k in range(3)), "}}",
        ]  # fmt: skip
        return "\n".join(lines) + "\n"

    def _directions(self, one: Entry) -> list[str]:
        """The names that expressions use, but for those that a parameter takes."""
        lines = entries.directions(one, "vec3")
        return [text for name, text in lines.items() if name not in self._parameters]

    def _assignments(self) -> list[str]:
        """The parameters: the shader's own variables, or new ones."""
        found = []
        for one, place in entries.places(self._said.parameters):
            kind = {Type.COLOUR: "vec3", Type.SWITCH: "bool", Type.WHOLE: "int"}.get(one.type)
            new = "" if one.name in self._globals else f"{kind or 'float'} "
            found.append(f"{new}{one.name} = {entries.value(one, place, 'vec3')};")
        return found

    def _uniform(self, match: re.Match[str]) -> str:
        """A parameter becomes a variable; anything else stays what it is, in a block of its own."""
        kind, name, array = match["type"], match["name"], match["array"] or ""
        if (name in self._parameters and not array) or is_set(name, self._said.before):
            return f"{kind} {name}{array};"
        self._bindings += 1
        if OPAQUE.fullmatch(kind):
            return f"layout(binding = {self._bindings}) uniform {kind} {name}{array};"
        inside = f"{kind} {name}{array};"
        return f"layout(binding = {self._bindings}) uniform bc_{name} {{ {inside} }};"

    def _block(self, match: re.Match[str]) -> str:
        """A block with a name of its own, where the compiler wants to know its place; one that is
        set, or that the stage gives, is a variable of ours."""
        kind, way = match["type"], match["way"]
        rest = f"{match['members']} {match['name']}{match['array'] or ''};"
        if way == "out" or is_set(match["name"], self._said.before):
            return f"struct bc_{kind} {rest}"
        self._bindings += 1
        place = "binding" if way == "uniform" else "location"
        return f"layout({place} = {self._bindings}) {way} {kind} {rest}"

    def _stage(self, match: re.Match[str]) -> str:
        """What the stage gets stays so, unless it is a parameter or set; what it gives is ours."""
        kind, name, array = match["type"], match["name"], match["array"] or ""
        ours = name in self._parameters or is_set(name, self._said.before)
        if match["way"] == "out" or ours:
            return f"{kind} {name}{array};"
        self._bindings += 1
        flat = "flat " if kind in ("int", "uint") or kind[0] in "iu" else ""
        return f"layout(location = {self._bindings}) {flat}in {kind} {name}{array};"


def _opened(match: re.Match[str]) -> str:
    """A block without a name of its own as single uniforms."""
    members = (m.strip() for m in match["members"].split(";"))
    lines = re.sub(r"[^\n]", "", match[0])
    return " ".join(f"uniform {m};" for m in members if m).replace("\n", " ") + lines


def _is_global(code: str, name: str) -> bool:
    """Whether the shader has a variable of this name outside of its functions."""
    pattern, known = re.compile(rf"\b{TYPE}\s+{name}\s*(?:=[^;]*)?;"), depths(code)
    return any(known[m.start()] == 0 for m in pattern.finditer(code))


def declared(text: str, one: Parameter) -> Parameter:
    """The parameter with the type that the shader gives it."""
    match = re.search(rf"\b(int|uint|bool)\s+{one.name}\s*(?:=[^;]*)?;", bare(text))
    if match and one.type is Type.NUMBER:
        return one._replace(type=Type.SWITCH if match[1] == "bool" else Type.WHOLE)
    return one
