"""A BSDF of two thousand lines: OpenPBR's surface as GLSL, which the wheel `materialx` writes.

Run: python scripts/bench_openpbr.py [FOLDER], with the package's extra `shaders` and `materialx`
installed. Says how long translation, first call and samples take and what the white furnace says;
the exit code is 1 if that does not pass. FOLDER gets this shader and those of MaterialX's other
surfaces, for `python scripts/gallery.py FOLDER`; they are their authors' and stay out of the
repository.

The shader is lit by lights and seen from a place: one light of intensity 1 stands at wi, and the
viewer at wo, so that its colour is f times the cosine.
"""
from __future__ import annotations

import functools
import importlib
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import montecarlo_brdf as mb

MODULES = ("", ".PyMaterialXGenGlsl", ".PyMaterialXGenShader")
NODE = "open_pbr_surface"
OTHERS = ("standard_surface", "gltf_pbr", "UsdPreviewSurface", "disney_principled")
UNIFORM = re.compile(r"^uniform (?P<type>\w+) (?P<name>\w+) = (?P<value>[^;]+);", re.M)
LIGHT = re.compile(r"sampleLightSource\([^;]*;\s*L = lightShader\.direction;")
#: parameters with their ranges; all other inputs of the surface stay at their defaults
RANGES = {
    "base_color": (0.0, 1.0), "base_diffuse_roughness": (0.0, 1.0), "base_metalness": (0.0, 1.0),
    "specular_weight": (0.0, 1.0), "specular_roughness": (0.2, 1.0), "specular_ior": (1.1, 2.5),
    "metalness": (0.0, 1.0), "metallic": (0.0, 1.0), "roughness": (0.2, 1.0),
    "diffuse_roughness": (0.0, 1.0), "diffuseColor": (0.0, 1.0), "baseColor": (0.0, 1.0),
}  # fmt: skip
SAID = (
    "f = out1", "cosine = included", "before = u_viewPosition = wo; to_light = wi;",
    "before = u_numActiveLightSources = 1;", "stub = vec3 to_light; bool u_refractionTwoSided;",
    "before = vd.normalWorld = n; vd.tangentWorld = t; vd.positionWorld = vec3(0.0);",
)  # fmt: skip
ANGLES = (0.0, 30.0, 60.0, 80.0)
SAMPLES = 1 << 20


def generated(surface: str) -> str:
    """The fragment shader of a surface."""
    mx, glsl, shader = (importlib.import_module(f"MaterialX{name}") for name in MODULES)
    folder = mx.FileSearchPath(str(Path(mx.__file__).parent))
    document = mx.createDocument()
    mx.loadLibraries(["libraries"], folder, document)
    node = document.addNode(surface, "surface", "surfaceshader")
    generator = glsl.GlslShaderGenerator.create()
    context = shader.GenContext(generator)
    context.registerSourceCodeSearchPath(folder)
    options = context.getOptions()
    options.hwSpecularEnvironmentMethod = shader.SPECULAR_ENVIRONMENT_NONE
    options.hwMaxActiveLightSources = 1
    return str(generator.generate(surface, node, context).getSourceCode("pixel"))


def described(shader: str) -> str:
    """The shader with its light as f needs it, and what is said of it."""
    lit = "lightShader.intensity = vec3(1.0); L = to_light;"
    text, count = LIGHT.subn(lit, shader)
    assert count == 1, "the generated shader asks for its lights in another way"
    text = text.replace("void main()", "void shade()")
    return "\n".join([*(f"// brdf-check: {one}" for one in (*SAID, *inputs(shader))),
                      "// brdf-check: before = shade();", text])  # fmt: skip


def inputs(shader: str) -> Iterator[str]:
    """The inputs of the surface: parameters, or what they are by default."""
    for match in UNIFORM.finditer(shader):
        name, value = match["name"], match["value"]
        if name in RANGES:
            low, high = RANGES[name]
            yield f"param {name} = {value} in [{low}, {high}]"
        elif not name.startswith("u_"):
            yield f"before = {name} = {value};"


def report(path: Path) -> bool:
    """Print times and albedos; whether the furnace passes."""
    begun = time.process_time(), children()
    model = mb.load(str(path))
    translated = children() - begun[1]
    print(f"{len(path.read_text().splitlines())} lines; translation {translated:.1f} s")
    p = model.parameters()
    many = functools.partial(mb.directional_albedo, model, p, 60.0, sampler="cosine")
    first = spent(lambda: many(samples=64))
    seconds = spent(lambda: many(samples=SAMPLES))
    print(f"first call {first:.1f} s; {1e9 * seconds / SAMPLES:.0f} ns a sample")
    found = mb.furnace(model, theta_o_deg=ANGLES)
    for one in found.results[0].findings:
        if one.quantity == "A" and not one.where.get("channel"):
            print(f"A at {one.where['theta_o_deg']:g} degrees: {one.value:.5f}, {one.verdict}")
    return str(found.verdict) == "pass"


def children() -> float:
    """Processor time of the processes that this one has asked."""
    times = os.times()
    return times.children_user + times.children_system


def spent(work: Callable[[], object]) -> float:
    """Processor time of a call."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def main() -> int:
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(temporary)
        os.environ.setdefault("BRDF_CHECK_CACHE_DIR", temporary)
        path = folder / f"{NODE}.glsl"
        path.write_text(described(generated(NODE)), encoding="utf-8")
        for other in OTHERS if len(sys.argv) > 1 else ():
            text = described(generated(other))
            (folder / f"{other}.glsl").write_text(text, encoding="utf-8")
        return 0 if report(path) else 1


if __name__ == "__main__":
    sys.exit(main())
