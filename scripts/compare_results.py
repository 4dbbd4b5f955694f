"""Whether a restructuring changes a result: the same commands before and after, number by number.

    python scripts/compare_results.py record FILE [--python PYTHON] [--tree FOLDER] [--cache FOLDER]
    python scripts/compare_results.py compare BEFORE AFTER

`record` runs every command of COMMANDS in a tree of the repository, by default this one, and keeps
exit codes and results. A cache that is kept (--cache; by default it is empty) makes the next record
of the same tree short; two trees need two of them, for what is remembered is not computed again.
`compare` prints every difference; the exit code is 1 if there is any.
"""
from __future__ import annotations

import argparse
import concurrent.futures
import itertools
import json
import math
import os
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
ABSENT = "absent"
ROUNDING = 1e-14  # relative; what another order of the same sums may cost
LONGEST = 160  # characters of a value that are shown

FURNACE = """
--model lambert
--model lambert -p albedo=0.9/0.5/0.1 --theta-o 0,60 --points independent --samples 2^16
--model lambert_unnormalised -p c=0.5 --theta-o 0,60 --sampler cosine
--model ggx -p alpha=0.05,0.3 --theta-o 0,45,80 --tolerance 1e-3
--model ggx -p alpha=0.3 --target-error 1e-6
--model ggx -p f0=1/0.7/0.3 --method auto --theta-o 30,75
--model ggx -p alpha=0.01 --theta-o 0 --sampler uniform --samples 2^14
--model ggx_anisotropic --theta-o 60 --phi-o 35 --points lattice
--model phong -p n=1,200 --theta-o 0,70 --sampler own,uniform --points stratified
--model blinn_phong -p norm=exact --theta-o 20 --seed 7
--model oren_nayar --theta-o 10,80 --target-error 1e-4
--model disney_diffuse -p roughness=1 --theta-o 85
--model cook_torrance -p distribution=beckmann -p masking=v_cavity -p fresnel=schlick --theta-o 45
--model minnaert -p k=0.5 --theta-o 0:80:3 --method given --points independent --tolerance 1e-3
--model '0.6 lambert + 0.4 ggx' --theta-o 0,60
--model '0.7 lambert + 0.7 phong' --theta-o 30 --sampler own --samples 2^16
--model tests/honest/rejection_sampler.py --theta-o 0,60
--model lambert -p albedo=2
"""

RUN = """
--model lambert
--model ggx --check positivity,reciprocity,limits
--model schlick_ggx -p alpha=0.3 -p k=ibl --check energy,pdf,isotropy
--model tests/mutants/ggx_missing_quarter.py
--model tests/mutants/ggx_sampler_alpha_squared.py --against ggx --check equality,pdf,sampling
--model tests/mutants/isotropy_broken_when_brushed.py
--model tests/mutants/limit_not_met.py
--model tests/mutants/nan_at_equal_indices.py
--model tests/mutants/samples_not_unit.py
--model tests/mutants/weight_alone_wrong.py
--model tests/honest/ggx_same_as.py --check equality,radiance
--model tests/honest/kinked_toon.py --check furnace,energy --theta-o 20
--model tests/honest/weights_alone.py
"""

RADIANCE = """
examples/lambert.toml
examples/lambert_without_pi.toml
examples/phong.toml
examples/blinn_phong.toml
examples/cook_torrance.toml
examples/standard.toml --no-skip
--model lambert -p albedo=0.8/0.4/0.2 --environment constant:1 --theta-o 0,60
--model ggx -p alpha=0.1 --environment cosine:8
--model oren_nayar --environment cap:10:60 --theta-o 30 --points independent --samples 2^16
--model tests/mutants/ggx_missing_quarter.py --environment gradient --theta-o 30
examples/missing.toml
tests/mutants/causes.toml
--model lambert --environment cap:200
"""

CONVERGE = """
--model lambert --sampler uniform --samples 2^16
--model ggx -p alpha=0.3 --points sobol,independent --samples 2^16
--model oren_nayar --theta-o 60 --sampler panels,cosine --samples 2^16
--model phong --theta-o 30 --sampler mirror,uniform --points lattice --samples 2^16
--model tests/mutants/lambert_missing_pi.py --points stratified --samples 2^14
--model tests/honest/retro_lobe.py --phi-o 45 --sampler own,cosine --points sobol --samples 2^14
"""

STRESS = """
--quick --model lambert
--quick --model ggx -p alpha=0.01
--quick --compare textbook_ggx ggx
--quick --model tests/mutants/ggx_naive_tangent.py --precision float32 --max-error 1e-4
"""

IDENTITIES = """
--samples 2^18
--points independent --tolerance 1e-3 --seed 7
"""

COMPARE = """
ggx beckmann --theta-o 0,60 --tolerance 0.01
phong lafortune_willems --theta-o 30
tests/honest/ggx_same_as.py ggx -p alpha=0.1,0.5
tests/mutants/ggx_missing_quarter.py ggx --theta-o 45 --seed 7
"""

#: a file that they name must have the same path before and after
COMMANDS = [
    f"{command} {line}"
    for command, lines in {
        "furnace": FURNACE, "run": RUN, "radiance": RADIANCE, "converge": CONVERGE,
        "stress": STRESS, "identities": IDENTITIES, "compare": COMPARE,
    }.items()
    for line in lines.split("\n")[1:-1]
]  # fmt: skip


class Place(NamedTuple):
    """Where commands run."""

    python: str
    tree: Path
    cache: Path

    def environment(self) -> dict[str, str]:
        """The tree's package and nobody's settings: every option can be set by a variable."""
        rest = {k: v for k, v in os.environ.items() if not k.startswith("BRDF_CHECK_")}
        rest.pop("PYTHONDONTWRITEBYTECODE", None)  # every process would compile the package anew
        ours = {"PYTHONPATH": str(self.tree), "BRDF_CHECK_CACHE_DIR": str(self.cache)}
        return {**rest, **ours, "COLUMNS": "200", "NO_COLOR": "1"}


def outcome(command: str, place: Place) -> dict[str, Any]:
    """Exit code and results of a command, or what it says if it has none."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        # not --export: `stress` may leave it unwritten, and `furnace` adds its curve to this one
        done = call([*shlex.split(command), "--export-json", str(report)], place)
        if report.exists():
            results = json.loads(report.read_text(encoding="utf-8"))["results"]
            return {"exit": done.returncode, "results": results}
        return {"exit": done.returncode, "stderr": done.stderr.strip().rpartition("\n")[2]}


def call(arguments: list[str], place: Place) -> subprocess.CompletedProcess[str]:
    """brdf-check in a process of its own."""
    return subprocess.run(
        [place.python, "-m", "montecarlo_brdf", *arguments],
        cwd=place.tree,
        env=place.environment(),
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


def told(command: str, place: Place) -> dict[str, Any]:
    """The outcome of a command, with a line of progress."""
    started = time.perf_counter()
    found = outcome(command, place)
    seconds = time.perf_counter() - started
    print(f"{seconds:6.1f} s  exit {found['exit']}  {command}", file=sys.stderr, flush=True)
    return found


def outcomes(place: Place, jobs: int) -> dict[str, Any]:
    """Command -> outcome."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        found = pool.map(lambda command: told(command, place), COMMANDS)
        return dict(zip(COMMANDS, found, strict=True))


def record(options: argparse.Namespace) -> int:
    """Run all commands and write what came of them."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(options.cache or folder).resolve()
        place = Place(options.python, Path(options.tree).resolve(), cache)
        found = outcomes(place, options.jobs)
    options.file.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    return 0


class Difference(NamedTuple):
    """A value that is not the same."""

    path: str
    before: Any
    after: Any

    def is_rounding(self) -> bool:
        """Whether two numbers are equal but for the last digits."""
        numbers = [v for v in self[1:] if isinstance(v, (int, float)) and not isinstance(v, bool)]
        return len(numbers) == 2 and math.isclose(*numbers, rel_tol=ROUNDING)

    def __str__(self) -> str:
        return f"{self.path}: {shown(self.before)} -> {shown(self.after)}"


def shown(value: Any) -> str:
    """A value in one line that is not too long."""
    text = repr(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def differences(before: Any, after: Any, path: str = "") -> Iterator[Difference]:
    """All of two values of JSON, in their order; NaN is the same as NaN, 1 is not 1.0."""
    if isinstance(before, dict) and isinstance(after, dict):
        for key in dict.fromkeys([*before, *after]):
            name = f"{path}.{key}" if path else key
            yield from differences(before.get(key, ABSENT), after.get(key, ABSENT), name)
    elif isinstance(before, list) and isinstance(after, list):
        for k, pair in enumerate(itertools.zip_longest(before, after, fillvalue=ABSENT)):
            yield from differences(*pair, f"{path}[{k}]")
    elif repr(before) != repr(after):
        yield Difference(path or "outcome", before, after)


def compare(options: argparse.Namespace) -> int:
    """Print the differences of two records."""
    before, after = (json.loads(f.read_text(encoding="utf-8")) for f in options.files)
    changed: dict[str, list[Difference]] = {}
    rounded: dict[str, list[Difference]] = {}
    commands = dict.fromkeys([*before, *after])
    for command in commands:
        for d in differences(before.get(command, ABSENT), after.get(command, ABSENT)):
            (rounded if d.is_rounding() else changed).setdefault(command, []).append(d)
    counts = [listed("differs", changed), listed("rounding", rounded)]
    print(f"{len(commands)} commands: {counts[0]} differences, {counts[1]} by rounding")
    return 1 if any(counts) else 0


def listed(kind: str, found: dict[str, list[Difference]]) -> int:
    """Print differences command by command; how many they are."""
    for command, rows in found.items():
        print(f"{kind}: {command}", *rows, sep="\n  ")
    return sum(map(len, found.values()))


def main() -> int:
    """Record or compare."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    tasks = parser.add_subparsers(required=True)
    one = tasks.add_parser("record")
    one.add_argument("file", type=Path)
    one.add_argument("--python", default=sys.executable)
    one.add_argument("--tree", default=ROOT)
    one.add_argument("--cache", help="folder that keeps compiled kernels [default: an empty one]")
    one.add_argument("--jobs", type=int, default=2, help="commands at a time [default: 2]")
    one.set_defaults(task=record)
    two = tasks.add_parser("compare")
    two.add_argument("files", type=Path, nargs=2, metavar=("BEFORE", "AFTER"))
    two.set_defaults(task=compare)
    options = parser.parse_args()
    return options.task(options)


if __name__ == "__main__":
    sys.exit(main())
