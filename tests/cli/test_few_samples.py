"""As few samples as one can ask for: no bug, no boast, and nothing said that is not known."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

Command = Callable[..., Outcome]
LINES = {
    "run --model lambert --check energy,cover --effort 0.03": 3,
    "run --model black.py --effort 0.03": 3,
    "furnace --model ggx --theta-o 60 --sampler cosine": 3,
    "identities": 3,
    "radiance --model lambert --environment cosine:2 --theta-o 0": 0,
}
BLACK = "def f(wo, wi, p):\n    return 0.0\n"
UNDECIDED = re.compile(r"undecided at (\d+) samples: needs about (\S+?)[,;]")


@pytest.mark.parametrize("samples", [1, 17])
@pytest.mark.parametrize("line", LINES)
def test_few_samples_leave_open_what_they_cannot_tell(
    line: str, samples: int, cli: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("black.py").write_text(BLACK, encoding="utf-8")
    outcome = cli(*line.split(), "--samples", samples)
    assert outcome.code in (0, LINES[line]), outcome.err
    assert not re.search(r"\b(nan|inf)\b", outcome.out), outcome.out
    told = UNDECIDED.findall(outcome.out)
    assert all(float(needed) > float(had) for had, needed in told), told
    had = re.search(r"up to (\d+) samples a claim", outcome.out)
    assert had is None or int(had[1]) <= samples


def test_one_sample_has_no_error_that_is_known(cli: Command, tmp_path: Path) -> None:
    line = ("render", "--model", "ggx_anisotropic", "--environment", "cosine:3", "--size", 8)
    outcome = cli(*line, "--samples", 1, "-o", tmp_path / "sphere.png")
    assert outcome.code == 0 and "of which no error is known" in outcome.out
    assert "up to" not in outcome.out
