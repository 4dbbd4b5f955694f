"""A picture within a page: SVG without names of its own, that nothing outside is asked for."""

from __future__ import annotations

import hashlib
import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

LINK = "{http://www.w3.org/1999/xlink}href"
REFERENCE = re.compile(r"#([\w.-]+)")


def svg(content: bytes) -> str:
    """An SVG file as an element of HTML; its ids are those of no other picture."""
    root = ElementTree.fromstring(content)
    prefix = f"p{hashlib.blake2b(content, digest_size=4).hexdigest()}-"
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag.rpartition("}")[2] == "metadata":
                parent.remove(child)
    for element in root.iter():
        _cleaned(element, prefix)
    for name in ("width", "height", "version"):
        root.attrib.pop(name, None)
    root.set("aria-hidden", "true")  # what it shows stands in tables
    return ElementTree.tostring(root, encoding="unicode")


def _cleaned(element: Element, prefix: str) -> None:
    element.tag = element.tag.rpartition("}")[2]
    if LINK in element.attrib:
        element.set("href", element.attrib.pop(LINK))
    for name, value in element.attrib.items():
        if name == "id":
            element.set(name, prefix + value)
        elif name == "href" or "url(#" in value:
            element.set(name, REFERENCE.sub(rf"#{prefix}\1", value))
