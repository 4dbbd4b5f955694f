"""Which compiler a shader is for, and SPIR-V by it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from montecarlo_brdf.foreign import entry, glsl, glslang, hlsl, messages, slang
from montecarlo_brdf.foreign.description import Description
from montecarlo_brdf.foreign.entry import Entry

SLANG = (".hlsl", ".hlsli", ".fx", ".cginc", ".slang")


def binaries(
    text: str, path: Path, said: Description, folders: list[Path], files: dict[Path, bytes]
) -> Iterator[tuple[str, bytes]]:
    """The SPIR-V of every entry; `files` gets what a compiler reads by itself.

    Raises Complaint where one does not compile.
    """
    said.parameters = [glsl.declared(text, p) for p in said.parameters]
    if path.suffix in SLANG:
        program = hlsl.Program(text, shown(path), said)
        for one in entry.entries(said):
            yield one.name, _by_slang(program.source(one), path, one, folders, files)
        return
    glsl_program = glsl.Program(text, shown(path), said)
    for one in entry.entries(said):
        yield one.name, _by_glslang(glsl_program.source(one), path)


def macros(path: Path) -> dict[str, str]:
    """What a compiler defines by itself."""
    known = {"__SLANG_COMPILER__": "1", "__HLSL_VERSION": "2018"}
    return known if path.suffix in SLANG else {"__VERSION__": str(glsl.VERSION), "VULKAN": "100"}


def shown(path: Path) -> str:
    """A path as #line may have it."""
    return str(path).replace("\\", "/").replace('"', "")


def _by_glslang(text: str, path: Path) -> bytes:
    binary, told = glslang.spirv(text, shown(path))
    if not binary:
        newer = text.replace(f"#version {glsl.VERSION}", f"#version {glsl.NEWEST}", 1)
        binary, told = glslang.spirv(newer, shown(path))
    if not binary:
        raise messages.complaint(told)
    return binary


def _by_slang(
    text: str, path: Path, one: Entry, folders: list[Path], files: dict[Path, bytes]
) -> bytes:
    """The compiler reads files: the program is one for as long as it runs."""
    options = [x for folder in folders for x in ("-I", str(folder))]
    import tempfile

    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / f"{one.name}{'.slang' if path.suffix == '.slang' else '.hlsl'}"
        file.write_text(text, encoding="utf-8")
        found = slang.spirv(file, options)
        others = [p for p in found.files if p.is_file() and Path(place) not in p.parents]
    files |= {p.resolve(): p.read_bytes() for p in others if p.name != file.name}
    if not found.binary:
        raise messages.complaint(found.told)
    return found.binary
