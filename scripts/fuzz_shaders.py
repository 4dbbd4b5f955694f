"""Shaders with bytes and words changed: each loads, or is refused in one sentence.

Run: python scripts/fuzz_shaders.py [MINUTES], with the package's extra `shaders` installed.
"""
from __future__ import annotations

import os
import random
import re
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import montecarlo_brdf as mb

SHADERS = Path(__file__).parents[1] / "tests" / "foreign" / "shaders"
WORDS = re.compile(r"\w+|[^\w\s]")
STRANGE = ("while (true) {}", "1.0e999", "0x7fffffff", "inout", "/*", "#if", "#include <x>", "\\",
           "[-1]", "mat3(1.0)", "discard;", "vec3", "0.0 / 0.0", "%", "return;", "é")  # fmt: skip
LONGEST = 240.0  # seconds that nothing may take


def changed(text: str, drawn: random.Random) -> bytes:
    """A text with a few bytes or words changed."""
    for _ in range(drawn.randint(1, 4)):
        words = list(WORDS.finditer(text))
        if not words or drawn.random() < 0.25:
            at = drawn.randrange(len(text) + 1)
            text = text[:at] + chr(drawn.randrange(1, 256)) + text[at + drawn.randint(0, 3) :]
            continue
        one, other = drawn.choice(words), drawn.choice(words)
        new = drawn.choice([other[0], "", one[0] * 2, drawn.choice(STRANGE)])
        text = text[: one.start()] + new + text[one.end() :]
    return text.encode("latin-1", errors="replace")


def fault(path: Path) -> tuple[str, str]:
    """What became of a shader, and what is wrong with that."""
    started = time.monotonic()
    try:
        model = mb.load(str(path))
        probe(model)
        outcome, wrong = "loads", ""
    except mb.UserError as error:
        outcome, wrong = "is refused", unclear(str(error))
    except Exception as error:
        outcome, wrong = "breaks", f"{type(error).__name__}: {error}"
    if time.monotonic() - started > LONGEST:
        wrong = "takes too long"
    return outcome, wrong


def probe(model: mb.Model) -> None:
    """Plain calls, as a run begins."""
    from montecarlo_brdf.estimate import probe

    probe.check(model, model.parameters())


def unclear(sentence: str) -> str:
    """What is wrong with a sentence."""
    lines = "\n" in sentence or not sentence.strip()
    return sentence if lines or "translation failed" in sentence else ""


def main() -> int:
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    drawn, found = random.Random(os.getpid()), Counter[str]()
    until = time.monotonic() + 60.0 * minutes
    texts = {p: p.read_text(encoding="utf-8") for p in sorted(SHADERS.iterdir())}
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < until:
            source = drawn.choice(sorted(texts))
            path = Path(folder) / f"changed{source.suffix}"
            path.write_bytes(changed(texts[source], drawn))
            outcome, wrong = fault(path)
            found[outcome] += 1
            if wrong:
                found["faults"] += 1
                kept = Path(tempfile.gettempdir()) / f"fault_{sum(found.values())}{source.suffix}"
                kept.write_bytes(path.read_bytes())
                print(f"{kept}: {wrong}", flush=True)
    print(f"{minutes:g} minutes:", ", ".join(f"{n} {what}" for what, n in found.most_common()))
    return 1 if found["faults"] else 0


if __name__ == "__main__":
    sys.exit(main())
