"""Files that include one another become one text, as their macros have it."""
from __future__ import annotations

from pathlib import Path

import pytest

from montecarlo_brdf.foreign.complaint import Complaint
from montecarlo_brdf.foreign.conditions import Conditions
from montecarlo_brdf.foreign.includes import Includes


def resolved(folder: Path, **macros: str) -> str:
    """The lines of main.glsl that are no directives."""
    includes = Includes([folder / "lib"], str)
    includes.defined(macros)
    path = folder / "main.glsl"
    lines = includes.resolved(includes.text(path), path).splitlines()
    return " ".join(x.strip() for x in lines if x.strip() and not x.strip().startswith("#"))


def test_a_chunk_has_no_suffix(tmp_path: Path) -> None:
    (tmp_path / "common.glsl.js").write_text("export default `\nfloat a;\n`;\n")
    (tmp_path / "main.glsl").write_text("#include <common>\nfloat b;\n")
    assert resolved(tmp_path) == "float a; float b;"


def written(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        path = folder / name.replace("__", "/")
        path = path.with_suffix(".glsl")
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def test_a_file_with_a_guard_is_taken_once(tmp_path: Path) -> None:
    main = '#include "a.glsl"\n#include "b.glsl"\n#include "a.glsl"\nmain\n'
    a, b = '#ifndef A\n#define A\n#include "b.glsl"\na\n#endif\n', "#pragma once\nb\n"
    assert resolved(written(tmp_path, main=main, a=a, b=b)) == "b a main"


def test_a_file_without_one_is_taken_as_often_as_it_is_named(tmp_path: Path) -> None:
    main = '#define X 1\n#include "a.glsl"\n#undef X\n#define X 2\n#include "a.glsl"\n'
    assert resolved(written(tmp_path, main=main, a="X\n")) == "X X"


def test_a_branch_that_is_not_taken_includes_nothing(tmp_path: Path) -> None:
    main = "#if ENGINE > 1\n#include <a.glsl>\n#else\n#include <lost.glsl>\n#endif\n"
    files = written(tmp_path, main=main, lib__a='#include "c.glsl"\n', lib__c="c\n")
    assert resolved(files, ENGINE="2") == "c"


def test_files_with_guards_may_include_one_another(tmp_path: Path) -> None:
    a = '#ifndef A\n#define A\n#include "b.glsl"\na\n#endif\n'
    b = '#ifndef B\n#define B\n#include "a.glsl"\nb\n#endif\n'
    assert resolved(written(tmp_path, main='#include "a.glsl"\n', a=a, b=b)) == "b a"


def test_a_file_that_includes_itself_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Complaint, match="includes itself"):
        resolved(written(tmp_path, main='#include "main.glsl"\n'))


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("1", True), ("0", False), ("defined(A)", True), ("!defined A", False), ("LOST", False),
        ("A == 3 && B >= 2u", True), ("(A + 1) * 2 != 8 || !B", False), ("F(1)", True),
        ("C == 3", True), ("A / 2 == 1", True), ("defined(A) && !defined(LOST)", True),
    ],
)  # fmt: skip
def test_conditions(condition: str, holds: bool) -> None:
    found = Conditions({"A": "3", "B": "2", "C": "A"})
    assert found.heed(f"#if {condition} // or not\n")
    assert found.live is holds
    found.heed("#else\n")
    assert found.live is not holds
    found.heed("#endif\n")
    assert found.live
