"""The documentation is under test: generated blocks are fresh, files shown work, links lead on."""
from __future__ import annotations

import importlib.util
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import click
import pytest
from conftest import Outcome
from test_model_file import EXACT

from montecarlo_brdf.cli import commands

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = [ROOT / f"{name}.md" for name in ("README", "CONTRIBUTING", "CHANGELOG")]
PAGES += ROOT.glob("docs/*.md")


@pytest.fixture(scope="module")
def script() -> ModuleType:
    path = ROOT / "scripts" / "update_readme.py"
    spec = importlib.util.spec_from_file_location("update_readme", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_generated_blocks_are_fresh(script: ModuleType) -> None:
    """If this fails: python scripts/update_readme.py"""
    assert script.same(script.updated(README), README)


def test_the_tutorial_says_what_it_says(script: ModuleType) -> None:
    """If this fails: python scripts/update_readme.py"""
    page = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    assert page.count("<!-- run: ") == page.count("```console\n") == 6
    assert script.same(script.updated(page), page)
    for words in ("A / albedo = pi: the factor 1/pi is missing", "KNOWN", "wrote plastic.py"):
        assert words in page


@pytest.mark.parametrize("name", ["tutorial", "own_model"])
def test_all_code_of_a_page_is_run(name: str) -> None:
    """Each block is a file that the runs beside it use, or such a run."""
    page = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    files = re.findall(r"<!-- file: (\S+) -->\n```", page)
    runs = re.findall(r"<!-- run: (.*) -->\n```console\n", page)
    assert page.count("```") == 2 * (len(files) + len(runs))
    assert all(any(file in run for run in runs) for file in files)


def test_the_page_on_models_is_fresh(script: ModuleType) -> None:
    """If this fails: python scripts/update_readme.py"""
    page = (ROOT / "docs" / "own_model.md").read_text(encoding="utf-8")
    assert script.same(script.updated(page), page) and "reciprocal but for a factor" in page


def test_reports_of_causes_are_short() -> None:
    """Of six refuted models: 12 lines of 80 columns, the cause first."""
    page = (ROOT / "docs" / "diagnosis.md").read_text(encoding="utf-8")
    reports = re.findall(r"```console\n\$ brdf-check run [^\n]*\n(.*?)\$ echo", page, re.DOTALL)
    assert len(reports) == page.count("<!-- run on a terminal: ") == 6
    for report in reports:
        lines = report.splitlines()
        assert len(lines) <= 12
        assert all(len(x) <= 80 or x.startswith("  again ") for x in lines)  # to be copied whole
        assert "FAIL" in lines[0] and "cause " in lines[1]


@pytest.mark.slow
def test_reports_of_causes_are_fresh(script: ModuleType) -> None:
    """If this fails: python scripts/update_readme.py"""
    page = (ROOT / "docs" / "diagnosis.md").read_text(encoding="utf-8")
    assert script.same(script.updated(page), page)


def test_an_old_block_is_seen(script: ModuleType) -> None:
    old = "<!-- run: brdf-check --version -->\nsomething else\n<!-- end -->\n"
    new = script.updated(old)
    assert not script.same(new, old) and "brdf-check, version" in new


def test_how_long_the_tests_take_is_said_beside_their_command() -> None:
    beside = README.split("python -m pytest\n```\n")[1].strip().split("\n\n")[0]
    assert re.search(r"tests take .*minutes", beside)


def test_a_failing_run_comes_first() -> None:
    first = README.split("```console\n")[1].split("```")[0]
    assert "1.5707963(0)" in first
    assert "A / c = pi: the factor 1/pi is missing" in first
    assert first.endswith("$ echo $?\n1\n")


def test_the_file_shown_is_the_file_tested(script: ModuleType) -> None:
    assert ("my_brdf.py", EXACT) in script.FILE.findall(README)


def test_the_python_example_runs(
    user_file: Callable[..., Path],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    example = re.search(r"```python\n(import montecarlo_brdf as mb\n.*?)```", README, re.DOTALL)
    assert example is not None
    monkeypatch.chdir(user_file(EXACT).parent)
    names: dict[str, Any] = {}
    exec(example[1], names)
    assert capsys.readouterr().out.startswith("0.5") and names["report"].verdict == "pass"


def test_every_command_has_help_with_an_example(cli: Callable[..., Outcome]) -> None:
    for name in commands.list_commands(click.Context(commands)):
        text = cli(name, "--help")
        assert text.code == 0 and f"  brdf-check {name}" in text.out.split("Example")[-1], name
        assert f"| `brdf-check {name}` |" in README


def test_every_option_of_every_command_is_explained() -> None:
    context = click.Context(commands)
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command is not None and command.help
        for option in command.params:
            if isinstance(option, click.Option) and option.name != "help":
                assert option.help, f"{name} {option.name}"


def test_exit_codes_are_those_of_the_program() -> None:
    from montecarlo_brdf import cli, errors
    from montecarlo_brdf.judge.finding import EXIT_CODES

    used = {*EXIT_CODES.values(), cli.INTERNAL_ERROR, cli.INTERRUPTED}
    used |= {e.exit_code for e in (errors.UserError, errors.ModelError, errors.OutputError)}
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", README, re.MULTILINE)} == used


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), target


def test_every_member_of_the_contract_is_documented() -> None:
    from dataclasses import fields

    from montecarlo_brdf.model import PROPERTIES, Model

    page = (ROOT / "docs" / "models.md").read_text(encoding="utf-8")
    ours = {"name", "doc", "built_in", "picks", "namespace", "labels", "terms", "rebuild",
            "whole"}  # what the types of Params say
    for name in {f.name for f in fields(Model)} - ours:
        assert f"`{name}" in page, name
    for name in PROPERTIES:
        assert f"`{name}`" in page, name


def test_the_worked_example_of_contributing_is_a_model(
    tmp_path: Path, cli: Callable[..., Outcome], monkeypatch: pytest.MonkeyPatch
) -> None:
    """CONTRIBUTING shows a model and its reference: they load, agree, and each sees the other."""
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    model, reference = re.findall(r"```python\n(\"\"\".*?)```", page, re.DOTALL)
    monkeypatch.setattr(sys, "path", sys.path[:])
    path = tmp_path / "soft.py"
    names: dict[str, Any] = {}
    exec(reference, names)
    truth = names["albedo"](0.5, ks=0.7).value / 0.7
    known = f"def albedo(cos_theta_o, p):\n    return {truth / 0.5} * cos_theta_o * p.ks\n"
    path.write_text(f"{model}\n\n{known}")
    quick = ("furnace", "--model", path, "--theta-o", 60, "-p", "ks=0.7")
    assert cli(*quick).code == 0
    path.write_text(path.read_text().replace("1.5", "1.6"))
    assert cli(*quick).code == 1
