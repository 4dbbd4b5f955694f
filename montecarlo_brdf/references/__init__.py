"""The truth about every model that has one, from formulas and code that share nothing with it.

One file per model: `references/ggx.py` is the truth about `models/ggx.py`. A file offers

    albedo(cos_theta_o, *, <parameters and choices>) -> Truth          A(theta_o)
    reverse_albedo(cos_theta_i, *, ...) -> Truth                       R(theta_i), if not reciprocal
    bihemispherical(*, ...) -> Truth                                   2 * integral of A(mu) mu dmu
    RECIPROCAL = True                                                  where R is A

and nothing here is listed by hand: a new file in this folder is a new reference. The names with an
underscore are the machinery:

    _truth                           results, and how rounding is bounded
    _gamma, _phong, _oren_nayar      closed forms of special functions and of two families
    _fresnel, _microfacet            Fresnel reflectance; distributions and maskings in slopes
    _rules                           quadrature over one variable, and means over all views
    _quadrature, _kinks              albedos of isotropic formulas in half-vector slopes, and where
                                     panels must end
    _ggx                             albedo of GGX as an integral over one variable
    _irradiance                      closed forms under skies
    _sky                             the radiance of any f given as a function, under any sky

No file imports anything else of the package, and numpy and scipy are imported only when a function
needs them.
"""

import importlib
import pkgutil
from functools import cache
from types import ModuleType

from montecarlo_brdf.references._truth import Truth

__all__ = ["Truth", "albedo", "bihemispherical", "find", "names", "reverse_albedo"]


def names() -> list[str]:
    """Names of all models that have a reference."""
    return [m.name for m in pkgutil.iter_modules(__path__) if not m.name.startswith("_")]


@cache  # looking into the folder takes longer than most closed forms
def find(name: str) -> ModuleType | None:
    """The reference module of a model, or None if the model has no reference."""
    return importlib.import_module(f"{__name__}.{name}") if name in names() else None


def albedo(name: str, cos_theta_o: float, /, **parameters: object) -> Truth | None:
    """True directional-hemispherical albedo A(theta_o); None if the model offers none."""
    function = getattr(find(name), "albedo", None)
    return function and function(cos_theta_o, **parameters)


def reverse_albedo(name: str, cos_theta_i: float, /, **parameters: object) -> Truth | None:
    """True reverse albedo R(theta_i), which is A(theta_i) for a reciprocal model."""
    module = find(name)
    fallback = "albedo" if getattr(module, "RECIPROCAL", False) else ""
    function = getattr(module, "reverse_albedo", None) or getattr(module, fallback, None)
    return function and function(cos_theta_i, **parameters)


def bihemispherical(name: str, /, **parameters: object) -> Truth | None:
    """True albedo under uniform light from everywhere; None if the model offers none."""
    function = getattr(find(name), "bihemispherical", None)
    return function and function(**parameters)
