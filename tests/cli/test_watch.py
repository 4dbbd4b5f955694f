"""--watch on a pseudo-terminal: edits of all kinds, mistakes, and the end by Ctrl-C; with a library
that tells of changes and without one."""
from __future__ import annotations

import importlib.util
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Outcome
from terminals import BEGIN, Session

MODEL = "from other import K\n\n\ndef f(wo, wi, p):\n    return K / 3.141592653589793\n"
#: asks one value: nothing has to be sampled
QUESTION = ["run", "--model", "my.py", "--check", "positivity", "--effort", "0.01", "--watch"]
#: as if the library was not installed
WITHOUT = "import sys; sys.modules['watchfiles'] = None; "
INSTALLED = importlib.util.find_spec("watchfiles") is not None


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "my.py").write_text(MODEL)
    (tmp_path / "other.py").write_text("K = 0.1\n")
    return tmp_path


@pytest.fixture(params=["library", "polling"])
def begun(request: pytest.FixtureRequest, folder: Path) -> Iterator[Session]:
    if request.param == "library" and not INSTALLED:
        pytest.skip("watchfiles is not installed")
    code = BEGIN if request.param == "library" else WITHOUT + BEGIN
    session = Session(folder, code, *QUESTION)
    yield session
    session.close()


def saved(path: Path, text: str) -> None:
    """As editors save: another file takes the name."""
    beside = path.with_name(f".{path.name}.swap")
    beside.write_text(text)
    beside.replace(path)


def test_a_day_of_edits(begun: Session, folder: Path) -> None:
    model, other = folder / "my.py", folder / "other.py"
    assert "changed" not in begun.until("PASS", "watching my.py, other.py\n")

    other.write_text("K = -.1\n")  # as long as before
    said = begun.until("\nother.py changed\n", "FAIL", "watching")
    assert said.index("new failure: my.py positivity") < said.index("worst ")  # before the table

    other.write_text("K = -.2\n")
    assert "nothing changed: fail" in begun.until("other.py changed", "FAIL", "watching")

    model.write_text(MODEL.replace("return", "return ("))
    said = begun.until("my.py changed", "watching my.py, other.py\n")
    assert "Error: my.py, line 5: '(' was never closed\n" in said and "Traceback" not in said

    saved(model, MODEL)
    assert "nothing changed: fail" in begun.until("my.py changed", "FAIL", "watching")

    model.unlink()
    assert "Error: no model file my.py\n" in begun.until("my.py changed", "watching")
    model.write_text(MODEL.replace("other", "another"))
    assert "No module named 'another'" in begun.until("my.py changed", "watching")
    (folder / "another.py").write_text("K = 0.3\n")  # which nobody could know
    assert "fixed: my.py positivity" in begun.until("changed", "PASS", "watching another.py, my.py")

    assert begun.interrupt() == 0


def test_ctrl_c_ends_with_the_last_code(folder: Path) -> None:
    (folder / "other.py").write_text("K = -1\n")
    session = Session(folder, WITHOUT + BEGIN, *QUESTION)
    session.until("FAIL", "watching")
    os.utime(folder / "other.py")  # touched: nothing to say
    time.sleep(0.6)
    assert session.interrupt() == 1
    session.close()


def test_what_no_edit_mends_ends_at_once(
    cli: Callable[..., Outcome], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    for arguments, sentence in (
        (["--model", "my.py", "-p", "k=1"], "no parameter"),
        (["--model", "nothing.py"], "no model file nothing.py"),
        (["--model", "lambert", "--theta-o", "0"], "--watch needs a file of your own"),
        (["--model", "my.py", "--resume", "sums.json"], "not both"),
    ):
        outcome = cli("furnace", *arguments, "--watch")
        assert outcome.code == 2 and sentence in outcome.err, outcome
