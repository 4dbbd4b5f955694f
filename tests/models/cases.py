"""What the tests of models run over: every file of the folder, with each of its choices."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.loading import load, names
from montecarlo_brdf.model import Model
from montecarlo_brdf.vectors import from_degrees, mirrored

LAST = math.nextafter(90.0, 0.0)  # degrees: cos = 2.5e-16
THETAS = (0.0, 1e-6, 30.0, 60.0, 85.0, 89.9999, LAST)
PHIS = (0.0, 1e-9, 90.0, 133.0, 180.0)


def variants() -> Iterator[Any]:
    """Each model as it comes, then with each other option of each of its choices, one at a time."""
    for name in names():
        model = load(name)
        yield name, {}
        for category, options in model.choices.items():
            for pick in list(options)[1:]:
                yield name, {category: pick}


VARIANTS = list(variants())
IDS = ["-".join((name, *picks.values())) for name, picks in VARIANTS]


def made(variant: Any) -> Model:
    name, picks = variant
    return load(name, **picks)


def corners(model: Model) -> list[Any]:
    """The default and every corner of the domain, and what the file lists as verified."""
    ends = [model.domain[n] for n in model.Params._fields]
    sets = [model.Params(), *(model.Params(*c) for c in itertools.product(*ends))]
    return sets + list(() if model.choices else model.verified)


def usual(model: Model) -> list[Any]:
    """The parameter sets that the file lists as verified, or the default."""
    return list(model.verified) if model.verified and not model.choices else [model.Params()]


def edge_pairs() -> tuple[Any, Any]:
    """(wo, wi) at every pair of edge angles; wi = wo and wi = mirror are among them."""
    pairs = [
        (from_degrees(o), from_degrees(i, phi))
        for o, i, phi in itertools.product(THETAS, THETAS, PHIS)
    ]
    each = [from_degrees(t, 20.0) for t in THETAS]
    exact = [(w, s) for w in each for s in (w, mirrored(w))]
    wo, wi = zip(*pairs, *exact, strict=True)
    return np.array(wo), np.array(wi)


def random_directions(rng: Any, count: int) -> Any:
    """Uniform over the hemisphere."""
    z, phi = rng.random(count), 2.0 * np.pi * rng.random(count)
    s = np.sqrt((1.0 - z) * (1.0 + z))
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=1)
