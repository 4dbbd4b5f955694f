"""Models by name (a file in montecarlo_brdf/models) or by path (a user's own file)."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import importlib
import os
import sys
import traceback
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf import mixture
from montecarlo_brdf.contract import Namespace, build
from montecarlo_brdf.errors import ModelError, UserError, unknown
from montecarlo_brdf.files import know_input
from montecarlo_brdf.foreign import c_model, project, translation
from montecarlo_brdf.measured import merl
from montecarlo_brdf.model import Model
from montecarlo_brdf.models import names as names

#: suffixes of languages that no model is written in
OTHERS = ("osl", "wgsl", "metal", "h", "cu")


def is_path(spec: str) -> bool:
    """Whether a model is asked for by its file: Python, a shader, C, or what was measured."""
    known = translation.is_shader(spec) or c_model.is_c(spec) or merl.is_measured(spec)
    return ".py" in spec or known


def load(spec: str, **picks: str) -> Model:
    """The model `spec`: a built-in name, `my_brdf.py`, `my_brdf.py:name`, a shader `my.glsl`, a
    measured file `merl:my.binary`, or a weighted sum of them, "0.6 lambert + 0.4 ggx".

    spec: one of these. picks: one option per choice the model offers, e.g. norm="n+8".
    Raises UserError for an unknown name or a missing file, ModelError if the file does not load.
    """
    spec = str(spec)
    mixed = None if os.path.exists(spec) else mixture.parts(spec)
    if mixed:
        model = mixture.mixture([(weight, load(name)) for weight, name in mixed], spec)
        return model.variant(**picks) if picks else model
    path, _, member = spec.partition(".py:")
    if merl.is_measured(spec):
        namespace = merl.namespace(spec)
    elif member:
        namespace = _member(spec, vars(_from_file(Path(path + ".py"))), member)
    elif translation.is_shader(spec):
        return _shader(Path(spec), picks)
    elif c_model.is_c(spec):
        namespace = _c(spec)
    elif spec.endswith(".py"):
        namespace = vars(_from_file(Path(spec)))
        if not callable(namespace.get("f")):
            offered = ", ".join(f"{spec}:{name}" for name in members(namespace))
            choose = f" (choose from {offered})" if offered else ""
            raise ModelError(f"{spec} defines no function f(wo, wi, p){choose}")
    elif spec in names():
        namespace = vars(importlib.import_module(f"montecarlo_brdf.models.{spec}"))
    elif described := project.find(spec):
        if not c_model.is_c(str(described.path)):
            return _shader(described.path, picks, spec, described.said)
        namespace = _c(str(described.path), described.said)
    else:
        raise UserError(_no_model(spec))
    model = build(spec, namespace, built_in=spec in names())
    return model.variant(**picks) if picks else model


def function(spec: str) -> Callable[..., Any]:
    """The function of `file.py:name`, whatever it is for. Raises as `load` does."""
    path, _, name = spec.rpartition(":")
    found: Callable[..., Any] | None = vars(_from_file(Path(path))).get(name)
    if found is None or not callable(found):
        raise UserError(f"{path} has no function {name}")
    return found


def _no_model(spec: str) -> str:
    """Why a name stands for no model."""
    suffix = Path(spec).suffix
    if suffix == merl.SUFFIX and os.path.isfile(spec):
        return f"{spec} is no model by itself: a measured file is named {merl.MARK}{spec}"
    if suffix and suffix[1:].isalpha() and (os.path.isfile(spec) or suffix[1:] in OTHERS):
        return f"{spec} is neither a Python file, with a function f(wo, wi, p), nor a shader"
    return unknown("model", spec, names()) + ", or give the path of a .py file or of a shader"


def _shader(
    path: Path, picks: Mapping[str, str], name: str = "", said: Sequence[tuple[str, str]] = ()
) -> Model:
    """A model in a shading language, with its single precision beside it."""
    if not os.path.isfile(path):
        raise UserError(f"no model file {path}")
    know_input(path)
    found = translation.translated(path, said)
    model = build(name or str(path), vars(translation.module(path, found.double)))
    if found.single:
        model = dataclasses.replace(model, single=functools.partial(_single, path, found.single))
    return model.variant(**picks) if picks else model


def _c(spec: str, said: Sequence[tuple[str, str]] = ()) -> Namespace:
    """A model in C or C++, or in a library that such became."""
    path, _ = c_model.parts(spec)
    if not os.path.isfile(path):
        raise UserError(f"no model file {path}")
    know_input(path)
    return vars(c_model.module(spec, said))


def _single(path: Path, text: str) -> Namespace:
    """The same functions, rounded as a shader is; numpy, which they need, is slow to import."""
    return vars(translation.module(path, text))


def _from_file(path: Path) -> types.ModuleType:
    """Run a user's file as a module; its folder is importable while and after it runs."""
    if not os.path.isfile(path):  # also False for a name that no file can have
        raise UserError(f"no model file {path}")
    know_input(path)
    package, root = _package(path.resolve().parent)
    for folder in {str(path.resolve().parent), str(root)}:  # first, whatever was loaded before
        sys.path[:] = [folder, *(other for other in sys.path if other != folder)]
    _forget_namesakes(path.resolve().parent)
    module = types.ModuleType(path.stem)
    module.__file__ = str(path)
    if package:  # so that `from .util import x` works
        module.__package__ = package
        _forget_namesake(package.partition(".")[0], root)
    try:
        with _running(module):
            exec(_compiled(path), vars(module))  # noqa: S102
    except SyntaxError as error:
        raise ModelError(f"{path}, line {error.lineno or 1}: {error.msg}") from error
    except (Exception, SystemExit) as error:
        raise ModelError(f"{path} {raised(error, path)} while it was loaded") from error
    return module


def _package(folder: Path) -> tuple[str, Path]:
    """The package that a folder is, 'materials.metals', and the folder that it is imported from."""
    names: list[str] = []
    while (folder / "__init__.py").is_file():
        names.insert(0, folder.name)
        folder = folder.parent
    return ".".join(names), folder


_folders: set[str] = set()  # of files that were run


def _forget_namesakes(folder: Path) -> None:
    """A module beside another model must not stand for that of the same name beside this one."""
    for name, module in list(sys.modules.items()):
        beside = os.path.dirname(getattr(module, "__file__", None) or "")
        if beside in _folders and beside != str(folder) and (folder / f"{name}.py").is_file():
            del sys.modules[name]
    _folders.add(str(folder))


def _forget_namesake(package: str, root: Path) -> None:
    """Another project's package of the same name must not stand for this one."""
    known = getattr(sys.modules.get(package), "__file__", None)
    if known and Path(known).resolve().parent.parent != root:
        for name in [n for n in sys.modules if n == package or n.startswith(f"{package}.")]:
            del sys.modules[name]


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


def _member(spec: str, namespace: Namespace, name: str) -> Namespace:
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


def members(namespace: Namespace) -> Iterator[str]:
    """Names in a file that could be a model: its own functions (wo, wi, p) and classes with f."""
    for key, value in namespace.items():
        own = getattr(value, "__module__", None) == namespace.get("__name__")
        if own and not key.startswith("_") and _could_be_model(key, value):
            yield key


def _could_be_model(key: str, value: Any) -> bool:
    if isinstance(value, type):
        return hasattr(value, "f")
    part_of_another = key.endswith(("_sample", "_pdf")) or key in ("sample", "pdf")
    three = isinstance(value, types.FunctionType) and value.__code__.co_argcount == 3
    return three and not part_of_another
