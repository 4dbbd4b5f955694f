"""Columns of text: words wrap, numbers stay whole, what does not fit moves below."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from montecarlo_brdf.report.columns import NO_BREAK, Column, Style, table

COLUMNS = (
    Column("check"),
    Column("what is asked", fold=1, words=True),
    Column("estimate"),
    Column("allowed", fold=2, right=True),
    Column("verdict", style=lambda cell: Style.GREEN if cell == "pass" else Style.LOUD),
)
ROWS = [
    ("furnace", "A of a lossless surface", "0.80003(12)", "<= 1", "pass"),
    ("pdf", "int pdf", "1.0000000000000000(10)", "<= 1", "FAIL"),
]


def test_a_wide_terminal() -> None:
    assert table(COLUMNS, ROWS, 100) == [
        "check    what is asked            estimate                allowed  verdict",
        "furnace  A of a lossless surface  0.80003(12)                <= 1  pass",
        "pdf      int pdf                  1.0000000000000000(10)     <= 1  FAIL",
    ]


def test_words_wrap_first_then_columns_move_below() -> None:
    assert table(COLUMNS, ROWS, 66) == [
        "check    what is asked    estimate                allowed  verdict",
        "furnace  A of a lossless  0.80003(12)                <= 1  pass",
        "         surface",
        "pdf      int pdf          1.0000000000000000(10)     <= 1  FAIL",
    ]
    assert table(COLUMNS, ROWS, 42) == [
        "check    estimate                verdict",
        "furnace  0.80003(12)             pass",
        "    what is asked A of a lossless surface",
        "    allowed <= 1",
        "pdf      1.0000000000000000(10)  FAIL",
        "    what is asked int pdf  allowed <= 1",
    ]


def test_a_column_without_content_is_left_out() -> None:
    rows = [(a, "", b, "", c) for a, _, b, _, c in ROWS]
    assert table(COLUMNS, rows, 100)[0] == "check    estimate                verdict"


def test_colour_changes_no_width() -> None:
    plain, bright = table(COLUMNS, ROWS, 60), table(COLUMNS, ROWS, 60, colour=True)
    assert any("\x1b[32mpass\x1b[0m" in line for line in bright)
    stripped = [line.replace("\x1b[32m", "").replace("\x1b[1;31m", "") for line in bright]
    assert [line.replace("\x1b[0m", "") for line in stripped] == plain


def test_no_rows() -> None:
    assert table(COLUMNS, [], 80) == ["check  what is asked  estimate  allowed  verdict"]


WORD = st.text("abc()|<=0123456789.°", min_size=1, max_size=24)


@given(
    st.lists(st.tuples(WORD, st.lists(WORD, max_size=9).map(" ".join), WORD, WORD, WORD),
             min_size=1, max_size=4),
    st.integers(1, 160),
)  # fmt: skip
def test_numbers_are_never_torn(rows: list[tuple[str, ...]], width: int) -> None:
    lines = table(COLUMNS, rows, width)
    kept = [max(map(len, [COLUMNS[k].name, *(row[k] for row in rows)])) for k in (0, 2, 4)]
    for row in rows:
        assert all(any(cell in line.split() for line in lines) for cell in (row[2], row[3], row[4]))
        for word in row[1].split():
            assert word in "".join(lines).replace(" ", "") or len(word) > 20 or len(lines) > 3
    if width >= max(sum(kept) + 2, 40):
        assert max(map(len, lines)) <= width
    assert not any(NO_BREAK in line for line in lines)
