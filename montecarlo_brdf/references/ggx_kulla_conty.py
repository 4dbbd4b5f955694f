"""GGX with Kulla & Conty's compensation (SIGGRAPH course 2017), slides 14-20.

f = f_ss + c (1 - E(mu_i))(1 - E(mu_o))/(pi (1 - mean E)), c = Fa^2 mean E/(1 - Fa (1 - mean E)) and
Fa = f0 + (1 - f0)/21 the mean of Schlick's Fresnel, so A = A_ss + c (1 - E). f0 = 1: A = 1 exactly.
"""

from montecarlo_brdf.references import ggx
from montecarlo_brdf.references._ggx import mean_albedo, unit_albedo
from montecarlo_brdf.references._rules import independent
from montecarlo_brdf.references._truth import EPSILON, Truth, closed_form

RECIPROCAL = True
SOURCE = "A_ss + c (1 - E), both by quadrature"
EXACT = "1 by construction: E + (1 - E)"


def _colour(alpha: float, f0: float) -> float:
    fresnel, mean = f0 + (1.0 - f0) / 21.0, mean_albedo(alpha)[0]
    return fresnel * fresnel * mean / (1.0 - fresnel * (1.0 - mean))


def _compensated(single: Truth, unit: tuple[float, float], colour: float) -> Truth:
    # the colour is below 1 and moves at most as much as the mean of E, which E's bound covers
    error = single.error + 2.0 * unit[1] + 8.0 * EPSILON
    return independent((single.value + colour * (1.0 - unit[0]), error), SOURCE)


def albedo(cos_theta_o: float, *, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, EXACT)
    single = ggx.albedo(cos_theta_o, alpha=alpha, f0=f0)
    return _compensated(single, unit_albedo(cos_theta_o, alpha), _colour(alpha, f0))


def bihemispherical(*, alpha: float, f0: float) -> Truth:
    if f0 == 1.0:
        return closed_form(1.0, EXACT)
    single = ggx.bihemispherical(alpha=alpha, f0=f0)
    return _compensated(single, mean_albedo(alpha), _colour(alpha, f0))
