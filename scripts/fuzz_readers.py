"""Coverage-guided fuzzing of everything that reads a file or a text, with Google's atheris.

    python scripts/fuzz_readers.py [--minutes 30] [--record FILE] [--corpus FOLDER]

Needs `pip install atheris`. The first byte of an input chooses the reader, the rest is its file;
inputs that reach new lines are kept and changed further. Anything but a result or a UserError is
recorded with the input, and the run goes on. Model files are code, so only their names and
parameters are fuzzed here; scripts/fuzz.py writes and runs such files.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import atheris

with atheris.instrument_imports(include=["montecarlo_brdf", "tomllib"]):
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli import _options, _requests
    from montecarlo_brdf.errors import UserError
    from montecarlo_brdf.estimate.partial_sums import PartialSums
    from montecarlo_brdf.files import write_text
    from montecarlo_brdf.report import baseline
    from montecarlo_brdf.report.json import read_report
    from montecarlo_brdf.scene import images, texels
    from montecarlo_brdf.scene import read as read_scenes

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(Path(__file__).parent))
LONGEST = 10  # seconds


def text(content: bytes) -> str:
    return content.decode("utf-8", "replace")


def _scene(path: Path) -> None:
    read_scenes.read_scene(path)


def _settings(path: Path) -> None:
    _requests.read(path)


def _report(path: Path) -> None:
    found = read_report(path)
    with contextlib.suppress(KeyError):  # compared with itself: `command` may lack
        baseline.changes(found, found)


def _image(suffix: str) -> Callable[[Path], None]:
    def reader(path: Path) -> None:
        texels.texel_sky(images.read_image(path.rename(path.with_suffix(suffix))))

    return reader


def _sums(path: Path) -> None:
    PartialSums(lambda content: None, text(path.read_bytes()))


def _model_name(path: Path) -> None:
    name = text(path.read_bytes())
    if ".py" not in name:
        loading.load(name)


def _parameters(path: Path) -> None:
    model = loading.load("ggx")
    _options.parameter_sets(model, text(path.read_bytes()).split("\n"))


def _sky(path: Path) -> None:
    model = loading.load("lambert")
    sky = text(path.read_bytes())
    if not sky.startswith("image"):
        read_scenes.scene_of(model, model.parameters(), sky)


#: reader -> how it is called, and inputs to start from
READERS: dict[str, tuple[Callable[[Path], None], list[bytes]]] = {
    "scene": (_scene, [p.read_bytes() for p in sorted((ROOT / "examples").glob("*.toml"))]),
    "settings": (_settings, []),
    "report": (_report, [(ROOT / "scripts/results/bench.json").read_bytes()[:2000]]),
    "hdr": (_image(".hdr"), [b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x80",
                             b"#?RGBE\n\n-Y 1 +X 8\n\x02\x02\x00\x08" + b"\x88\x01" * 4]),
    "npy": (_image(".npy"), []),
    "png": (_image(".png"), []),
    "partial sums": (_sums, []),
    "model name": (_model_name, [b"ggx", b"0.6 lambert + 0.4 ggx", b"0.5 phong + 0.5 0.5 ggx"]),
    "parameters": (_parameters, [b"alpha=0.1,0.5\nf0=1/0.5/0.1", b"alpha=0.1:1:log5"]),
    "sky": (_sky, [b"cosine:8", b"cap:10:60", b"linear:1:0.5:20", b"gradient", b"constant:2"]),
}  # fmt: skip
NAMES = list(READERS)


def seeds() -> None:
    """Add what must be made first."""
    import numpy as np
    from PIL import Image

    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    import fuzzed_files

    READERS["settings"][1].extend(s.encode() for s in fuzzed_files.SETTINGS)
    array, picture, saved = io.BytesIO(), io.BytesIO(), list[str]()
    np.save(array, np.ones((2, 3, 3)))
    Image.new("RGB", (3, 2), (200, 100, 50)).save(picture, "png")
    PartialSums(saved.append).write()
    READERS["npy"][1].append(array.getvalue())
    READERS["png"][1].append(picture.getvalue())
    READERS["partial sums"][1].append(saved[0].encode())
    finding = {"quantity": "A", "where": {"theta_o_deg": 30.0}, "verdict": "pass"}
    result = {"model": "x", "params": {"a": 1}, "check": "furnace", "findings": [finding]}
    report = {"schema": 1, "command": "furnace", "verdict": "pass", "results": [result]}
    READERS["report"][1].append(json.dumps(report).encode())


class Fuzz:
    """What was tried, and what came of it."""

    def __init__(self, record: Path | None, folder: Path, commit: str) -> None:
        self.record, self.folder = record, folder
        self.state: dict[str, Any] = {"commit": commit, "seconds": 0.0, "cases": {}, "failures": {}}
        self.began = self.written = time.monotonic()

    def one(self, data: bytes) -> None:
        """One input, by the reader that its first byte chooses."""
        if not data:
            return
        name = NAMES[data[0] % len(NAMES)]
        cases = self.state["cases"].setdefault(name, [0, 0])  # all, and those read to the end
        cases[0] += 1
        path = self.folder / "input.toml"
        path.write_bytes(data[1:])
        signal.alarm(LONGEST)
        try:
            READERS[name][0](path)
            cases[1] += 1
        except UserError:
            pass
        except Exception:  # a crash, or the alarm
            self._failed(name, data[1:])
        finally:
            signal.alarm(0)
        if time.monotonic() - self.written > 10.0:
            self.write()

    def _failed(self, name: str, data: bytes) -> None:
        """Record each place of failure once."""
        trace = traceback.format_exc()
        place = f"{name}: " + " ".join(trace.strip().splitlines()[-3:])[-300:]
        if place not in self.state["failures"]:
            self.state["failures"][place] = {"input": repr(data[:4000]), "trace": trace[-3000:]}
            print(place, flush=True)

    def write(self) -> None:
        self.written = time.monotonic()
        self.state["seconds"] = round(self.written - self.began, 1)
        if self.record:
            write_text(self.record, json.dumps(self.state, indent=1) + "\n")


def main() -> None:
    from fuzz import commit

    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--record", type=Path)
    options = parser.parse_args()
    seeds()

    def late(*_: Any) -> None:
        raise TimeoutError(f"longer than {LONGEST} s")

    signal.signal(signal.SIGALRM, late)
    with tempfile.TemporaryDirectory() as name:
        corpus, folder = Path(name) / "corpus", Path(name) / "case"
        corpus.mkdir()
        folder.mkdir()
        for k, (_, inputs) in enumerate(READERS.values()):
            for i, data in enumerate(inputs):
                (corpus / f"{k}_{i}").write_bytes(bytes([k]) + data)
        fuzz = Fuzz(options.record, folder, commit())
        limits = [f"-max_total_time={int(60 * options.minutes)}", "-max_len=4096"]
        atheris.Setup([sys.argv[0], str(corpus), *limits, "-rss_limit_mb=8192"], fuzz.one)
        try:
            atheris.Fuzz()  # ends the process
        finally:
            fuzz.write()


if __name__ == "__main__":
    main()
