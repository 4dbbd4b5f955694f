"""Many models by one name: patterns of files, and folders."""
from __future__ import annotations

import ast
import glob
import os
from collections.abc import Iterator
from pathlib import Path

import click

from montecarlo_brdf import loading
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.foreign.translation import SUFFIXES


def expanded(spec: str) -> list[str]:
    """The models that a name stands for: itself, or the files that fit a pattern, in their order,
    or those of a folder and the folders below it.

    Raises UserError if there is none.
    """
    if os.path.isdir(spec):
        return _of_folder(spec)
    if glob.has_magic(spec) and not os.path.exists(spec) and loading.is_path(spec):
        found = sorted(glob.glob(spec, recursive=True))
        if not found:
            raise UserError(f"no file fits {spec}")
        return found
    return [spec]


def _of_folder(folder: str) -> list[str]:
    """Files of models in a folder; which Python files are none is told."""
    files = sorted(path for path in Path(folder).rglob("*") if path.suffix in (".py", *SUFFIXES))
    files = [path for path in files if path.is_file() and not _hidden(path.relative_to(folder))]
    found = [path for path in files if path.suffix != ".py" or _defines_f(path)]
    if not found:
        raise UserError(f"there is no file of a model in {folder}")
    others = [path.relative_to(folder).as_posix() for path in files if path not in found]
    if others:
        click.echo(f"{folder}: no model, without a function f: {', '.join(others)}", err=True)
    return [str(path) for path in found]


def _hidden(path: Path) -> bool:
    return any(part.startswith((".", "__")) for part in path.parts)


def _defines_f(path: Path) -> bool:
    """Whether a Python file binds f; one that cannot be read as Python is somebody's mistake, to be
    told by whoever loads it."""
    try:
        return "f" in set(_bound(ast.parse(path.read_bytes())))
    except (SyntaxError, ValueError, OSError):
        return True


def _bound(module: ast.Module) -> Iterator[str]:
    for node in module.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.ImportFrom | ast.Import):
            yield from (alias.asname or alias.name for alias in node.names)
        elif isinstance(node, ast.Assign):
            yield from (t.id for t in node.targets if isinstance(t, ast.Name))
