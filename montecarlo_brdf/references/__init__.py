"""The truth about every model that has one, from formulas and code that share nothing with it.

A reference offers

    albedo(cos_theta_o, *, <parameters and choices>) -> Truth          A(theta_o)
    bihemispherical(*, ...) -> Truth                                   2 * integral of A(mu) mu dmu
    reverse_albedo(cos_theta_i, *, ...) -> Truth                       R(theta_i), if not reciprocal

and is a file with these functions, named after its model (a new file is a new reference), or one
`Albedos` of the file of its family (`FAMILIES`). The names with an underscore are the
machinery:

    _truth                           results, and how rounding is bounded
    _gamma, _phong                   closed forms of special functions and of Phong's lobe
    _microfacet                      distributions and maskings in slopes; Fresnel reflectance
    _rules                           quadrature over one variable, and means over all views
    _quadrature, _kinks              albedos of isotropic formulas in half-vector slopes, and where
                                     panels must end
    _ggx                             albedo of GGX as an integral over one variable
    _irradiance                      closed forms under skies

No file imports anything else of the package, and numpy and scipy are imported only when a function
needs them.
"""

import importlib
import pkgutil
from functools import cache
from types import ModuleType
from typing import cast

from montecarlo_brdf.references._truth import Albedos, Truth

__all__ = ["Truth", "albedo", "bihemispherical", "find", "names", "reverse_albedo"]


#: file -> the models whose references it holds
FAMILIES = {
    "diffuse": "lambert lambert_unnormalised lommel_seeliger minnaert disney_diffuse",
    "half_lobe": "ashikhmin_shirley blinn_phong ward",
    "microfacet": "beckmann cook_torrance ggx ggx_kulla_conty ggx_turquin kelemen_szirmay_kalos "
    "schlick_ggx",
    "oren_nayar": "eon fon fujii_qualitative oren_nayar",
    "phong": "lafortune_willems phong phong_original phong_unclamped phong_unnormalised",
}
FILES = {model: file for file, models in FAMILIES.items() for model in models.split()}


def names() -> list[str]:
    """Names of all models that have a reference."""
    files = {m.name for m in pkgutil.iter_modules(__path__) if not m.name.startswith("_")}
    return sorted((files - FAMILIES.keys()) | FILES.keys())


@cache  # looking into the folder takes longer than most closed forms
def find(name: str) -> Albedos | ModuleType | None:
    """The reference of a model, or None if the model has none."""
    if name not in names():
        return None
    module = importlib.import_module(f"{__name__}.{FILES.get(name, name)}")
    return cast(Albedos, vars(module)[name]) if name in FILES else module


def albedo(name: str, cos_theta_o: float, /, **parameters: object) -> Truth | None:
    """True directional-hemispherical albedo A(theta_o); None if the model offers none."""
    function = getattr(find(name), "albedo", None)
    return function and function(cos_theta_o, **parameters)


def reverse_albedo(name: str, cos_theta_i: float, /, **parameters: object) -> Truth | None:
    """True reverse albedo R(theta_i), which is A(theta_i) for a reciprocal model."""
    reference = find(name)
    function = getattr(reference, "reverse_albedo", None) or getattr(reference, "albedo", None)
    return function and function(cos_theta_i, **parameters)


def bihemispherical(name: str, /, **parameters: object) -> Truth | None:
    """True albedo under uniform light from everywhere; None if the model offers none."""
    function = getattr(find(name), "bihemispherical", None)
    return function and function(**parameters)
