"""Closed forms of reflected radiance under skies that are not constant, for models that have one.

Under L = max(0, cos theta_i)^m: Minnaert 2 c mu^(k-1)/(k+1+m) (formula of A with one more power of
the cosine per m), and Phong seen from the normal ks (n+2)/(n+2+m).
"""

from typing import Any

from montecarlo_brdf.references._truth import Truth, closed_form


def cosine_sky(name: str, mu: float, m: float, **parameters: Any) -> Truth | None:
    """L_o under max(0, cos theta_i)^m around the normal; None where there is no closed form."""
    if name == "minnaert":
        k = parameters["k"]
        value = 2.0 * parameters["albedo"] * mu ** (k - 1.0) / (k + 1.0 + m)
        return closed_form(value, "Minnaert under a power of the cosine", condition=abs(k - 1.0))
    if name == "phong" and mu == 1.0:
        n = parameters["n"]
        value = parameters["ks"] * (n + 2.0) / (n + 2.0 + m)
        return closed_form(value, "Phong at the normal under a power of the cosine")
    return None
