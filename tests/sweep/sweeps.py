"""What the tests of sweeps ask, and what of it must never change."""
from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

MODEL = """
import time
from typing import NamedTuple

from common import over_pi


class Params(NamedTuple):
    a: float = 0.5


domain = {"a": (0.0, 1.0)}


def prepare(p):
    time.sleep(PAUSE)
    return p


def f(wo, wi, p):
    return over_pi(p.a)
"""
#: two models that import each a module of the same name, and a task for each of four values
FILES = {
    "brdfs/one.py": MODEL,
    "brdfs/common.py": "def over_pi(x):\n    return x / 3.141592653589793\n",
    "brdfs/sub/two.py": MODEL,
    "brdfs/sub/common.py": "def over_pi(x):\n    return 0.3 * x\n",
}
TASKS = 8
QUESTION = [
    *("furnace", "--model", "brdfs", "-p", "a=0.1,0.2,0.5,1", "--theta-o", "0,60"),
    *("--samples", "2^10", "--sampler", "cosine", "--format", "json"),
]


def lay(folder: Path, pause: float = 0.0) -> None:
    """The models of QUESTION. pause: seconds that each preparation of parameters takes."""
    for name, text in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text.replace("PAUSE", str(pause)))


def results(out: str) -> str:
    """The results of a report, byte for byte."""
    return out[out.index('"results"') : out.index('"measured"')]


def answers(path: Path) -> Sequence[str]:
    """The keys of all answers that a file holds, whole lines alone."""
    lines = path.read_text().split("\n")[:-1] if path.exists() else []
    return [row["task"] for line in lines if "task" in (row := json.loads(line))]
