"""What there is to check: models with their parameter sets, where to look and how closely.

Requests come from the command line or from a project's own list, brdf-check.toml or
[tool.brdf-check] in pyproject.toml; both are run in the same way. The keys and what they mean:
docs/ci.md. A mistake is reported with its line and what is allowed.
"""
from __future__ import annotations

import contextlib
import functools
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from montecarlo_brdf import checks, loading
from montecarlo_brdf.cli._options import numbers, parameter_sets, whole_number
from montecarlo_brdf.cli._specs import expanded
from montecarlo_brdf.counterpart import counterpart
from montecarlo_brdf.errors import ModelError, UserError, unknown
from montecarlo_brdf.estimate.plan import Progress, check_theta
from montecarlo_brdf.judge.finding import Policy, Report
from montecarlo_brdf.measured import merl
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.text import called
from montecarlo_brdf.sampling.points import SETS
from montecarlo_brdf.toml import Keys, Table, parse
from montecarlo_brdf.verify.question import Heard, shown_parameters
from montecarlo_brdf.verify.run import ANGLES, SAMPLES, run
from montecarlo_brdf.verify.supervision import Deadline

FILE = "brdf-check.toml"
PYPROJECT = "pyproject.toml"
INSIDE: Keys = ("tool", "brdf-check")


class Terms(NamedTuple):
    """What is asked and how closely: what `verify.run` takes besides a model's parameters."""

    names: tuple[str, ...] | None = None  # of checks; None: all
    theta_o_deg: Sequence[float] = ANGLES
    phi_o_deg: float = 0.0
    against: str | None = None  # as `counterpart` takes it
    points: str = "sobol"
    samples: int = SAMPLES
    seed: int = 0
    tolerance: float | None = None
    tolerances: Mapping[str, float] = MappingProxyType({})  # of single checks
    effort: float = 1.0


class Request(NamedTuple):
    """One model and what is asked of it."""

    model: Model
    terms: Terms
    p: list[Any] | None = None  # None: the defaults, and a search over the whole ranges
    fixed: tuple[str, ...] = ()  # parameters that the search leaves alone
    against: Model | None = None

    def title(self) -> str:
        """'lambert(albedo=0.2)'; of what is searched only the name."""
        if self.p is None:
            return self.model.name
        return called(self.model.name, shown_parameters(self.model.of(self.p[0]), self.p[0]))

    def single(self) -> list[Request]:
        """One request per parameter set."""
        return [self] if self.p is None else [self._replace(p=[one]) for one in self.p]

    def only(self, *names: str) -> Request:
        """The same for some checks."""
        return self._replace(terms=self.terms._replace(names=names))

    def run(
        self, deadline: Deadline | None = None, threads: int | None = None,
        progress: Progress | None = None, heard: Heard | None = None,
    ) -> Report:  # fmt: skip
        """The report of `verify.run`."""
        return run(
            self.model, self.p, fixed=self.fixed, deadline=deadline, threads=threads,
            progress=progress, heard=heard, **{**self.terms._asdict(), "against": self.against},
        )  # fmt: skip


class Broken(NamedTuple):
    """A model that does not load, among others that do."""

    name: str
    error: ModelError

    def title(self) -> str:
        """Its name."""
        return self.name

    def single(self) -> list[Broken]:
        """Itself."""
        return [self]

    def only(self, *names: str) -> Broken:
        """Itself."""
        return self

    @property
    def terms(self) -> Terms:
        """It has one thing to say, whatever is asked."""
        return Terms(("load",))

    def run(
        self, deadline: Deadline | None = None, threads: int | None = None,
        progress: Progress | None = None, heard: Heard | None = None,
    ) -> Report:  # fmt: skip
        """What is wrong with it."""
        raise self.error


def unless_all_broken(requests: list[Request | Broken]) -> list[Request | Broken]:
    """The requests. Raises what is wrong with the first if there is none that can be run."""
    if all(isinstance(one, Broken) for one in requests):
        for one in requests:
            one.run()
    return requests


def request(model: Model, assignments: Sequence[str], terms: Terms) -> Request:
    """The request for parameters written as -p takes them."""
    fixed = tuple(a.partition("=")[0].strip() for a in assignments)
    sets = parameter_sets(model, assignments) if assignments else None
    other = counterpart(terms.against, model, fixed) if terms.against else None
    return Request(model, terms, sets, fixed, other)


class Project(NamedTuple):
    """What a file asks for."""

    requests: list[Request | Broken]
    max_time: float | None
    inconclusive: Policy | None


class Section(Table):
    """A table of the file."""

    def title(self) -> str:
        """The file's own name for what stands at its top; a pyproject.toml is not all ours."""
        if not self.path:
            return self.file.name
        if isinstance(self.path[-1], int):
            return super().title()
        return f"[{'.'.join(str(part) for part in self.path if not isinstance(part, int))}]"


def find(folder: Path) -> Path | None:
    """The file that speaks for a folder: in it, or in the nearest folder above it."""
    for place in (folder, *folder.resolve().parents):
        if (place / FILE).is_file():
            return place / FILE
        if speaks(place / PYPROJECT):
            return place / PYPROJECT
    return None


def speaks(path: Path) -> bool:
    """Whether a pyproject.toml has a [tool.brdf-check]."""
    if not path.is_file() or "brdf-check" not in path.read_text(encoding="utf-8", errors="replace"):
        return False
    tools = parse(path)[0].get("tool", {})
    return isinstance(tools, dict) and INSIDE[1] in tools


def read(path: Path, overrides: Mapping[str, Any] | None = None) -> Project:
    """The requests of a file; `overrides` (fields of Terms) stand above what it says."""
    data, text = parse(path)
    at: Keys = INSIDE if path.name == PYPROJECT else ()
    for name in at:
        data = data.get(str(name), {})
    top = Section(path, text, data, at)
    limit = top.number("max_time", low=1e-3) if "max_time" in data else None
    policy = Policy(top.choice("inconclusive", tuple(Policy))) if "inconclusive" in data else None
    top.know("inconclusive", "max_time", *SHARED)
    if isinstance(data.get("model"), dict):  # [model.NAME]: shaders that `load` knows by name
        top.know("model")
    terms = _shared(top, Terms())
    entries = top.tables("models")
    top.done()
    if not entries:
        raise top.error('there is nothing to check: add [[models]] with model = "ggx"')
    requests = [one for entry in entries for one in _requests(entry, terms, overrides or {})]
    return Project(unless_all_broken(requests), limit, policy)


def _requests(
    entry: Table, terms: Terms, overrides: Mapping[str, Any]
) -> list[Request | Broken]:
    """The requests of one [[models]]: several where a pattern or a folder stands for models."""
    entry.know("model", "params", "against", *SHARED)
    terms = _shared(entry, terms)
    found = [_model(entry, "model", spec) for spec in _specs(entry, "model")]
    models = [one for one in found if isinstance(one, Model)]
    if not models:
        return [one for one in found if isinstance(one, Broken)]
    if "against" in entry.data:
        terms = terms._replace(against=_against(entry))
    assignments = _assignments(entry)
    entry.done()
    terms = terms._replace(**overrides)
    try:
        return [
            request(one, assignments, terms) if isinstance(one, Model) else one for one in found
        ]
    except UserError as error:
        key = "params" if "params" in entry.data else "against"
        raise entry.error(str(error), key) from error


def _shared(table: Table, above: Terms) -> Terms:
    """What may stand at the top and in [[models]]: terms, and a tolerance per check."""
    asked = [(key, *READ[key]) for key in table.data if key in READ]
    found = {field: read(table, key) for key, field, read in asked}
    return above._replace(**found, tolerances={**above.tolerances, **_tolerances(table)})


def _checks(table: Table, key: str) -> tuple[str, ...]:
    value = table.take(key)
    names = [value] if isinstance(value, str) else value
    known = checks.names()
    if not isinstance(names, list) or not names:
        raise table.error(f"{key} must be a list of names (choose from {', '.join(known)})", key)
    for name in names:
        if name not in known:
            raise table.error(unknown("check", name, known), key)
    return tuple(names)


def _tolerances(table: Table) -> dict[str, float]:
    if "tolerances" not in table.data:
        return {}
    inner = table.table("tolerances")
    inner.know(*checks.names())
    inner.done()
    return {name: _tolerance(inner, name) for name in inner.data}


def _angles(table: Table, key: str) -> list[float]:
    """[0, 45, 80] or "0:85:6"."""
    value = table.take(key)
    try:
        listed = value if isinstance(value, list) else [value]
        if not listed:
            raise UserError(f"{key} needs an angle at least")
        angles = [a for v in listed for a in numbers(str(v), key)]
        for angle in angles:
            check_theta(angle, key)
    except UserError as error:
        raise table.error(str(error), key) from error
    return angles


def _whole(low: int, high: int, table: Table, key: str) -> int:
    value = table.take(key)
    if isinstance(value, str):  # "2^20", as on the command line
        with contextlib.suppress(ValueError):
            value = whole_number(value, key)
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise table.error(f"{key} must be a whole number from {low} to {high}, not {value!r}", key)
    return value


def _tolerance(table: Table, key: str) -> float:
    return table.number(key, low=0.0, high=1.0 - 1e-12)


def _spec(table: Table, key: str) -> str:
    """A model's name, or its path, which starts at the file's folder."""
    spec = table.text_of(key)
    return _from_here(table, spec) if loading.is_path(spec) else spec


def _from_here(table: Table, spec: str) -> str:
    """A path that starts at the file's folder, from where one stands."""
    folder, mark = table.file.parent, merl.MARK if merl.is_measured(spec) else ""
    path = Path(spec.removeprefix(mark))
    outside = path.is_absolute() or folder == Path()
    return spec if outside else mark + os.path.relpath(folder / path)


def _specs(table: Table, key: str) -> list[str]:
    """The models that a name, a pattern of files or a folder stands for."""
    spec = table.text_of(key)
    try:
        return expanded(_from_here(table, spec) if _is_place(table, spec) else spec)
    except UserError as error:
        raise table.error(str(error), key) from error


def _is_place(table: Table, spec: str) -> bool:
    return loading.is_path(spec) or (table.file.parent / spec).is_dir()


def _model(table: Table, key: str, spec: str) -> Model | Broken:
    """The model that a key names."""
    try:
        return loading.load(spec)
    except ModelError as error:
        return Broken(spec, ModelError(str(table.error(str(error), key))))
    except UserError as error:
        raise type(error)(str(table.error(str(error), key))) from error


def _against(entry: Table) -> str:
    """A name, a path, or { model = ..., params = { theirs = "ours" } }."""
    if isinstance(entry.data["against"], str):
        return _spec(entry, "against")
    inner = entry.table("against")
    spec = _spec(inner, "model")
    params = inner.table("params", {}).data
    inner.done()
    for name, value in params.items():
        if isinstance(value, bool) or not isinstance(value, (str, int, float)):
            raise inner.error(f"{name} must be a name of ours or a number, not {value!r}", "params")
    said = ", ".join(f"{name}={value}" for name, value in params.items())
    return f"{spec}({said})" if said else spec


def _assignments(entry: Table) -> list[str]:
    """params as -p takes them: a list makes cases, a list inside it a colour."""
    if "params" not in entry.data:
        return []
    params = entry.table("params")
    return [f"{name}={_text(params, name, value)}" for name, value in params.data.items()]


def _text(params: Table, name: str, value: object) -> str:
    values = value if isinstance(value, list) else [value]
    words = ["/".join(map(str, v)) if isinstance(v, list) else v for v in values]
    if not words or any(isinstance(w, (bool, dict)) for w in words):
        raise params.error(f"{name} must be a number, text as -p takes it, or a list of them", name)
    return ",".join(map(str, words))


#: key of the file -> the term that it says, and how it is read
READ: dict[str, tuple[str, Callable[[Table, str], Any]]] = {
    "checks": ("names", _checks),
    "theta_o": ("theta_o_deg", _angles),
    "phi_o": ("phi_o_deg", Table.number),
    "points": ("points", functools.partial(Table.choice, allowed=SETS)),
    "samples": ("samples", functools.partial(_whole, 1, 1 << 40)),
    "seed": ("seed", functools.partial(_whole, 0, (1 << 64) - 1)),
    "tolerance": ("tolerance", _tolerance),
}
#: may stand at the top and in each [[models]]
SHARED = (*READ, "tolerances")
