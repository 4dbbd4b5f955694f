"""GGX with Schlick's masking mu/(mu (1-k) + k) and Fresnel; Karis, SIGGRAPH course 2013.

k = "direct": (sqrt(alpha) + 1)^2/8; k = "ibl": alpha/2.
"""

from montecarlo_brdf.references import cook_torrance
from montecarlo_brdf.references._truth import Truth

RECIPROCAL = True


def albedo(cos_theta_o: float, *, alpha: float, f0: float, k: str = "direct") -> Truth:
    return cook_torrance.albedo(cos_theta_o, masking=f"schlick_k_{k}", alpha=alpha, f0=f0)


def bihemispherical(*, alpha: float, f0: float, k: str = "direct") -> Truth:
    return cook_torrance.bihemispherical(masking=f"schlick_k_{k}", alpha=alpha, f0=f0)
