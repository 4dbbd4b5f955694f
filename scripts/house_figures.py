"""How large the package is, how its functions are cut, and what a command passes through.

    python scripts/house_figures.py [--python PYTHON] [--tree FOLDER] [--json FILE] [--source]

Source of the package in a tree, by default this one: files, lines, lengths of functions, parameters
that say nothing of their type, repeated runs of lines. Then what a warm `furnace --model lambert`
and a warm `run` of a user's GGX pass through: functions and files of the package, calls of Python,
and processor time as a ratio to that of `import numba`, taken in turns.
"""
from __future__ import annotations

import argparse
import ast
import io
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from environment import describe

ROOT = Path(__file__).parents[1]
PACKAGE = "montecarlo_brdf"
RUN_LENGTH = 6  # lines that make a repetition
ROUNDS = 5

Function = ast.FunctionDef | ast.AsyncFunctionDef
Documented = ast.Module | ast.ClassDef | Function

#: what a user might write: GGX with its sampler and density, and nothing of ours
GGX = '''
import math
from typing import NamedTuple


class Params(NamedTuple):
    alpha: float = 0.3


domain = {"alpha": (0.02, 1.0)}


def half_vector(wo, wi):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def distribution(h, alpha):
    d = h[2] * h[2] * (alpha * alpha - 1.0) + 1.0
    return alpha * alpha / (math.pi * d * d)


def smith_lambda(w, alpha):
    tan2 = (1.0 - w[2] * w[2]) / (w[2] * w[2])
    return 0.5 * (math.sqrt(1.0 + alpha * alpha * tan2) - 1.0)


def f(wo, wi, p):
    d = distribution(half_vector(wo, wi), p.alpha)
    g = 1.0 / (1.0 + smith_lambda(wo, p.alpha) + smith_lambda(wi, p.alpha))
    return d * g / (4.0 * wo[2] * wi[2])


def sample(wo, u, p):
    cos = math.sqrt((1.0 - u[0]) / (1.0 + (p.alpha * p.alpha - 1.0) * u[0]))
    sin, phi = math.sqrt(max(0.0, 1.0 - cos * cos)), 2.0 * math.pi * u[1]
    h = sin * math.cos(phi), sin * math.sin(phi), cos
    c = 2.0 * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2])
    return c * h[0] - wo[0], c * h[1] - wo[1], c * h[2] - wo[2]


def pdf(wo, wi, p):
    h = half_vector(wo, wi)
    return distribution(h, p.alpha) * h[2] / (4.0 * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]))
'''

#: Bodies of modules and classes are not optimised code, functions are. A command ends by os._exit.
WATCH = """
import collections, inspect, json, os, runpy, sys, threading

target, calls = sys.argv.pop(1), collections.Counter()

def watch(frame, event, argument):
    if event == "call":
        calls[frame.f_code] += 1

def leave(code):
    sys.setprofile(None)
    threading.setprofile(None)
    bodies, functions = [], []
    for c, n in list(calls.items()):
        rows = functions if c.co_flags & inspect.CO_OPTIMIZED else bodies
        rows.append((c.co_filename, c.co_qualname, n))
    with open(target, "w") as file:
        json.dump({"functions": functions, "bodies": bodies}, file)
    end(code)

end, os._exit = os._exit, leave
threading.setprofile(watch)
sys.setprofile(watch)
try:
    runpy.run_module("montecarlo_brdf", run_name="__main__", alter_sys=True)
    leave(0)
except SystemExit as ended:
    leave(ended.code)
"""

COMMANDS = {
    "furnace --model lambert": ["furnace", "--model", "lambert"],
    "run --model my.py": ["run", "--model", "my.py"],
}


class Source(NamedTuple):
    """A file of the package."""

    path: Path
    text: str

    @property
    def lines(self) -> list[str]:
        return self.text.splitlines()

    def tree(self) -> ast.Module:
        return ast.parse(self.text)

    def tokens(self) -> Iterator[tokenize.TokenInfo]:
        return tokenize.generate_tokens(io.StringIO(self.text).readline)


def sources(tree: Path) -> list[Source]:
    """All Python files of the package."""
    paths = sorted((tree / PACKAGE).rglob("*.py"))
    return [Source(p.relative_to(tree), p.read_text(encoding="utf-8")) for p in paths]


def spanned(node: ast.stmt) -> range:
    """The lines that a statement stands on."""
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def docstring(node: Documented) -> range:
    """The lines of a docstring."""
    return spanned(node.body[0]) if ast.get_docstring(node) is not None else range(0)


def documented(source: Source) -> set[int]:
    """The lines of all docstrings of a file."""
    nodes = (n for n in ast.walk(source.tree()) if isinstance(n, Documented))
    return {line for node in nodes for line in docstring(node)}


def code_lines(source: Source) -> int:
    """Lines that are neither blank nor comment nor docstring."""
    skipped = documented(source)
    rows = enumerate(source.lines, 1)
    return sum(1 for k, row in rows if k not in skipped and not is_empty(row))


def is_empty(row: str) -> bool:
    """Whether a line is blank or a comment."""
    return not row.strip() or row.lstrip().startswith("#")


def functions(source: Source) -> list[Function]:
    """All functions and methods of a file, inner ones too."""
    return [n for n in ast.walk(source.tree()) if isinstance(n, Function)]


def length(function: Function) -> int:
    """Lines from `def` to the end, without the docstring."""
    return len(spanned(function)) - len(docstring(function))


def parameters(function: Function) -> list[ast.arg]:
    """What a function takes, without self."""
    a = function.args
    rest = [extra for extra in (a.vararg, a.kwarg) if extra]
    found = [*a.posonlyargs, *a.args, *a.kwonlyargs, *rest]
    return found[1:] if found and found[0].arg in ("self", "cls") else found


def says_nothing(parameter: ast.arg) -> bool:
    """Whether a parameter's type is Any or missing."""
    note = parameter.annotation
    return note is None or (isinstance(note, ast.Name) and note.id == "Any")


def mentions_any(parameter: ast.arg) -> bool:
    """Whether Any stands somewhere in a parameter's type."""
    note = parameter.annotation
    return note is not None and "Any" in {getattr(n, "id", "") for n in ast.walk(note)}


def size(package: list[Source]) -> dict[str, Any]:
    """Files and lines."""
    return {
        "files": len(package),
        "lines": sum(s.text.count("\n") for s in package),
        "code lines": sum(map(code_lines, package)),
    }


def cut(package: list[Source]) -> dict[str, Any]:
    """Functions and their lengths."""
    lengths = sorted(length(f) for s in package for f in functions(s))
    return {
        "functions": len(lengths),
        "median length": statistics.median(lengths),
        "p90 length": lengths[int(0.9 * (len(lengths) - 1))],
        "longest": lengths[-1],
    }


def typed(package: list[Source]) -> dict[str, Any]:
    """Parameters that say nothing of their type."""
    found = [p for s in package for f in functions(s) for p in parameters(f)]
    words = [t.string for s in package for t in s.tokens() if t.type == tokenize.NAME]
    return {
        "parameters": len(found),
        "share Any or missing": round(sum(map(says_nothing, found)) / len(found), 4),
        "share mentioning Any": round(sum(map(mentions_any, found)) / len(found), 4),
        "Any tokens": words.count("Any"),
    }


class Line(NamedTuple):
    """A line of code with its place."""

    text: str
    place: str


def normalised(source: Source) -> list[Line]:
    """Lines without indentation, blank lines, comments and imports."""
    nodes = (n for n in ast.walk(source.tree()) if isinstance(n, (ast.Import, ast.ImportFrom)))
    skipped = {line for node in nodes for line in spanned(node)}
    rows = enumerate(source.lines, 1)
    kept = [(k, row) for k, row in rows if k not in skipped and not is_empty(row)]
    return [Line(" ".join(row.split()), f"{source.path}:{k}") for k, row in kept]


class Repetitions:
    """Runs of lines that were seen before, each as long as it goes on."""

    def __init__(self) -> None:
        self.first: dict[tuple[str, ...], tuple[list[Line], int]] = {}
        self.found: list[dict[str, Any]] = []

    def read(self, lines: list[Line]) -> None:
        """Look through a file."""
        at = 0
        while at + RUN_LENGTH <= len(lines):
            at += self.taken(lines, at)

    def taken(self, lines: list[Line], at: int) -> int:
        """Lines to go on by: those of a repetition that begins here, or 1."""
        window = tuple(line.text for line in lines[at : at + RUN_LENGTH])
        earlier, begin = self.first.setdefault(window, (lines, at))
        if earlier is lines and at - begin < RUN_LENGTH:
            return 1
        count = common(earlier[begin:], lines[at:])
        places = {"lines": count, "at": lines[at].place, "first": earlier[begin].place}
        self.found.append(places)
        return count


def common(a: list[Line], b: list[Line]) -> int:
    """How many lines two lists begin with in common."""
    pairs = zip(a, b, strict=False)
    return next((k for k, (x, y) in enumerate(pairs) if x.text != y.text), min(len(a), len(b)))


def repeated(package: list[Source]) -> dict[str, Any]:
    """Repeated runs of lines."""
    repetitions = Repetitions()
    for source in package:
        repetitions.read(normalised(source))
    rows = sorted(repetitions.found, key=lambda row: -row["lines"])
    return {"runs": len(rows), "lines": sum(row["lines"] for row in rows), "places": rows}


class Place(NamedTuple):
    """Where commands run."""

    python: str
    tree: Path
    folder: Path

    def environment(self) -> dict[str, str]:
        """The tree's package, nobody's settings, and byte code that is kept."""
        rest = {k: v for k, v in os.environ.items() if not k.startswith("BRDF_CHECK_")}
        rest.pop("PYTHONDONTWRITEBYTECODE", None)
        ours = {"PYTHONPATH": str(self.tree), "BRDF_CHECK_CACHE_DIR": str(self.folder / "cache")}
        return {**rest, **ours}

    def call(self, arguments: list[str]) -> None:
        """A process of its own; a user's model may be refuted, which ends with 1 or 3."""
        command = [self.python, *arguments]
        done = subprocess.run(
            command, cwd=self.folder, env=self.environment(), stdout=subprocess.DEVNULL
        )
        if done.returncode not in (0, 1, 3):
            raise SystemExit(f"{' '.join(command)} ended with {done.returncode}")

    def seconds(self, arguments: list[str]) -> float:
        """Processor time of a process."""
        before = processor_time()
        self.call(arguments)
        return processor_time() - before


def processor_time() -> float:
    """Seconds that all processes took that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def passed_through(command: list[str], place: Place) -> dict[str, Any]:
    """Functions and files of the package that a command calls, and its calls of Python."""
    target = place.folder / "calls.json"
    place.call(["-c", WATCH, str(target), *command])
    found = {k: calls_of(rows) for k, rows in json.loads(target.read_text("utf-8")).items()}
    inside = f"{place.tree / PACKAGE}{os.sep}"
    ours = [c for c in found["functions"] if c.file.startswith(inside)]
    classes = [c for c in found["bodies"] if c.file.startswith(inside) and c.name != "<module>"]
    return {
        **distinct(ours, ""),
        **distinct(ours + classes, " with class bodies"),
        "calls of the package": sum(c.times for c in ours),
        "calls": sum(c.times for c in found["functions"]),
    }


class Calls(NamedTuple):
    """How often a function was called; a generator counts each time it goes on."""

    file: str
    name: str
    times: int

    def is_comprehension(self) -> bool:
        """Whether it is the inside of one, which only some versions of Python call."""
        return self.name.endswith(("<listcomp>", "<setcomp>", "<dictcomp>", "<genexpr>"))


def calls_of(rows: list[list[Any]]) -> list[Calls]:
    """Rows of the record of a process."""
    return [Calls(*row) for row in rows]


def distinct(calls: list[Calls], label: str) -> dict[str, int]:
    """How many functions, by file and name, and in how many files."""
    names = {(c.file, c.name) for c in calls if not c.is_comprehension()}
    return {f"functions{label}": len(names), f"files{label}": len({c.file for c in calls})}


def processor_times(place: Place) -> dict[str, dict[str, float]]:
    """Processor time of each command, and over that of `import numba`."""
    commands = {name: ["-m", PACKAGE, *command] for name, command in COMMANDS.items()}
    times: dict[str, list[float]] = {name: [] for name in ("numba", *commands)}
    for _ in range(ROUNDS):
        times["numba"].append(place.seconds(["-c", "import numba"]))
        for name, command in commands.items():
            times[name].append(place.seconds(command))
    return {name: medians(times[name], times["numba"]) for name in commands}


def medians(times: list[float], base: list[float]) -> dict[str, float]:
    """Of times and of their ratios to others that were taken in turns."""
    over_base = [a / b for a, b in zip(times, base, strict=True)]
    return {
        "processor seconds": round(statistics.median(times), 3),
        "time / import numba": round(statistics.median(over_base), 3),
    }


def warm(place: Place) -> dict[str, Any]:
    """What each command does when all is compiled."""
    (place.folder / "my.py").write_text(GGX, encoding="utf-8")
    for command in COMMANDS.values():
        place.call(["-m", PACKAGE, *command])
    found = {name: passed_through(command, place) for name, command in COMMANDS.items()}
    times = processor_times(place)
    return {name: {**row, **times[name]} for name, row in found.items()}


def figures_of_source(tree: Path) -> dict[str, dict[str, Any]]:
    """What reading the package tells."""
    package = sources(tree)
    return {
        "source": size(package),
        "functions": cut(package),
        "types": typed(package),
        f"repeated runs of {RUN_LENGTH} lines or more": repeated(package),
    }


def figures_of_commands(python: str, tree: Path) -> dict[str, dict[str, Any]]:
    """What running it tells."""
    with tempfile.TemporaryDirectory() as folder:
        return warm(Place(python, tree, Path(folder)))


def shown(found: dict[str, dict[str, Any]]) -> None:
    """Print all figures but places."""
    for title, rows in found.items():
        print(title)
        for name, value in rows.items():
            if not isinstance(value, list):
                print(f"  {name:28} {value:>10}")


def main() -> None:
    """Measure and print, and write if asked for."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--tree", type=Path, default=ROOT)
    parser.add_argument("--json", type=Path, help="record of all figures")
    parser.add_argument("--source", action="store_true", help="run no command, only read")
    options = parser.parse_args()
    tree = options.tree.resolve()
    found = figures_of_source(tree)
    if not options.source:
        found |= figures_of_commands(options.python, tree)
    shown(found)
    if options.json:
        load = round(os.getloadavg()[0], 1)  # times of a busy machine are not those of a quiet one
        report = {**describe(), "load average": load, **found}
        options.json.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
