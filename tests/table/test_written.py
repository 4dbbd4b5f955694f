"""A file of a table says the same as the table, to whoever reads it."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.table.axes import Axis, Placement
from montecarlo_brdf.table.written import csv, exr, header, npz
from montecarlo_brdf.table.written.finished import Finished, Number, bound, rounded

AXES = (Axis("mu", 0.0, 1.0, 5), Axis("alpha", 0.25, 1.0, 4, Placement.EDGES))
VALUES = np.random.default_rng(3).random((2, 5, 4))
TABLE = Finished(
    "ggx(f0=1)", AXES, {"scale": VALUES[0], "bias": VALUES[1]},
    {"scale": np.full((5, 4), 1e-6), "bias": np.full((5, 4), 2e-6)},
    {"command": "brdf-check table */", "confidence": 0.99},
)  # fmt: skip
CC = shutil.which("cc")
SHOW = """
#include <stdio.h>
#include <string.h>
#include <stdint.h>
#include "lut.h"
int main(void)
{{
    for (int j = 0; j < LUT_ALPHA_SIZE; ++j)
        for (int i = 0; i < LUT_MU_SIZE; ++i) {{
            {word} w;
            memcpy(&w, &lut_scale[j][i], sizeof w);
            printf("%u\\n", (unsigned)w);
        }}
    return lut_bias_error < 2e-6f;
}}
"""


@pytest.mark.parametrize("write", [npz.write, csv.write])
def test_numpy_and_csv_come_back_exactly(write, tmp_path: Path) -> None:
    path = tmp_path / "table"
    path.write_bytes(write(TABLE))
    assert write(TABLE) == path.read_bytes()  # equal tables are equal bytes
    found = (npz if write is npz.write else csv).read(path)
    assert found is not None and found.axes == AXES
    assert all(np.array_equal(found.values[n], TABLE.values[n]) for n in TABLE.values)


@pytest.mark.skipif(CC is None, reason="no C compiler")
@pytest.mark.parametrize(
    ("number", "word", "kept"),
    [(Number.FLOAT, "uint32_t", np.uint32), (Number.HALF, "uint16_t", np.uint16)],
)
def test_a_header_compiles_and_gives_the_same_bits(number, word, kept, tmp_path: Path) -> None:
    (tmp_path / "lut.h").write_bytes(header.write(TABLE, "lut", number))
    (tmp_path / "show.c").write_text(SHOW.format(word=word))
    flags = ["-std=c11", "-Wall", "-Wextra", "-Wno-unused", "-Werror", "-o", "show", "show.c"]
    subprocess.run(["cc", *flags], cwd=tmp_path, check=True)
    done = subprocess.run(["./show"], cwd=tmp_path, capture_output=True, text=True)
    bits = rounded(VALUES[0].T, number).view(kept).ravel()
    assert done.returncode == 0 and [int(x) for x in done.stdout.split()] == bits.tolist()


@pytest.mark.skipif(CC is None, reason="no C compiler")
def test_a_header_that_lost_a_value_does_not_compile(tmp_path: Path) -> None:
    text = header.write(TABLE, "lut", Number.FLOAT).decode()
    first = header.literal(np.float32(VALUES[0, 0, 0]))
    row = text.index("{\n{")
    end = text.index("},", row)
    for broken in (text[:row] + "{" + text[end + 2 :], text.replace("== 24", "== 53")):
        (tmp_path / "lut.h").write_text(broken)
        (tmp_path / "show.c").write_text('#include "lut.h"\nint main(void) { return 0; }\n')
        done = subprocess.run(["cc", "-std=c11", "-fsyntax-only", "show.c"], cwd=tmp_path,
                              capture_output=True, text=True)  # fmt: skip
        assert done.returncode and "assert" in done.stderr
    assert first in text


def test_the_numbers_of_a_header_are_read(tmp_path: Path) -> None:
    text = header.write(TABLE, "lut", Number.FLOAT).decode()
    found = header.numbers(text).astype(np.float32)
    assert np.array_equal(found, VALUES[0].T.ravel().astype(np.float32))


def test_what_a_file_promises_includes_rounding() -> None:
    kept = rounded(VALUES[0], Number.HALF).astype(float)
    assert bound(TABLE, "scale", Number.HALF) >= np.abs(kept - VALUES[0]).max()
    assert bound(TABLE, "scale", Number.FLOAT) > 1e-6


def test_an_exr_has_a_channel_per_quantity(tmp_path: Path) -> None:
    openexr = pytest.importorskip("OpenEXR")
    path = tmp_path / "lut.exr"
    path.write_bytes(exr.write(TABLE, Number.FLOAT))
    with openexr.File(str(path), separate_channels=True) as file:
        found = {n: c.pixels for n, c in file.channels().items()}
    assert np.array_equal(found["R"], VALUES[0].T.astype(np.float32))
    assert np.array_equal(found["G"], VALUES[1].T.astype(np.float32))


def test_what_no_file_can_hold_is_told() -> None:
    bad = TABLE._replace(values={"scale": np.full((5, 4), np.nan)})
    with pytest.raises(UserError, match="not finite"):
        header.write(bad, "lut", Number.FLOAT)
    with pytest.raises(UserError, match="two axes, not three"):
        exr.check(3, 1)
    with pytest.raises(UserError, match="4 channels, not 5"):
        exr.check(2, 5)
