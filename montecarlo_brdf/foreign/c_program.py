"""A C or C++ file as a program with functions of our own after it: the expressions that its
description has, with both directions and all parameters as local variables."""

from __future__ import annotations

from montecarlo_brdf.foreign.description import Description, Type
from montecarlo_brdf.foreign.entry import Entry
from montecarlo_brdf.foreign.messages import KEY

#: x, y, z, or v[0], v[1], v[2]
HEAD = """
#ifdef __cplusplus
#define bc_export extern "C"
#else
#define bc_export
#endif
typedef union { struct { double x, y, z; }; struct { double r, g, b; }; double v[3]; } bc_vec3;
static bc_vec3 bc_vec3_of(double x, double y, double z)
{ bc_vec3 a; a.x = x; a.y = y; a.z = z; return a; }
static bc_vec3 bc_half(bc_vec3 a, bc_vec3 b)
{
    double x = a.x + b.x, y = a.y + b.y, z = a.z + b.z;
    double k = 1.0 / __builtin_sqrt(x * x + y * y + z * z);
    return bc_vec3_of(k * x, k * y, k * z);
}
"""


def source(text: str, path: str, said: Description, found: list[Entry], content: str) -> str:
    """The whole program."""
    defines = [f"#define {k} {v}" for k, v in said.defines.items()]
    stub = f'#line 1 "{KEY}stub"\n{said.stub}' if said.stub else ""
    parts = [*defines, stub, f'#line 1 "{path}"', text, HEAD]
    return "\n".join([*parts, *(function(one, said, content) for one in found)]) + "\n"


def symbol(name: str, content: str) -> str:
    """What a function of ours is called: kernels may have those of several files."""
    return f"bc_{name}_{content[:16]}"


def function(one: Entry, said: Description, content: str) -> str:
    """An expression as a function."""
    draws = one.name == "sample"
    head = "void" if draws else "double"
    more = ", double *bc_out" if draws else ""
    parameters = {p.name for p in said.parameters}
    directions = [line for name, line in local(one).items() if name not in parameters]
    before = f'#line 1 "{KEY}before"\n{said.before}' if said.before else ""
    result = [f"return ({one.expression});"]
    if draws:
        result = [f"__typeof__({one.expression}) bc_w = ({one.expression});"]
        result += ["bc_out[0] = bc_w.x; bc_out[1] = bc_w.y; bc_out[2] = bc_w.z;"]
    arguments = f"const double *bc_o, const double *bc_i, const double *bc_p{more}"
    return "\n".join([
        f"bc_export {head} {symbol(one.name, content)}({arguments}) {{", *directions,
        *assigned(said), "{", before, f'#line 1 "{KEY}{one.name}"', *result, "}}",
    ])  # fmt: skip


def local(one: Entry) -> dict[str, str]:
    """The names that an expression may use besides the parameters."""
    second = "bc_vec3_of(bc_i[0], bc_i[1], bc_i[2])"
    up = "bc_vec3_of(0.0, 0.0, 1.0)"
    values = {
        "wo": "bc_vec3_of(bc_o[0], bc_o[1], bc_o[2])", "wi": up if one.drawing else second,
        "u": second if one.drawing else "bc_vec3_of(0.5, 0.5, 0.5)", "n": up,
        "t": "bc_vec3_of(1.0, 0.0, 0.0)", "b": "bc_vec3_of(0.0, 1.0, 0.0)",
        "h": "bc_half(wo, wi)",
    }  # fmt: skip
    return {n: f"bc_vec3 {n} = {v}; (void){n};" for n, v in values.items()}


def assigned(said: Description) -> list[str]:
    """The parameters as variables."""
    found, place = [], 0
    for one in said.parameters:
        if one.type is Type.COLOUR:
            value = f"bc_vec3_of(bc_p[{place}], bc_p[{place + 1}], bc_p[{place + 2}])"
            found.append(f"bc_vec3 {one.name} = {value};")
        elif one.type in (Type.SWITCH, Type.WHOLE):
            found.append(f"int {one.name} = (int)bc_p[{place}];")
        else:
            found.append(f"double {one.name} = bc_p[{place}];")
        found[-1] += f" (void){one.name};"
        place += len(one.defaults)
    return found
