"""The cache is limited by bytes, the least recently used goes first, and folders that are only read
lie below the one that is written."""
from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

from montecarlo_brdf.compile import cache, folders
from montecarlo_brdf.errors import UserError

Command = Callable[..., Outcome]
SIZE = 1000


def filled(name: str, used: float | None = None) -> Path:
    """An entry of SIZE bytes, as if it was used at some time."""
    cache.write(name, bytes(SIZE - cache.DIGEST))
    path = folders.directory() / f"{name}.o"
    if used is not None and path.exists():
        os.utime(path, (used, used))
    return path


def names(folder: Path) -> set[str]:
    return {path.stem for path in folder.glob("*.o")}


def test_the_least_recently_used_goes_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(folders.FOLDERS, str(tmp_path))
    monkeypatch.setenv(folders.SIZE, str(3 * SIZE + 500))
    (tmp_path / "of somebody else.pdf").write_bytes(bytes(9 * SIZE))
    for age, name in enumerate("abc"):
        filled(name, 1000 + age)
    assert cache.read("b") is not None  # a use makes it young
    filled("d")
    assert names(tmp_path) == {"b", "c", "d"} and cache.read("a") is None
    assert (tmp_path / "of somebody else.pdf").exists()


def test_a_cache_never_holds_more_than_its_limit_and_is_seldom_looked_at(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(folders.FOLDERS, str(tmp_path))
    monkeypatch.setenv(folders.SIZE, str(200 * SIZE))
    looks, look = [], folders.stored
    monkeypatch.setattr(folders, "stored", lambda folder: looks.append(0) or look(folder))
    for k in range(400):
        filled(f"{k:04}", 1000 + k)
        assert k < 195 or sum(p.stat().st_size for p in tmp_path.iterdir()) <= 200 * SIZE
    kept = names(tmp_path)
    assert len(kept) >= 174 and kept == {f"{k:04}" for k in range(400 - len(kept), 400)}
    assert len(looks) <= 400 / 4


def test_what_is_larger_than_the_limit_is_not_kept_and_drives_nothing_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(folders.FOLDERS, str(tmp_path))
    monkeypatch.setenv(folders.SIZE, "4K")
    filled("small")
    cache.write("large", bytes(1 << 13))
    assert names(tmp_path) == {"small"}
    monkeypatch.setenv(folders.SIZE, "0")
    filled("nothing")
    assert names(tmp_path) == {"small"}


@pytest.mark.parametrize(
    ("said", "size"), [("", 512 << 20), ("4096", 4096), ("1.5K", 1536), ("2 GiB", 2 << 30),
                       ("200mb", 200 << 20)]
)  # fmt: skip
def test_sizes(said: str, size: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(folders.SIZE, said)
    assert folders.limit() == size


@pytest.mark.parametrize("said", ["a lot", "-1", "5T", "nan"])
def test_what_is_no_size_is_one_sentence(
    said: str, cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(folders.SIZE, said)
    with pytest.raises(UserError, match=f"{folders.SIZE} must be a number of bytes"):
        folders.limit()
    outcome = cli("furnace", "--model", "lambert", "--theta-o", 0)
    assert outcome.code == 2 and repr(said) in outcome.err and outcome.err.count("\n") == 1


def layered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """A folder of one's own above one of all."""
    own, shared = tmp_path / "own", tmp_path / "shared"
    monkeypatch.setenv(folders.FOLDERS, str(shared))
    cache.write("known", b"to all")
    cache.note("true", "of all")
    monkeypatch.setenv(folders.FOLDERS, f"{own}{os.pathsep}{shared}")
    return own, shared


def test_a_folder_of_all_lies_below_ones_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, shared = layered(tmp_path, monkeypatch)
    before = {p.name: p.read_bytes() for p in shared.iterdir()}
    cache.write("mine", b"alone")
    cache.note("true", "of me")
    assert cache.read("known") == b"to all" and cache.read("mine") == b"alone"
    assert cache.notes("true") == ["of me", "of all"]
    assert {p.name: p.read_bytes() for p in shared.iterdir()} == before
    assert names(own) == {"mine"}


def test_a_damaged_entry_does_not_hide_a_whole_one_below(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, _ = layered(tmp_path, monkeypatch)
    own.mkdir(exist_ok=True)
    (own / "known.o").write_bytes(b"half")
    assert cache.read("known") == b"to all"


def test_the_first_folder_that_can_be_written_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    places = [tmp_path / "file" / "below", tmp_path / "other"]
    monkeypatch.setenv(folders.FOLDERS, os.pathsep.join(map(str, places)))
    cache.write("kernel", b"image")
    assert names(places[1]) == {"kernel"} and folders.fault() is None


def test_doctor_tells_size_and_uses(
    cli: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, shared = layered(tmp_path, monkeypatch)
    cache.write("mine", bytes(3 << 20))
    for name in ("mine", "known", "nobody's"):
        cache.read(name)
    told = [line for line in cli("doctor").out.splitlines() if line.startswith("cache")]
    assert [" ".join(line.split()) for line in told] == [
        f"cache {own} (writable), 3.0 MB of 512.0 MB in 2 files",
        f"cache 2 {shared} (only read), 0.0 MB in 2 files",
        "cache uses 2 found, 1 not, of the last 3",
    ]


def test_uses_are_counted_anew_before_they_fill_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(folders.FOLDERS, str(tmp_path))
    monkeypatch.setattr(folders, "MOST_USES", 10)
    assert folders.uses() == (0, 0)
    for k in range(13):
        folders.count_use(k % 2 == 0)
    assert folders.uses() == (3, 2)
