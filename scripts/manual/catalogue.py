"""The built-in models: what they are, formula and source, parameters, claims, and a picture."""

from __future__ import annotations

import html
from collections.abc import Iterator

from manual import lobes
from montecarlo_brdf import loading
from montecarlo_brdf.cli import _catalogue
from montecarlo_brdf.model import Model


def made() -> str:
    """A table of all, and a section for each."""
    models = [loading.load(name) for name in loading.names()]
    rows = [f"| [{m.name}](#{m.name}) | {_catalogue.first_line(m)} |" for m in models]
    table = ["| model | what it is |", "|---|---|", *rows, ""]
    return "\n".join([*table, *(line for m in models for line in _section(m))])


def _section(model: Model) -> Iterator[str]:
    first, _, rest = model.doc.strip().partition("\n")
    formula = f'<pre style="white-space: pre-wrap">{html.escape(rest.strip())}</pre>'
    yield from (f"## {model.name}", "", first, "", formula, "")
    yield from (f'<div class="lobes">{lobes.picture(model)}</div>', "")
    if names := _catalogue.ranges(model):
        yield from ("Parameters: " + ", ".join(f"`{name}`" for name in names) + ".", "")
    for category, picks in model.choices.items():
        yield from (f"Choice `-p {category}=...`, the first if none is picked:", "")
        said = ((pick, _catalogue.said_of(option)) for pick, option in picks.items())
        yield from (f"- `{pick}`" + (f": {_plain(words)}" if words else "") for pick, words in said)
        yield ""
    claims = ", ".join(_catalogue.data(model)["claims"])
    yield from (f"Claims {claims}. Reference of A: {_catalogue.reference_kind(model)}.", "")
    for name, reason in model.disclaims.items():
        yield from (f"Disclaims {name}: {_plain(reason)}.", "")
    yield from (f"```sh\nbrdf-check run --model {model.name}\n```", "")


def _plain(text: str) -> str:
    """Text that means no more to Markdown than it says."""
    for sign in "\\*_<[":
        text = text.replace(sign, f"\\{sign}")
    return text
