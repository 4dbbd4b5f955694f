"""Models by name (a file in montecarlo_brdf/models) or by path (a user's own file)."""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
import traceback
import types
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from montecarlo_brdf import mixture
from montecarlo_brdf.errors import ModelError, UserError, unknown
from montecarlo_brdf.model import Model
from montecarlo_brdf.model_file import build, members

FOLDER = Path(__file__).parent / "models"


def names() -> list[str]:
    """The built-in models: every file of the folder that does not start with an underscore."""
    return sorted(p.stem for p in FOLDER.glob("*.py") if not p.stem.startswith("_"))


def load(spec: str, **picks: str) -> Model:
    """The model `spec`: a built-in name, `my_brdf.py`, `my_brdf.py:name`, or a weighted sum of
    them, "0.6 lambert + 0.4 ggx".

    spec: one of these. picks: one option per choice the model offers, e.g. norm="n+8".
    Raises UserError for an unknown name or a missing file, ModelError if the file does not load.
    """
    spec = str(spec)
    mixed = None if os.path.exists(spec) else mixture.parts(spec)
    if mixed:
        model = mixture.mixture([(weight, load(name)) for weight, name in mixed], spec)
        return model.variant(**picks) if picks else model
    path, _, member = spec.partition(".py:")
    if member:
        namespace = _member(spec, vars(_from_file(Path(path + ".py"))), member)
    elif spec.endswith(".py"):
        namespace = vars(_from_file(Path(spec)))
        if not callable(namespace.get("f")):
            offered = ", ".join(f"{spec}:{name}" for name in members(namespace))
            choose = f" (choose from {offered})" if offered else ""
            raise ModelError(f"{spec} defines no function f(wo, wi, p){choose}")
    elif spec in names():
        namespace = vars(importlib.import_module(f"montecarlo_brdf.models.{spec}"))
    else:
        raise UserError(unknown("model", spec, names()) + ", or give the path of a .py file")
    model = build(spec, namespace, {}, built_in=spec in names())
    return model.variant(**picks) if picks else model


def _from_file(path: Path) -> types.ModuleType:
    """Run a user's file as a module; its folder is importable while and after it runs."""
    if not os.path.isfile(path):  # also False for a name that no file can have
        raise UserError(f"no model file {path}")
    folder = str(path.resolve().parent)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    module = types.ModuleType(path.stem)
    module.__file__ = str(path)
    try:
        with _running(module):
            exec(_compiled(path), vars(module))  # noqa: S102
    except SyntaxError as error:
        raise ModelError(f"{path}, line {error.lineno or 1}: {error.msg}") from error
    except (Exception, SystemExit) as error:
        raise ModelError(f"{path} {raised(error, path)} while it was loaded") from error
    return module


@contextlib.contextmanager
def _running(module: types.ModuleType) -> Iterator[None]:
    """While a module runs, it is known by its name, as dataclasses expect, unless another is; and
    modules of the user's are read from their source: Python's own cache of them looks at seconds
    and sizes, and misses an edit from 2.0 to 3.0 within the same second."""
    mine = sys.modules.setdefault(module.__name__, module) is module
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = before
        if mine:
            sys.modules.pop(module.__name__, None)


def _compiled(path: Path) -> types.CodeType:
    try:
        return compile(path.read_bytes(), str(path), "exec")
    except ValueError as error:  # what a null byte raises before Python 3.11.4
        raise SyntaxError(str(error)) from error


def _member(spec: str, namespace: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """The model `name` within a file: a class with f, or a function with name_sample, name_pdf."""
    value = namespace.get(name)
    if isinstance(value, type):
        inside = {k: getattr(value, k) for k in dir(value) if not k.startswith("__")}
        return {**namespace, **dict.fromkeys(("sample", "pdf")), **inside}
    if not callable(value):
        file = spec.rpartition(":")[0]
        raise UserError(f"{file} has " + unknown("model", name, members(namespace)))
    own = {k: namespace.get(f"{name}_{k}") for k in ("sample", "pdf")}
    params = namespace.get(f"{name}_Params") or namespace.get("Params")
    return {**namespace, "f": value, **own, **({"Params": params} if params else {})}


def raised(error: BaseException, path: Path | str) -> str:
    """'raised ValueError (line 3): message', the line being the last one inside `path`."""
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(path)]
    where = f" (line {lines[-1]})" if lines else ""
    message = " ".join(str(error).split())
    return f"raised {type(error).__name__}{where}{': ' + message if message else ''}"
