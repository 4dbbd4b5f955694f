"""Energy-preserving Oren-Nayar (EON): FON plus what it loses, returned as a multiple scattering.

f = f_FON + albedo_ms/pi (1 - E(mu_i))(1 - E(mu_o))/(1 - mean E), so
A = albedo E + albedo_ms (1 - E).  Portsmouth, Kutz & Hill, JCGT 14(1) 2025, eqs. 14-18.
White (albedo = 1) reflects exactly 1; roughness 0 is Lambert.
"""

from montecarlo_brdf.references._truth import Truth, closed_form
from montecarlo_brdf.references.fon import unit_albedo, unit_mean

RECIPROCAL = True


def _multiple(albedo: float, roughness: float) -> float:
    mean = unit_mean(roughness)
    return albedo * albedo * mean / (1.0 - albedo * (1.0 - mean))


def albedo(cos_theta_o: float, *, albedo: float, roughness: float) -> Truth:
    single = unit_albedo(cos_theta_o, roughness)
    value = albedo * single + _multiple(albedo, roughness) * (1.0 - single)
    return closed_form(value, "A = albedo E_F + albedo_ms (1 - E_F), EON paper", terms=albedo)


def bihemispherical(*, albedo: float, roughness: float) -> Truth:
    single = unit_mean(roughness)
    value = albedo * single + _multiple(albedo, roughness) * (1.0 - single)
    return closed_form(value, "albedo mean E_F + albedo_ms (1 - mean E_F)", terms=albedo)
