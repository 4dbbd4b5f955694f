"""Tables of TOML files: where a key stands, and whose mistake it is."""

from pathlib import Path

import pytest

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.toml import FileError, Keys, Table, line_of, parse

TEXT = """name = "x"
[a]
b = 1
"a.c" = 2
[[rows]]
n = 1
[[rows]]
n = 2
[rows.inner]
deep.er = 3
"""


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("name",), 1),
        (("a",), 2),
        (("a", "b"), 3),
        (("rows", 0), 5),
        (("rows", 0, "n"), 6),
        (("rows", 1, "n"), 8),
        (("rows", 1, "inner"), 9),
        (("rows", 1, "inner", "deep", "er"), 10),
        (("a", "nosuch"), 2),
        (("nosuch",), None),
    ],
)
def test_line(path: Keys, line: int | None) -> None:
    assert line_of(TEXT, path) == line


def _table(folder: Path) -> Table:
    file = folder / "x.toml"
    file.write_text(TEXT)
    data, text = parse(file)
    return Table(file, text, data)


def test_mistakes_are_of_the_key_that_they_are_about(tmp_path: Path) -> None:
    table = _table(tmp_path).table("a")
    with pytest.raises(FileError, match="line 2: wrong"), table.at("nosuch"):
        raise UserError("wrong")
    with pytest.raises(FileError, match="line 3: wrong"), table.at("nosuch"):
        raise UserError("wrong", about="b")
    with pytest.raises(FileError, match="^elsewhere$"), table.at("b"):
        raise FileError("elsewhere")  # has its place


def test_keys_that_nobody_takes(tmp_path: Path) -> None:
    top = _table(tmp_path)
    first, second = top.tables("rows")
    assert (first.number("n"), second.number("n"), second.title()) == (1.0, 2.0, "[[rows]] 2")
    first.done()
    with pytest.raises(UserError, match=r"line 9: no key of \[\[rows\]\] 2 'inner'"):
        second.done()


def test_a_misspelt_key_is_told_in_place_of_a_missing_one(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text('name = "x"\n[surfce]\nmodel = "lambert"\n', encoding="utf-8")
    table = Table(path, path.read_text(), parse(path)[0])
    table.know("name")
    with pytest.raises(UserError, match="line 2: no key of the scene 'surfce'; did you mean"):
        table.table("surface")
