"""Shaders that a project describes by name, for those whose files are not to be edited:
`[model.NAME]` in brdf-check.toml, with the keys of comments."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf.foreign.description import KEYS
from montecarlo_brdf.toml import Table, parse

FILE = "brdf-check.toml"
SECTION = "model"


class Described(NamedTuple):
    """A shader and what is said of it: statements with their places."""

    path: Path
    said: list[tuple[str, str]]


def find(name: str) -> Described | None:
    """The shader that the nearest brdf-check.toml describes by a name."""
    for folder in (Path(), *Path().resolve().parents):
        if (folder / FILE).is_file():
            return _described(folder / FILE, name)
    return None


def _described(file: Path, name: str) -> Described | None:
    data, text = parse(file)
    models = data.get(SECTION)
    if not isinstance(models, dict) or not isinstance(models.get(name), dict):
        return None
    table = Table(file, text, models[name], (SECTION, name))
    table.know(*KEYS)
    sources = _values(table, "source", table.take("source"))
    if not sources:
        raise table.error("source needs the path of a shader", "source")
    table.done()
    return Described(file.parent / sources[0], list(_statements(table, sources)))


def _statements(table: Table, sources: list[str]) -> Iterator[tuple[str, str]]:
    """Keys as comments have them; paths start at the shader's folder there, at the file's here."""
    folder = table.file.parent.resolve()
    for key, value in table.data.items():
        place = str(table.error("", key)).removesuffix(": ")
        named = value.items() if isinstance(value, dict) else [("", value)]
        for name, inner in named:
            texts = sources[1:] if key == "source" else _values(table, key, inner)
            for text in texts:
                path = str(folder / text) if key in ("source", "include") else text
                yield f"{key} {name} = {path}".replace("  ", " "), place


def _values(table: Table, key: str, value: Any) -> list[str]:
    """Texts, of a list all of them; true and false as comments have them."""
    values = value if isinstance(value, list) else [value]
    if any(isinstance(v, (dict, list)) for v in values):
        raise table.error(f"{key} must be text in quotes, or a list of that", key)
    texts = [str(v).lower() if isinstance(v, bool) else str(v) for v in values]
    return [line for text in texts for line in text.strip().splitlines()]
