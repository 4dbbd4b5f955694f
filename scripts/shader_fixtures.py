"""SPIR-V of the shaders in tests/foreign/shaders, so that tests need no compiler of theirs.

Run: python scripts/shader_fixtures.py, with the package's extra `shaders` installed.
"""
from __future__ import annotations

from pathlib import Path

from montecarlo_brdf.foreign import language, translate

TESTS = Path(__file__).parents[1] / "tests" / "foreign"


def main() -> None:
    for path in sorted((TESTS / "shaders").iterdir()):
        shader = translate.opened(path)
        found = language.binaries(shader.text, path, shader.said, shader.folders, shader.files)
        for name, binary in found:
            file = TESTS / "spirv" / f"{path.name}.{name}.spv"
            file.write_bytes(binary)
            print(f"{file.name}: {file.stat().st_size} bytes")


if __name__ == "__main__":
    main()
