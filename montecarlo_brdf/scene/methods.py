"""How a lobe under a sky is best sampled, and which of its parameters only scales it."""

from __future__ import annotations

from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.surface import ignores_directions

WIDE = 0.1  # share of a cap's solid angle that a lobe must fill to be sampled by the cap alone


def unscaled(model: Model, p: ParameterSet) -> tuple[ParameterSet, float]:
    """The parameter set with its scale taken out, and the scale: f is proportional to it."""
    name = model.scales_with
    if not name:
        return p, 1.0
    return p._replace(**{name: 1.0}), float(getattr(p, name))


def method_of(model: Model, p: ParameterSet, shape: skies.Shape) -> str:
    """The sampler for a lobe under a sky: the cheapest that sees both."""
    if ignores_directions(model):
        constant = isinstance(shape, skies.Constant)
        return "one value" if constant else "sky" if skies.concentrated(shape) else "cosine"
    if isinstance(shape, skies.Cap) and _covers(model, p, shape):
        return "sky"  # no sample meets the cap's edge, where the mixture's integrand jumps
    if skies.concentrated(shape):
        return "mixed" if model.sample and model.pdf else "sky"
    return "own" if model.sample else "cosine"


def _covers(model: Model, p: ParameterSet, shape: skies.Cap) -> bool:
    """Whether a lobe is wide enough for uniform samples of a cap to see all of it."""
    if model.lobe is None:
        return True
    width = 2.0 * float(model.lobe[1](p))  # half vectors turn half as fast as directions
    return width * width > WIDE * shape.depth
