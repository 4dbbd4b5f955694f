"""The page: valid, of one file, escaped, small, and it opens without a complaint."""

from __future__ import annotations

import json
import math
import re
import shlex
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.judge.finding import Command, Finding, Report, Result, Verdict
from montecarlo_brdf.report import densities, formats, html
from montecarlo_brdf.report.json import read_report

html5lib = pytest.importorskip("html5lib")
Call = Callable[..., Outcome]
EVIL = "<script>alert(1)</script>.py"
MISSING_PI = "from typing import NamedTuple\nclass Params(NamedTuple):\n    c: float = 0.5\n"
MISSING_PI += "scales_with = 'c'\n\ndef f(wo, wi, p):\n    return p.c  # <b>&amp;</b>\n"


def parsed(page: str) -> Any:
    """The tree of a page; raises for anything that is not valid."""
    return html5lib.HTMLParser(strict=True, namespaceHTMLElements=False).parse(page)


def faults(page: str) -> list[str]:
    """What a page must not have: references to elsewhere, ids used twice or that lead nowhere."""
    tree = parsed(page)
    ids = [e.get("id") for e in tree.iter() if e.get("id")]
    links = [v for e in tree.iter() for k, v in e.attrib.items() if "href" in str(k) or k == "src"]
    found = [f"id {i} twice" for i in {*ids} if ids.count(i) > 1]
    found += [f"outside: {link}" for link in links if not link.startswith("#")]
    found += [f"nowhere: {link}" for link in links if link[1:] not in ids]
    style = "".join(e.text or "" for e in tree.iter("style"))
    found += re.findall(r"url\([^#)][^)]*\)|@import[^;]*", style + page.replace("url(#", ""))
    outside = re.findall(r"https?://[^\s\"'<]*", page)
    return found + [o for o in outside if o]


@pytest.mark.parametrize(
    "page",
    [
        '<!DOCTYPE html><title>x</title><p id="a"><p id="a">',
        '<!DOCTYPE html><title>x</title><img src="x.png">',
        '<!DOCTYPE html><title>x</title><a href="#b">x</a>',
        '<!DOCTYPE html><title>x</title><a href="https://example.org">x</a>',
    ],
)
def test_faults_are_seen(page: str) -> None:
    assert faults(page)


def test_what_is_no_html_is_seen() -> None:
    with pytest.raises(Exception, match="."):
        parsed("<!DOCTYPE html><title>x</title><p></div>")


def many(count: int, verdict: Verdict = Verdict.PASS) -> list[Finding]:
    numbers: dict[str, Any] = {"stderr": 1e-4, "expected": 1.0, "tolerance": 1e-3, "samples": 64}
    return [
        Finding("A", {"theta_o_deg": 0.01 * k}, verdict, value=1.0 + 1e-7 * k, **numbers)
        for k in range(count)
    ]


def text_of(page: str) -> str:
    return "".join(parsed(page).itertext())


def test_everything_is_escaped() -> None:
    evil = Finding(EVIL, {EVIL: EVIL}, Verdict.FAIL, note=EVIL, hint=EVIL, reproduce=EVIL)
    source = {"file": EVIL, "line": 1}
    result = Result(EVIL, {EVIL: EVIL}, EVIL, [evil, *many(3)], [], source)
    for command in (Command.RUN, Command.FURNACE):
        report = Report(command, {EVIL: EVIL}, [result], {"sources": {EVIL: f"{EVIL}\n</style>"}})
        page = formats.render(report, "html")
        assert faults(page) == [] and page.count("<script>") == 1 and EVIL in text_of(page)


DRAWN = pytest.param(Command.FURNACE, marks=pytest.mark.slow)


@pytest.mark.parametrize("command", [Command.RUN, DRAWN, Command.COMPARE])
def test_ten_thousand_findings(command: Command) -> None:
    findings = [*many(9_999), *many(1, Verdict.FAIL)]
    report = Report(command, {"seed": 0}, [Result("my.py", {"a": 0.5}, "furnace", findings)])
    page = html.render(report)
    assert faults(page) == [] and len(page) < 1_500_000
    assert "9800 more rows" in page and "9999 pass, 1 fail" in page
    assert page.index("fail") < page.index("more rows")


def test_values_that_are_no_numbers() -> None:
    odd = [Finding("A", {"theta_o_deg": 0.0}, Verdict.FAIL, value=v, stderr=math.nan, expected=1.0,
                   tolerance=1e-3, samples=4) for v in (math.nan, math.inf, -math.inf)]  # fmt: skip
    for command in (Command.RUN, Command.FURNACE, Command.RADIANCE, Command.CONVERGE):
        report = Report(command, {}, [Result("m", {}, "furnace", odd)], {})
        assert faults(html.render(report)) == []
    assert faults(html.render(Report(Command.RUN, {}, []))) == []


def test_the_page_of_a_failing_model(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("my <b>.py").write_text(MISSING_PI, encoding="utf-8")
    line = ("run", "--model", "my <b>.py", "--check", "furnace,energy", "--theta-o", "0,60")
    exports = ("--export", "page.html", "--export", "r.json")
    assert cli(*line, *exports).code == 1
    page = Path("page.html").read_text(encoding="utf-8")
    assert faults(page) == [] and len(page.encode()) < 1_500_000
    words = text_of(page)
    assert words.index("FAIL") < words.index("1/pi is missing") < words.index("Source")
    assert "def f(wo, wi, p): ← furnace, energy" in words and "<b>&amp;</b>" in words
    assert "brdf-check run --model 'my <b>.py' --check furnace" in words and page.count("<svg") == 4
    # a pure function of the report, whoever has it and with whatever versions
    monkeypatch.setattr("montecarlo_brdf.judge.finding.versions", lambda: {"numba": "other"})
    again = read_report(Path("r.json"))
    again.measured["repeat"] = shlex.join(["brdf-check", *line, *exports])
    assert html.render(again) == page


def test_several_reports_make_one_page(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli("furnace", "--model", "lambert", "--theta-o", 0, "--export", "a.json").code == 0
    assert cli("identities", "--export", "b.json").code == 0
    assert cli("report", "a.json", "b.json", "-o", "both.html").code == 0
    page = Path("both.html").read_text(encoding="utf-8")
    assert faults(page) == [] and "How furnace was asked" in page and "How identities" in page
    assert cli("report", "a.json", "-o", "a.md").code == 0 and Path("a.md").read_text()
    assert cli("report", "a.json", "b.json", "-o", "both.md").code == 2
    assert cli("report", "a.json", "-o", "a.json").code == 2
    assert cli("report", "a.json", "-o", "none/a.html").code == 5
    damaged = json.loads(Path("a.json").read_text())
    Path("stress.json").write_text(json.dumps({**damaged, "command": "stress"}))
    assert "cannot be shown" in cli("report", "stress.json", "-o", "x.html").err
    Path("old.json").write_text(json.dumps({"schema": 0, "results": []}))
    assert "reads schema" in cli("report", "old.json", "-o", "x.html").err


@pytest.mark.slow
def test_pages_of_other_commands(cli: Call, tmp_path: Path) -> None:
    for line in (
        "stress --model lambert --quick", "converge --model lambert --sampler cosine",
        "radiance --model lambert --environment cosine:2 --theta-o 0,60", "compare lambert eon",
    ):  # fmt: skip
        page = tmp_path / "page.html"
        assert cli(*line.split(), "--export", page).code in (0, 1), line
        assert faults(page.read_text(encoding="utf-8")) == []


BODY = "def f(wo, wi, p):\n    return 0.1  # größe\n"
SOURCES = {
    "declared": b"# -*- coding: latin-1 -*-\n" + BODY.encode("latin-1"),
    "not declared": BODY.encode("latin-1"),
    "a byte order mark": BODY.encode("utf-8-sig"),
    "utf-8": BODY.encode("utf-8"),
}


@pytest.mark.parametrize("kind", SOURCES)
def test_sources_in_other_encodings(
    kind: str, cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("my.py").write_bytes(SOURCES[kind])
    line = ("furnace", "--model", "my.py", "--theta-o", 0, "--export", "page.html")
    assert cli(*line).code == 0
    page = Path("page.html").read_text(encoding="utf-8")
    shown = "gr\ufffd\ufffde" if kind == "not declared" else "größe"
    assert faults(page) == [] and shown in page and "\ufeff" not in page


def test_a_source_of_an_encoding_that_python_refuses(cli: Call, tmp_path: Path) -> None:
    path = tmp_path / "my.py"
    path.write_bytes(BODY.encode("utf-16"))
    outcome = cli("furnace", "--model", path, "--export", tmp_path / "page.html")
    assert outcome.code == 4 and outcome.err.count("\n") == 1 and str(path) in outcome.err
    assert not (tmp_path / "page.html").exists()


def test_a_file_with_an_evil_name(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(EVIL).parent.mkdir()
    Path(EVIL).write_text(MISSING_PI, encoding="utf-8")
    exports = [f"--export=r.{kind}" for kind in ("html", "md", "xml", "sarif")]
    line = ("furnace", "--model", EVIL, "--theta-o", "0", *exports)
    assert cli(*line).code == 1
    page = Path("r.html").read_text(encoding="utf-8")
    assert faults(page) == [] and page.count("<script>") == 1
    assert f"{EVIL}(c=0.5)" in text_of(page) and shlex.quote(EVIL) in text_of(page)
    assert all("<script>" not in Path(f"r.{kind}").read_text() for kind in ("md", "xml"))
    assert "%3Cscript%3E" in Path("r.sarif").read_text()


def test_a_page_that_cannot_be_written(cli: Call, tmp_path: Path) -> None:
    (tmp_path / "page.html").mkdir()
    for name in ("page.html", "none/page.html"):
        outcome = cli("furnace", "--model", "lambert", "--export", tmp_path / name)
        assert outcome.code == 5 and outcome.err.count("\n") == 1 and not outcome.out
    assert [p.name for p in tmp_path.iterdir()] == ["page.html"]


@pytest.mark.parametrize("schema", [0, 99, None, "1"])
def test_reports_of_other_schemas(schema: object, cli: Call, tmp_path: Path) -> None:
    path = tmp_path / "old.json"
    path.write_text(json.dumps({"schema": schema, "command": "run", "results": []}))
    run = ("run", "--model", "lambert", "--baseline", path)
    for line in (("report", path, "-o", tmp_path / "x.html"), run):
        outcome = cli(*line)
        assert outcome.code == 2 and "this version reads schema 1" in outcome.err
        assert outcome.err.count("\n") == 1 and not outcome.out


@pytest.mark.parametrize("command", ["dance", None, [], 7])
def test_reports_of_other_commands(command: object, cli: Call, tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    path.write_text(json.dumps({"schema": 1, "command": command, "results": []}))
    outcome = cli("report", path, "-o", tmp_path / "x.html")
    assert outcome.code == 2 and outcome.err.count("\n") == 1 and not outcome.out
    assert f"is a report of {command!r}, which this version does not know" in outcome.err


def test_a_title_has_room_for_some_names() -> None:
    def title(count: int) -> str:
        rows = [Result(f"model_{k}", {}, "furnace", many(1)) for k in range(count)]
        return html.render(Report(Command.RUN, {}, rows)).split("<title>")[1].split("</title>")[0]

    assert title(2).endswith("run: model_0, model_1") and title(9).endswith("run: 9 models")
    assert html.render(Report(Command.RUN, {}, [])).count("brdf-check run<") == 1


def never_run(lines: str, **where: str) -> Finding:
    return Finding("lines run", {**where, "lines": lines}, Verdict.KNOWN, value=3.0, stderr=0.0)


def test_lines_that_no_check_ran_are_marked() -> None:
    content = "".join(f"line{k}\n" for k in range(1, 8))
    source = {"file": "my.py", "line": 1, "functions": {"f": 4}}
    failing = Result("my.py", {}, "furnace", many(1, Verdict.FAIL), [], source)
    odd = [never_run("3-5, 7"), never_run("1", file="other.py"), never_run("-"), never_run("1-x")]
    report = Report(
        Command.RUN, {}, [failing, Result("my.py", {}, "coverage", odd, [], source)],
        {"sources": {"my.py": content}},
    )  # fmt: skip
    page = html.render(report)
    assert faults(page) == []
    rows = [" ".join(row.itertext()) for row in parsed(page).iter("tr")]
    shown = {row.split()[1]: row for row in rows if "line" in row and row.split()[0].isdigit()}
    marked = [k for k, row in shown.items() if "never run" in row]
    assert marked == ["line3", "line4", "line5", "line7"]
    assert "furnace" in shown["line4"] and "that no check ran (4)" in text_of(page)
    covered = Finding("lines run", {}, Verdict.PASS, value=7.0, stderr=0.0)
    one = Result("my.py", {}, "coverage", [covered], [], source)
    whole = html.render(Report(Command.RUN, {}, [one], {"sources": {"my.py": content}}))
    assert "Checks ran every line." in whole and "never run" not in whole


def counted(**changes: Any) -> Finding:
    """Two columns of two cells: 10 draws in one that should have 25."""
    quarters = [(0.0, 0.2, 0.0, 0.5), (0.2, 1.0, 0.0, 0.5), (0.0, 0.4, 0.5, 1.0),
                (0.4, 1.0, 0.5, 1.0)]  # fmt: skip
    data = {"counts": [10, 30, 30, 30, 0],
            "cells": [[*sides, 0.25, k] for k, sides in enumerate(quarters)]}  # fmt: skip
    return replace(many(1)[0], draws={**data, **changes})


def test_draws_are_shown_beside_the_pdf() -> None:
    (first, *_) = cells = densities.cells(counted())
    assert (first.found, first.expected) == (10.0, 25.0) and first.residual == -3.0
    assert math.fsum(c.area for c in cells) == pytest.approx(1.0)
    report = Report(Command.RUN, {}, [Result("my.py", {}, "sampling", [counted()])])
    page = html.render(report)
    assert faults(page) == [] and "Draws against pdf" in page and "100 draws" in page
    shades = {p.title: {name for name, _, _ in p.shades} for p in
              densities.draws(report.results).panels}  # type: ignore[union-attr]  # fmt: skip
    assert shades["difference"] == {"more", "less"} and shades["pdf"] == {"dense"}


@pytest.mark.parametrize(
    "changes", [{"counts": []}, {"counts": [1, 2]}, {"cells": None}, {"cells": [[0.0, 1.0]]}]
)
def test_damaged_draws_are_left_out(changes: dict[str, Any]) -> None:
    result = Result("my.py", {}, "sampling", [counted(**changes)])
    assert "Draws against" not in html.render(Report(Command.RUN, {}, [result]))


def test_every_look_at_draws_can_be_shown() -> None:
    report = mb.run(mb.load("lambert"), names=["sampling"], theta_o_deg=[30.0], effort=0.03)
    findings = [f for r in report.results for f in r.findings]
    assert findings and all(f.draws for f in findings)
    for one in findings:
        found = densities.cells(one)
        assert sum(c.found for c in found) <= 1.001 * one.samples  # type: ignore[operator]
        assert math.fsum(c.area for c in found) == pytest.approx(1.0, abs=1e-3)
        assert max(abs(c.residual) for c in found) < 6.0
    again = json.loads(report.to_json())["results"][0]["findings"][0]["draws"]
    assert again == findings[0].draws


def test_the_page_of_a_benchmark(
    cli: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = ("bench", "--model", "lambert", "--quick", "--method", "uniform x sobol,cosine x sobol")
    assert cli(*line, "--export", "time.json", "--export", "time.html").code == 0
    page = Path("time.html").read_text(encoding="utf-8")
    assert faults(page) == [] and len(page) < 500_000
    words = text_of(page)
    assert "bench: lambert(albedo=0.8) at 60°" in words and "to an error of 0.001" in words
    assert "uniform x sobol" in words and "--export time.html" in words
    assert cli("report", "time.json", "-o", "again.html").code == 0
    assert "bench: lambert" in text_of(Path("again.html").read_text(encoding="utf-8"))
    assert cli("report", "time.json", "-o", "again.md").code == 2
    assert cli(*line, "--export", "time.csv").code == 2


BROWSER = shutil.which("chromium") or shutil.which("google-chrome")


@pytest.mark.slow
@pytest.mark.skipif(not BROWSER, reason="no Chromium")
def test_a_browser_opens_it_without_a_word(cli: Call, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    cli("run", "--model", "lambert_unnormalised", "--check", "furnace", "--export", page)
    flags = ("--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0")
    hosts = "--host-resolver-rules=MAP * ~NOTFOUND"
    began = time.perf_counter()
    done = subprocess.run(
        [str(BROWSER), *flags, hosts, "--virtual-time-budget=500", "--dump-dom", f"file://{page}"],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert "CONSOLE" not in done.stderr and "Failed to load" not in done.stderr
    assert ">Copy</button>" in done.stdout and 'hidden=""' not in done.stdout  # its script ran
    assert time.perf_counter() - began < 20.0


@pytest.mark.slow
def test_the_page_of_all_models_is_small(cli: Call, tmp_path: Path) -> None:
    page = tmp_path / "all.html"
    assert cli("run", "--model", "all", "--effort", 0.03, "--export", page).code in (0, 3)
    assert page.stat().st_size < 6_000_000 and faults(page.read_text(encoding="utf-8")) == []
