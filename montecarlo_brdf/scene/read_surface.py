"""The [surface] of a scene file: a model, lobes, or the standard lighting equation."""

from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf import loading
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene.standard import FORMS, Standard
from montecarlo_brdf.scene.toml import Table


def read_surface(table: Table, parameters: dict[str, Any]) -> Any:
    """A Standard, or (weight, model, parameters) of every lobe, colours as written."""
    if "equation" in table.data:
        return _standard(table)
    if "lobes" in table.data:
        found = [(t.colour("weight", 1.0), *_model(t, {})) for t in table.tables("lobes")]
    else:
        found = [(table.colour("weight", 1.0), *_model(table, parameters))]
    table.done()
    return found


def _model(table: Table, parameters: dict[str, Any]) -> tuple[Any, Any]:
    """A model with the parameters that stand beside it."""
    try:
        model = loading.load(table.text_of("model"))
    except UserError as error:
        raise table.error(str(error), "model") from error
    own = table.table("parameters", {})
    picks = {
        c: source.text_of(c) for c in model.choices for source in (table, own) if c in source.data
    }
    try:
        model = model.variant(**picks) if picks else model
        given = _given(model, table, own)
        p = model.parameters(**{**given, **parameters})
    except UserError as error:
        if str(error).startswith(str(table.file)):
            raise
        key = next(
            (
                k
                for k in (*picks, *table.data)
                if f"{k} of model" in str(error) or f"no {k} " in str(error)
            ),
            "model",
        )
        raise table.error(str(error), key) from error
    own.done()
    if table.path[-1] != "surface":
        table.done()
    return model, p


def _given(model: Any, table: Table, own: Table) -> dict[str, Any]:
    """Parameters in the table itself or in its `parameters`."""
    names = [model.labels.get(n, n) for n in model.Params._fields]
    for source in (table, own):
        source.know(*names, *model.choices)
    found = ((n, source) for n in names for source in (table, own) if n in source.data)
    return {n: source.colour(n, low=-math.inf) for n, source in found}


def _standard(table: Table) -> Standard:
    table.choice("equation", ["standard"])
    ambient = table.colour("ambient") if "ambient" in table.data else None
    table.take("ambient", None)
    made: Any = Standard(
        diffuse=table.colour("diffuse"),  # type: ignore[arg-type]
        specular=table.colour("specular", 0.0),  # type: ignore[arg-type]
        gloss=table.number("gloss", 32.0, 0.0, 1e7),
        form=table.choice("form", FORMS, "phong"),
        ambient=ambient,  # type: ignore[arg-type]
        gloss_on_diffuse=table.flag("gloss_on_diffuse"),
    )
    table.done()
    return made
