"""One sentence with the author's file and line out of what a compiler says."""

from __future__ import annotations

import re

from montecarlo_brdf.foreign.complaint import Complaint

RULES = (
    re.compile(  # gcc, clang
        r"^(?P<file>[^\n:]+):(?P<line>\d+):(?:\d+:)? (?:fatal )?error: (?P<text>.+)$", re.M
    ),
    re.compile(r"^ERROR: (?P<file>[^\n]+?):(?P<line>\d+): (?P<text>.+)$", re.M),  # glslang
    re.compile(  # Slang
        r"^(?:fatal )?error(?:\[\w+\])?: (?P<text>.+)\n\s*--> (?P<file>.+?):(?P<line>\d+):\d+"
        r"(?:(?:\n[^^\n]*){2}\n[^^\n]*\^+ ?(?P<caret>.*))?",
        re.M,
    ),
)
#: how the lines that a key of the description became are called in #line
KEY = "brdf-check key "
OURS = re.compile(r"bc_(?:colour|direction|number)")
LONGEST = 200


def complaint(said: str) -> Complaint:
    """What is wrong, where, and how many more."""
    found = [m for rule in RULES for m in rule.finditer(said)]
    if not found:
        return Complaint(" ".join(said.split())[:LONGEST] or "its compiler said nothing")
    others = len({m["line"] + m["file"] for m in found}) - 1
    text = f"{_where(found[0])}: {_cleaned(_text(found[0]))}"
    text = f"{text} (and {others} more)" if others else text
    return Complaint(text, placed=not text.startswith("key "))


def _where(found: re.Match[str]) -> str:
    file = found["file"].strip().strip('"')
    if file.startswith(KEY):
        return f"key {file.removeprefix(KEY)}"
    return f"{file}, line {found['line']}"


def _text(found: re.Match[str]) -> str:
    """The message, and what Slang says beside its caret if that is more."""
    text = found["text"].strip()
    more = (found.groupdict().get("caret") or "").strip().rstrip(".")
    if not more:
        return text
    return more if more.startswith(text) else f"{text}: {more}"


def _cleaned(text: str) -> str:
    """Without quotes around nothing, and with our own words for what is ours."""
    missing = re.search(r"\bno file (.+) to include", text)
    if missing:
        name = re.sub(" ?([./]) ?", r"\1", missing[1])  # the compiler takes it apart
        return f"no file {name} to include"
    if OURS.search(text):
        return "it is neither a number nor a colour" if "colour" in text else "it is no direction"
    if "bc_vec3" in text:
        return "it is no number"
    if "bc_w" in text or "is not a structure or union" in text:
        return "it is no direction"
    return re.sub(r"^'(.*?)' : +", lambda m: f"'{m[1]}' " if m[1] else "", text)
