"""The rules of the JUnit XML that Jenkins accepts, as tables: elements, their attributes, children.

They restate the public junit-10 schema of Jenkins' xUnit plugin; `faults` lists what breaks them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree.ElementTree import Element

#: element -> (required attributes, other attributes, children)
RULES: dict[str, tuple[set[str], set[str], set[str]]] = {
    "testsuites": (set(), {"name", "time", "tests", "failures", "errors"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests", "failures", "errors"},
        {
            "group",
            "time",
            "skipped",
            "timestamp",
            "hostname",
            "id",
            "package",
            "file",
            "log",
            "url",
        },
        {"testsuite", "properties", "testcase", "system-out", "system-err"},
    ),
    "properties": (set(), set(), {"property"}),
    "property": ({"name", "value"}, set(), set()),
    "testcase": (
        {"name"},
        {"time", "classname", "group"},
        {"skipped", "error", "failure", "system-out", "system-err"},
    ),
    "failure": (set(), {"type", "message"}, set()),
    "error": (set(), {"type", "message"}, set()),
    "skipped": (set(), {"type", "message"}, set()),
    "system-out": (set(), set(), set()),
    "system-err": (set(), set(), set()),
}
WITH_TEXT = {"failure", "error", "skipped", "system-out", "system-err"}
COUNTS = {"tests": "testcase", "failures": "failure", "errors": "error", "skipped": "skipped"}
TIME = re.compile(r"(([0-9]{0,3},)*[0-9]{3}|[0-9]{0,3})*(\.[0-9]*)?")


def faults(root: Element) -> list[str]:
    """Everything about a document that the rules do not allow."""
    first = [] if root.tag in ("testsuites", "testsuite") else [f"the root is <{root.tag}>"]
    return [*first, *(f for element in root.iter() for f in _of(element))]


def _of(element: Element) -> Iterator[str]:
    tag = element.tag
    if tag not in RULES:
        yield f"<{tag}> is unknown"
        return
    required, optional, children = RULES[tag]
    yield from (f"<{tag}> lacks {a}" for a in required - set(element.attrib))
    yield from (f"<{tag}> has {a}" for a in set(element.attrib) - required - optional)
    yield from (
        f"<{child.tag}> stands in <{tag}>" for child in element if child.tag not in children
    )
    if tag not in WITH_TEXT and (element.text or "").strip():
        yield f"<{tag}> has text"
    if (
        "time" in element.attrib
        and tag != "testcase"
        and not TIME.fullmatch(element.attrib["time"])
    ):
        yield f"<{tag}> has time {element.attrib['time']}"
    for attribute, counted in COUNTS.items():
        if attribute in element.attrib:
            number = len(list(element.iter(counted)))
            if element.attrib[attribute] != str(number):
                yield f"<{tag}> says {attribute}={element.attrib[attribute]}, not {number}"
