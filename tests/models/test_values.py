"""Values of f: against the table, at the edges of everything, compiled against plain Python."""

from __future__ import annotations

import itertools
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import IDS, VARIANTS, corners, edge_pairs, made, random_directions, usual

from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.loading import load
from montecarlo_brdf.vectors import from_degrees

sys.path.append(str(Path(__file__).parents[1] / "references"))
from reference_data import FILE, MODELS, _parameters  # noqa: E402

WO, WI = edge_pairs()


def table() -> list[Any]:
    entries = [e for e in json.loads(FILE.read_text()) if e["quantity"] == "brdf"]
    shipped = [e for e in entries if e["model"] != "mixture"]
    key = lambda e: (MODELS.get(e["model"], e["model"]), json.dumps(e["params"]))  # noqa: E731
    return [(k[0], list(g)) for k, g in itertools.groupby(sorted(shipped, key=key), key)]


@pytest.mark.parametrize(("name", "entries"), table())
def test_table(name: str, entries: Any) -> None:
    """1e-13: rounding the directions moves tan^2/alpha^2 by 20 eps at the narrowest lobe (0.1)."""
    given = _parameters(entries[0]["model"], entries[0]["params"])
    base = load(name)
    p = base.parameters(**given)
    model = base.of(p)
    for e in entries:
        wo = from_degrees(e["theta_o_deg"], e["phi_o_deg"])
        wi = from_degrees(e["theta_i_deg"], e["phi_i_deg"])
        assert model.f(wo, wi, model.prepared(p)) == pytest.approx(float(e["value"]), rel=1e-13)


@pytest.mark.parametrize("variant", VARIANTS, ids=IDS)
def test_finite_and_not_negative_at_the_edges(variant: Any) -> None:
    model = made(variant)
    for p in corners(model):
        values = Pointwise(model, p).f(WO, WI)
        assert np.all(np.isfinite(values)), (p, WO[~np.isfinite(values)], WI[~np.isfinite(values)])
        if "positivity" not in model.disclaims:
            assert np.min(values) >= 0.0, (p, WO[np.argmin(values)], WI[np.argmin(values)])


@pytest.mark.parametrize("variant", VARIANTS, ids=IDS)
def test_reciprocity(variant: Any) -> None:
    """Sums are formed in the same order from either side, up to products: a few roundings."""
    model = made(variant)
    rng = np.random.default_rng(4)
    for p in usual(model):
        point = Pointwise(model, p)
        a, b = random_directions(rng, 200), random_directions(rng, 200)
        there, back = point.f(a, b), point.f(b, a)
        symmetric = np.allclose(there, back, rtol=1e-12, atol=0.0)
        assert symmetric == ("reciprocity" not in model.disclaims)


@pytest.mark.parametrize("variant", VARIANTS, ids=IDS)
def test_compiled_is_plain(variant: Any) -> None:
    """Reassociation and fusing change roundings only: 40 of them, times |ln f| inside a power.

    |ln f| < 700, as below that f is 0: 40 * 700 * 2^-53 = 3e-12.
    """
    model = made(variant)
    rng = np.random.default_rng(5)
    wo, wi = random_directions(rng, 60), random_directions(rng, 60)
    wi[30:] = wo[30:] * [-1.0, -1.0, 1.0] + 1e-2 * rng.standard_normal((30, 3))
    wi[:, 2] = np.abs(wi[:, 2])
    wi /= np.linalg.norm(wi, axis=1)[:, None]
    for p in usual(model):
        prepared = model.prepared(p)
        pairs = zip(wo.tolist(), wi.tolist(), strict=True)
        plain = np.array([model.f(tuple(o), tuple(i), prepared) for o, i in pairs])
        scale = 1e-15 * np.max(np.abs(plain))  # where terms of either sign cancel
        assert np.allclose(Pointwise(model, p).f(wo, wi), plain, rtol=3e-12, atol=scale)
