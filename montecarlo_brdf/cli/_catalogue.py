"""What models there are, as tables and pages of text."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from montecarlo_brdf import references
from montecarlo_brdf.model import PROPERTIES, Model
from montecarlo_brdf.report.columns import Column, Row, Style

COLUMNS = (
    Column("model", style=lambda name: Style.BOLD), Column("what it is", words=True),
    Column("parameters", fold=2, words=True), Column("disclaims", fold=1, words=True),
)  # fmt: skip


def row(model: Model) -> Row:
    """One model of a table."""
    names = [*(model.labels.get(n, n) for n in model.Params._fields), *model.choices]
    return (
        model.name, first_line(model), ", ".join(names), ", ".join(model.disclaims)
    )  # fmt: skip


def data(model: Model) -> dict[str, Any]:
    """Everything about a model as plain data."""
    defaults = model.Params._field_defaults
    names = {n: model.labels.get(n, n) for n in model.Params._fields}
    return {
        "name": model.name,
        "doc": model.doc.strip(),
        "parameters": {
            name: {"default": defaults.get(n), "domain": list(model.domain.get(n, ())) or None}
            for n, name in names.items()
        },
        "choices": {
            name: {"picked": model.picks[name], "options": [*picks]}
            for name, picks in model.choices.items()
        },
        "sampler": model.sample is not None,
        "reference": reference_kind(model),
        "claims": [p for p in PROPERTIES if p not in model.disclaims],
        "disclaims": dict(model.disclaims),
    }


def page(model: Model) -> list[str]:
    """Everything about one model but its name, in lines."""
    lines = [model.doc.strip(), "", "parameters: " + (", ".join(ranges(model)) or "none")]
    for category, picks in model.choices.items():
        lines.append(f"choice {category}: {', '.join(picks)} (now {model.picks[category]})")
        lines += [f"  {pick}: {said}" for pick in picks if (said := said_of(picks[pick]))]
    lines.append(f"sampler: {'its own' if model.sample else 'none of its own'}")
    lines.append(f"reference: {reference_kind(model)}")
    lines.append("claims: " + ", ".join(p for p in PROPERTIES if p not in model.disclaims))
    return lines + [f"disclaims {name}: {reason}" for name, reason in model.disclaims.items()]


def said_of(option: Any) -> str:
    """What the docstrings of an option's functions say in their first lines."""
    functions = option.get("functions", {}).values() if isinstance(option, Mapping) else [option]
    docs = [(getattr(f, "__doc__", None) or "").strip().partition("\n\n")[0] for f in functions]
    return " ".join(" ".join(doc.split()) for doc in docs if doc)


def first_line(model: Model) -> str:
    """The first line of a model's docstring."""
    return model.doc.strip().partition("\n")[0] or "-"


def ranges(model: Model) -> list[str]:
    """'albedo=0.8 in [0, 1]' for every parameter."""
    defaults = model.Params._field_defaults  # type: ignore[attr-defined]
    found = []
    for name in model.Params._fields:  # type: ignore[attr-defined]
        text = f"{name}={_shown(defaults[name])}" if name in defaults else name
        if name in model.domain:
            low, high = model.domain[name]
            text += f" in [{low:g}, {high:g}]"
        found.append(text)
    return found


def _shown(default: Any) -> str:
    """0.8, or a colour as -p takes it."""
    return "/".join(f"{v:g}" for v in (default if isinstance(default, tuple) else [default]))


def reference_kind(model: Model) -> str:
    """Where the expected albedo of a model is from."""
    if model.albedo:
        return "declared in its file"
    if not (model.built_in and references.find(model.name)):
        return "none"
    truth = references.albedo(
        model.name, 0.5, **model.parameters()._asdict(), **model.picks
    )
    return truth.kind if truth else "none"
