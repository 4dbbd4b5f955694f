"""The site of the manual: builds without a warning, every page is reached, every link leads on."""

from __future__ import annotations

import importlib
import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any
from urllib.parse import unquote, urldefrag

import click
import pytest

from montecarlo_brdf import loading
from montecarlo_brdf.cli import commands

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
NAMES = {path.stem for path in DOCS.glob("*.md")}
NEEDED = ("sphinx", "furo", "myst_parser")
ABSENT = [name for name in NEEDED if importlib.util.find_spec(name) is None]


@pytest.fixture
def scripts(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return importlib.import_module


def in_toctrees() -> list[str]:
    index = (DOCS / "index.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```\{toctree\}\n(.*?)```", index, re.DOTALL)
    lines = [line.strip() for block in blocks for line in block.splitlines()]
    named = [line for line in lines if line and not line.startswith(":")]
    return [line.partition("<")[2].rstrip(">") or line for line in named]


def test_every_page_is_in_one_toctree() -> None:
    assert sorted(in_toctrees()) == sorted(NAMES - {"index"})


def test_what_pages_ask_for_is_made(scripts: Any) -> None:
    manual = scripts("manual")
    pages = "".join(path.read_text(encoding="utf-8") for path in DOCS.glob("*.md"))
    assert sorted(manual.MARK.findall(pages)) == sorted(manual.PARTS)
    with pytest.raises(KeyError):
        manual.filled("<!-- made: nothing -->")


def test_the_reference_has_every_option(scripts: Any) -> None:
    made = scripts("manual.commands").made()
    context = click.Context(commands)
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command and f"## {name}\n" in made
        for option in command.params:
            assert not isinstance(option, click.Option) or option.opts[-1] in made, option


def test_the_page_of_pictures_is_the_script_s(scripts: Any) -> None:
    """If this fails: python scripts/pictures.py"""
    pictures: ModuleType = scripts("pictures")
    assert (DOCS / "pictures.md").read_text(encoding="utf-8") == pictures.page()
    used = {f"figures/shown_{name}.png" for name in pictures.SHOWN}
    assert all((DOCS / path).is_file() for path in used)


def test_the_picture_of_the_house_has_every_floor(scripts: Any) -> None:
    """If this fails: a row of LAYERS, then python scripts/make_figures.py docs/figures house"""
    figures = scripts("make_figures")
    drawn = {name for row in (*figures.LAYERS, *figures.ASIDE) for name in row[0].split(", ")}
    package = ROOT / "montecarlo_brdf"
    assert {path.parent.name for path in package.glob("*/__init__.py")} - drawn == set()


def broken(folder: Path) -> list[str]:
    """Links within a site that lead nowhere."""
    pages = {p: p.read_text(encoding="utf-8") for p in folder.rglob("*.html")}
    names = {p: set(re.findall(r'\bid="([^"]+)"', text)) for p, text in pages.items()}
    found = []
    for page, text in pages.items():
        for link in re.findall(r'\b(?:href|src)="([^"]+)"', text):
            target, anchor = map(unquote, urldefrag(link))
            if "://" in link or link.startswith(("mailto:", "data:")):
                continue
            at = (page.parent / target.partition("?")[0]).resolve() if target else page
            here = at.is_file() and (not anchor or at not in names or anchor in names[at])
            found += [] if here else [f"{page.name}: {link}"]
    return found


def test_broken_links_are_seen(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<p id="x"><a href="#x"><a href="a.html#y"><a href="b.html">')
    assert broken(tmp_path) == ["a.html: a.html#y", "a.html: b.html"]


@pytest.mark.skipif(bool(ABSENT), reason=f"not installed: {', '.join(ABSENT)}")
def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    words = ("-W", "--keep-going", "-q", "-E", "-d", tmp_path / "read", DOCS, tmp_path / "site")
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", *words], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    pages = {path.stem for path in (tmp_path / "site").glob("*.html")}
    assert pages - {"genindex", "search"} == NAMES
    assert broken(tmp_path / "site") == []
    models = (tmp_path / "site" / "built_in_models.html").read_text(encoding="utf-8")
    assert all(f'<section id="{name.replace("_", "-")}">' in models for name in loading.names())
    assert models.count('<svg viewBox="0 0 640 190"') == len(loading.names())
    assert "<!-- made" not in models and "nan" not in re.sub(r"<script.*?</script>", "", models)
