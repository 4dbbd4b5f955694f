"""Bad input: one sentence on stderr that says what was wrong and what is allowed, the right exit
code, no traceback, nothing on stdout and no file left behind."""
from __future__ import annotations

import os
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

from montecarlo_brdf import files

USAGE, MODEL, OUTPUT = 2, 4, 5
Command = Callable[..., Outcome]


def refused(outcome: Outcome, code: int, *said: str) -> None:
    """One sentence with all of `said` in it, and nothing else."""
    assert outcome.code == code, outcome
    assert outcome.err.startswith("Error: ") and outcome.err.count("\n") == 1, outcome.err
    assert outcome.err.endswith("\n") and outcome.out == ""
    for words in said:
        assert words in outcome.err


MISTAKES = {
    "furnace --model lamber": ("'lamber'", "did you mean 'lambert'?", "choose from", "ggx", ".py"),
    "furnace --model 'my brdf.py'": ("no model file my brdf.py",),
    "show my.metal": ("my.metal is neither a Python file, with a function f(wo, wi, p), nor a",),
    "converge --model lambert --points all,sobol": ("'all' stands alone, for every point set",),
    "run --model lambert --config x.toml": ("give --model or --config, not both",),
    "furnace --model zzz": ("no model 'zzz'", "lambert_unnormalised", "path of a .py file"),
    "furnace --model missing.py": ("no model file missing.py",),
    "furnace --model missing.py:matte": ("no model file missing.py",),
    "show lamber": ("did you mean 'lambert'?",),
    "furnace --model lambert -p albdo=0.5": ("'albdo'", "did you mean 'albedo'?"),
    "furnace --model lambert -p zzz=0.5": ("no parameter", "'zzz'", "choose from albedo"),
    "furnace --model lambert -p albedo=1.5": ("albedo", "a number in [0, 1]", "1.5"),
    "furnace --model lambert -p albedo=-0.1": ("a number in [0, 1]", "-0.1"),
    "furnace --model lambert -p albedo=nan": ("a number in [0, 1]", "nan"),
    "furnace --model lambert -p albedo=inf": ("a number in [0, 1]", "inf"),
    "furnace --model lambert -p albedo=bright": ("a number in [0, 1]", "bright"),
    "furnace --model lambert -p albedo=0.1/7": ("a number in [0, 1]", "7"),
    "furnace --model lambert -p albedo": ("name=value", "'albedo'"),
    "furnace --model lambert -p albedo=": ("name=value",),
    "furnace --model lambert -p albedo=0:1:1": ("first:last:count", "2 to 10000"),
    "furnace --model lambert -p albedo=0:1:log5": ("positive ends",),
    "furnace --model lambert -p albedo=0:1:10000,0.5": ("10001", "10000 allowed"),
    "furnace --model lambert -p albedo=0.1 -p albedo=0.2": ("twice", "albedo=a,b"),
    "furnace --model lambert --theta-o 90": ("[0, 90) degrees", "90"),
    "furnace --model lambert --theta-o 0,30,120": ("[0, 90) degrees", "120"),
    "furnace --model lambert --theta-o=-1": ("[0, 90) degrees", "-1"),
    "furnace --model lambert --theta-o nan": ("theta-o must be a finite number", "'nan'"),
    "furnace --model lambert --theta-o steep": ("theta-o must be a finite number", "'steep'"),
    "furnace --model lambert --theta-o 0:90:4": ("[0, 90) degrees", "90"),
    "furnace --model lambert --theta-o 0:80": ("first:last:count",),
    "furnace --model lambert --theta-o 0:80:\u00b2": ("first:last:count",),
    "furnace --model lambert --phi-o east": ("phi-o must be a finite number", "'east'"),
    "furnace --model lambert --samples 0": ("from 1 to 2^40", "not 0"),
    "furnace --model lambert --samples=-5": ("from 1 to 2^40", "not -5"),
    "furnace --model lambert --samples many": ("'many' is not a whole number", "2^16 or 1e6"),
    "furnace --model lambert --samples nan": ("'nan' is not a whole number",),
    "furnace --model lambert --samples 1.5": ("'1.5' is not a whole number",),
    "furnace --model lambert --samples 1e20": ("from 1 to 2^40", "100000000000000000000"),
    "furnace --model lambert --samples 100000000000000000000": ("from 1 to 2^40",),
    "furnace --model lambert --samples 2^99999999": ("2^99999999", "is not a whole number"),
    "furnace --model lambert --points halton": ("no point set 'halton'", "independent", "sobol"),
    "furnace --model lambert --sampler cosin": ("did you mean 'cosine'?", "all, uniform, cosine"),
    "furnace --model lambert --sampler own,best": ("no sampler 'best'", "uniform, cosine, own"),
    "furnace --model lambert --format xml": ("no format 'xml'", "choose from", "text", "json"),
    "furnace --model lambert --inconclusive maybe": ("'maybe'", "'pass', 'fail'"),
    "furnace --model lambert --threads 0": ("from 1 to 1024", "0"),
    "furnace --model lambert --threads two": ("'two' is not a whole number",),
    "furnace --model lambert --seed first": ("from 0 to 2^64 - 1, or random", "'first'"),
    "furnace --model lambert --seed=-1": ("from 0 to 2^64 - 1",),
    "furnace --model lambert --seed 18446744073709551616": ("from 0 to 2^64 - 1",),
    "furnace --model lambert --seed \u00b2": ("from 0 to 2^64 - 1",),
    "furnace --model lambert --tolerance tight": ("'tight' is not a number in [0, 1)",),
    "furnace --model lambert --tolerance nan": ("'nan' is not a number in [0, 1)",),
    "furnace --model lambert --tolerance=-1": ("a number in [0, 1)", "-1"),
    "furnace --model lambert --tolerance 1": ("a number in [0, 1)", "1.0"),
    "furnace --model lambert --tolernce 1": ("'--tolernce'", "Did you mean '--tolerance'?"),
    "furnace --model lambert --zzz 1": ("'--zzz'", "see brdf-check furnace --help"),
    "furnace --model lambert stray": ("unexpected extra argument (stray)",),
    "furnace": ("--model", "see brdf-check furnace --help"),
    "furnac": ("did you mean 'furnace'?", "choose from", "identities", "show"),
    "identities --points halton": ("no point set 'halton'", "independent", "sobol"),
    "plot missing.json -o a.png": ("cannot read missing.json", "No such file"),
    "bench --model lambert --seconds 0": ("seconds and seeds must be above 0", "0"),
    "plot": ("'REPORT'", "see brdf-check plot --help"),
}


@pytest.mark.parametrize("line", MISTAKES)
def test_a_mistake_is_one_sentence(line: str, cli: Command) -> None:
    refused(cli(*shlex.split(line)), USAGE, *MISTAKES[line])


def test_own_sampler_of_a_model_without_one(cli: Command, user_file: Callable[..., Path]) -> None:
    path = user_file("def f(wo, wi, p):\n    return 0.1\n")
    said = "no sample and pdf, so no sampler of its own"
    refused(cli("furnace", "--model", path, "--sampler", "own"), USAGE, said)


FILES = {
    "syntax error": ("def f(wo, wi, p) return 1", "line 1: expected ':'"),
    "null byte": ("def f(wo, wi, p):\n    return \0", "line 1: source code string cannot contain"),
    "no f": ("x = 1", "defines no function f(wo, wi, p)"),
    "f is no function": ("f = 3", "defines no function f(wo, wi, p)"),
    "wrong arguments": ("def f(wo, wi):\n    return 0.1", "must take the arguments (wo, wi, p)"),
    "raises when loaded": ("import nonesuch", "ModuleNotFoundError (line 1): No module"),
    "exits when loaded": ("import sys\nsys.exit(3)", "SystemExit (line 2)"),
    "Params is no NamedTuple": (
        "class Params:\n    a = 0.1\ndef f(wo, wi, p):\n    return p.a",
        "must be a NamedTuple of numbers",
    ),
    "Params has a string": (
        "from typing import NamedTuple\nclass Params(NamedTuple):\n    a: str = 'x'\n"
        "def f(wo, wi, p):\n    return 0.1",
        "must be a NamedTuple of numbers",
    ),
    "domain is no pair": (
        "domain = {'a': 3}\ndef f(wo, wi, p):\n    return 0.1",
        "must give (low, high) for a",
    ),
    "raises": ("def f(wo, wi, p):\n    raise ValueError('no such surface')",
               "raised ValueError (line 2): no such surface"),
    "misspells": ("def f(wo, wi, p):\n    return p.albedo", "raised AttributeError (line 2)"),
    "recurses": ("def f(wo, wi, p):\n    return f(wo, wi, p)", "raised RecursionError"),
    "returns None": ("def f(wo, wi, p):\n    x = 1.0", "must return a number, not None"),
    "returns a complex": (
        "def f(wo, wi, p):\n    return 1j",
        "Cannot cast complex128 to float64\n",
    ),
    "returns an array": (
        "import numpy as np\ndef f(wo, wi, p):\n    return np.array([0.1])",
        "must return a number, not a value of type ndarray",
    ),
    "returns a truth value": ("def f(wo, wi, p):\n    return True", "not a value of type bool"),
    "samples None": (
        "def f(wo, wi, p):\n    return 0.1\ndef sample(wo, u, p):\n    pass",
        "must return (x, y, z) or (x, y, z, weight), not None",
    ),
    "does not compile": (
        "import json\ndef f(wo, wi, p):\n    return json.loads('0.1')",
        "does not compile",
    ),
    "numba has no rule": (
        "def f(wo, wi, p):\n    with open('/dev/null') as file:\n        return len(file.read())",
        "does not compile: The 'with (context manager) as (variable):' construct",
    ),
    "two kinds of number": (
        "def f(wo, wi, p):\n    return 0.1 if wi[2] > 0.05 else 1j",
        "does not compile",
    ),
    "raises somewhere": (
        "def f(wo, wi, p):\n    if wi[2] < 0.01:\n        raise ValueError('low')\n    return 0.1",
        "raised ValueError (line 3): low at wo = (0.5, 0, 0.866025), wi = (",
    ),
    "returns None somewhere": (
        "def f(wo, wi, p):\n    if wi[2] > 0.05:\n        return 0.1",
        "must return a number, not None at wo = (0.5, 0, 0.866025), wi = (",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", FILES)
def test_a_file_that_is_no_model(
    case: str, cli: Command, user_file: Callable[..., Path], tmp_path: Path
) -> None:
    text, said = FILES[case]
    path = user_file(text)
    export = tmp_path / "report.json"
    outcome = cli("furnace", "--model", path, "--theta-o", 30, "--export-json", export)
    refused(outcome, MODEL, said)
    assert set(os.listdir(tmp_path)) - {"__pycache__"} == {path.name}  # Python's own bytecode


def test_a_file_with_models_but_no_f_offers_them(
    cli: Command, user_file: Callable[..., Path]
) -> None:
    path = user_file("def chalk(wo, wi, p):\n    return 0.1\nclass matte:\n    f = chalk\n")
    refused(cli("show", path), MODEL, "no function f", f"{path}:chalk, {path}:matte")
    refused(cli("show", f"{path}:chalks"), USAGE, "did you mean 'chalk'?", "chalk, matte")


OUTPUTS = {
    "in no folder": ("none/report.{}", "there is no directory"),
    "a folder": ("folder.{}", "it is a directory"),
    "below a file": ("file/report.{}", "there is no directory"),
}


@pytest.mark.parametrize("case", OUTPUTS)
@pytest.mark.parametrize(("option", "kind"), [("--export-json", "json"), ("--plot", "png")])
def test_output_that_cannot_be_written(
    case: str, option: str, kind: str, cli: Command, tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    (tmp_path / f"folder.{kind}").mkdir()
    before = sorted(os.listdir(tmp_path))
    name, said = OUTPUTS[case]
    target = tmp_path / name.format(kind)
    refused(cli("furnace", "--model", "lambert", option, target), OUTPUT, said, str(target))
    assert sorted(os.listdir(tmp_path)) == before


def test_a_picture_of_unknown_kind(cli: Command, tmp_path: Path) -> None:
    outcome = cli("furnace", "--model", "lambert", "--plot", tmp_path / "albedo.bmp")
    refused(outcome, USAGE, "must end in .png, .svg or .pdf")
    assert os.listdir(tmp_path) == []


def test_a_write_that_breaks_off_leaves_nothing(
    cli: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(source: str, target: str) -> None:
        raise OSError(28, "No space left on device")

    target = tmp_path / "report.json"
    target.write_text("before")
    monkeypatch.setattr(files.os, "replace", broken)
    outcome = cli("furnace", "--model", "lambert", "--theta-o", 0, "--export-json", target)
    refused(outcome, OUTPUT, str(target), "No space left on device")
    assert os.listdir(tmp_path) == ["report.json"] and target.read_text() == "before"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_disk(cli: Command) -> None:
    lambert = ("furnace", "--model", "lambert", "--theta-o", 0)
    refused(cli(*lambert, "--export-json", "/dev/full"), OUTPUT, "No space left on device")


@pytest.mark.parametrize(
    "content", ["", "[1, 2]", '{"results": 3}', "furnace", '{"schema": 99, "results": []}']
)
def test_a_file_that_is_no_report(content: str, cli: Command, tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    path.write_text(content)
    picture = tmp_path / "a.png"
    refused(cli("plot", path, "-o", picture), USAGE, str(path))
    assert not picture.exists()


def test_a_crash_does_not_look_like_a_verdict(
    cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    from montecarlo_brdf.verify import furnace

    def crash(*_: object, **__: object) -> None:
        raise ZeroDivisionError("a bug\nof ours")

    monkeypatch.setattr(furnace, "furnace", crash)
    monkeypatch.delenv("BRDF_CHECK_DEBUG", raising=False)
    outcome = cli("furnace", "--model", "lambert")
    assert outcome.code == 70 and outcome.err.count("\n") == 1
    assert "internal error: ZeroDivisionError: a bug of ours" in outcome.err
    monkeypatch.setenv("BRDF_CHECK_DEBUG", "1")
    with pytest.raises(ZeroDivisionError):
        cli("furnace", "--model", "lambert")


def test_an_interrupt_has_its_own_code(cli: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    from montecarlo_brdf.verify import furnace

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(furnace, "furnace", interrupt)
    outcome = cli("furnace", "--model", "lambert")
    assert outcome.code == 130 and outcome.err.strip() == "interrupted"
