"""Which language a shader is in, and SPIR-V by its compiler."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from montecarlo_brdf.foreign import entry, entry_point, glsl, glslang, hlsl, messages, slang
from montecarlo_brdf.foreign.description import Description, Language
from montecarlo_brdf.foreign.entry import Entry

SUFFIXES = {
    ".hlsl": Language.HLSL, ".hlsli": Language.HLSL, ".fx": Language.HLSL,
    ".cginc": Language.HLSL, ".slang": Language.SLANG, ".brdf": Language.EXPLORER,
}  # fmt: skip


def language_of(path: Path, said: Description) -> Language:
    """What its author says, else by its name."""
    return said.language or SUFFIXES.get(path.suffix, Language.GLSL)


def binaries(
    text: str, path: Path, said: Description, folders: list[Path], files: dict[Path, bytes]
) -> Iterator[tuple[str, bytes]]:
    """The SPIR-V of every entry; `files` gets what a compiler reads by itself.

    Raises Complaint where one does not compile.
    """
    said.parameters = [glsl.declared(text, p) for p in said.parameters]
    language = language_of(path, said)
    if language in (Language.HLSL, Language.SLANG):
        program = hlsl.Program(text, shown(path), said)
        for one in entry.entries(said):
            yield one.name, _by_slang(program.source(one), language, one, folders, files)
        return
    every = entry.entries(said)
    together = _by_glslang(glsl.Program(text, shown(path), said).source(every), path)
    for one in every:
        yield one.name, entry_point.alone(together, f"{glsl.ENTRY}{one.name}")


def macros(language: Language) -> dict[str, str]:
    """What a compiler defines by itself."""
    if language in (Language.HLSL, Language.SLANG):
        return {"__SLANG_COMPILER__": "1", "__HLSL_VERSION": "2018"}
    return {"__VERSION__": str(glsl.VERSION), "VULKAN": "100"}


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
    text: str, language: Language, one: Entry, folders: list[Path], files: dict[Path, bytes]
) -> bytes:
    """The compiler reads files: the program is one for as long as it runs."""
    options = [x for folder in folders for x in ("-I", str(folder))]
    import tempfile

    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / f"{one.name}.{language}"
        file.write_text(text, encoding="utf-8")
        found = slang.spirv(file, options)
        others = [p for p in found.files if p.is_file() and Path(place) not in p.parents]
    files |= {p.resolve(): p.read_bytes() for p in others if p.name != file.name}
    if not found.binary:
        raise messages.complaint(found.told)
    return found.binary
