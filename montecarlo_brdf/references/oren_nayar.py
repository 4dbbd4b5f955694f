"""The Oren-Nayar family, all members of which share one integral.

Each is a constant plus a multiple of si so max(0, cos dphi)/max(mu_i, mu_o), whose cosine-weighted
integral over the hemisphere is

    G(theta) = s (theta - s mu) + (2/3)(s/mu)(1 - s^3),    0 at the normal, pi/2 at grazing.

Near grazing (1 - s^3)/mu is a quotient of small numbers; mu (1 + s + s^2)/(1 + s) is the same.
Fujii's members divide by 1 instead of max(mu_i, mu_o) where cos dphi < 0: G_F = G - (2/3) s.

oren_nayar         qualitative: f = albedo/pi (A1 + B max(0, cos dphi) sin a tan b). Oren & Nayar,
                   SIGGRAPH 1994, eq. 30. A = albedo (A1 + B G(theta_o)/pi).
fujii_qualitative  f = albedo/pi (A + B s/t), s = wi.wo - mu_i mu_o, t = max(mu_i, mu_o) if s > 0
                   else 1, with the interreflection of Oren & Nayar folded into
                   A = A1 + 0.17 albedo sigma^2/(sigma^2 + 0.13). Fujii, "A tiny improvement of
                   Oren-Nayar", 2012.
fon                the footnote version: f = albedo/pi A_F (1 + r s/t), roughness r,
                   A_F = 1/(1 + (1/2 - 2/(3 pi)) r). Fujii 2012; Portsmouth, Kutz & Hill, JCGT
                   14(1) 2025, eqs. 5-12. E_F = A_F (1 + r G_F/pi), exactly 1 at grazing.
eon                FON plus what it loses, returned as a multiple scattering: f = f_FON +
                   albedo_ms/pi (1 - E(mu_i))(1 - E(mu_o))/(1 - mean E), so A = albedo E +
                   albedo_ms (1 - E). The same paper, eqs. 14-18. White (albedo = 1) reflects
                   exactly 1; roughness 0 is Lambert.

Well conditioned at every angle. The full model is in `oren_nayar_full`.
"""

import math

from montecarlo_brdf.references._truth import Albedos, Truth, closed_form, sine

MEAN_G = 2.0 / 3.0 - 64.0 / (45.0 * math.pi)  # (1/pi) times the bihemispherical mean of G
MEAN_G_FUJII = 2.0 / 3.0 - 28.0 / (15.0 * math.pi)


def g_qualitative(mu: float) -> float:
    s = sine(mu)
    cap = mu * (1.0 + s + s * s) / (1.0 + s)
    return s * (math.atan2(s, mu) - s * mu) + 2.0 / 3.0 * s * cap


def g_fujii(mu: float) -> float:
    return g_qualitative(mu) - 2.0 / 3.0 * sine(mu)


def constants(sigma: float) -> tuple[float, float]:
    """A1 and B of Oren & Nayar 1994; sigma is the standard deviation of the slope angle, rad."""
    variance = sigma * sigma
    return 1.0 - variance / (2.0 * (variance + 0.33)), 0.45 * variance / (variance + 0.09)


def _qualitative(mu: float, *, albedo: float, sigma: float) -> Truth:
    a, b = constants(sigma)
    value = albedo * (a + b / math.pi * g_qualitative(mu))
    return closed_form(value, "A = albedo (A1 + B G(theta_o)/pi), Oren-Nayar 1994 integrated")


def _mean_qualitative(*, albedo: float, sigma: float) -> Truth:
    a, b = constants(sigma)
    return closed_form(albedo * (a + b * MEAN_G), "albedo (A1 + B (2/3 - 64/(45 pi)))")


def _fujii_constants(albedo: float, sigma: float) -> tuple[float, float]:
    a, b = constants(sigma)
    return a + 0.17 * albedo * sigma * sigma / (sigma * sigma + 0.13), b


def _fujii(mu: float, *, albedo: float, sigma: float) -> Truth:
    a, b = _fujii_constants(albedo, sigma)
    value = albedo * (a + b / math.pi * g_fujii(mu))
    terms = albedo * (a + b)
    return closed_form(value, "A = albedo (A + B G_F(theta_o)/pi), Fujii 2012", terms=terms)


def _mean_fujii(*, albedo: float, sigma: float) -> Truth:
    a, b = _fujii_constants(albedo, sigma)
    value = albedo * (a + b * MEAN_G_FUJII)
    return closed_form(value, "albedo (A + B (2/3 - 28/(15 pi)))", terms=albedo * (a + b))


def _unit_scale(roughness: float) -> float:
    return 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


def _unit(mu: float, roughness: float) -> float:
    """E_F: the albedo of a white surface."""
    return _unit_scale(roughness) * (1.0 + roughness / math.pi * g_fujii(mu))


def _unit_mean(roughness: float) -> float:
    """The bihemispherical mean of E_F."""
    return _unit_scale(roughness) * (1.0 + MEAN_G_FUJII * roughness)


def _fon(mu: float, *, albedo: float, roughness: float) -> Truth:
    value = albedo * _unit(mu, roughness)
    return closed_form(value, "A = albedo A_F (1 + r G_F/pi), EON paper 2025", terms=albedo)


def _mean_fon(*, albedo: float, roughness: float) -> Truth:
    value = albedo * _unit_mean(roughness)
    return closed_form(value, "albedo A_F (1 + (2/3 - 28/(15 pi)) r)", terms=albedo)


def _multiplied(single: float, albedo: float, roughness: float) -> float:
    """albedo E + albedo_ms (1 - E)."""
    mean = _unit_mean(roughness)
    multiple = albedo * albedo * mean / (1.0 - albedo * (1.0 - mean))
    return albedo * single + multiple * (1.0 - single)


def _eon(mu: float, *, albedo: float, roughness: float) -> Truth:
    value = _multiplied(_unit(mu, roughness), albedo, roughness)
    return closed_form(value, "A = albedo E_F + albedo_ms (1 - E_F), EON paper", terms=albedo)


def _mean_eon(*, albedo: float, roughness: float) -> Truth:
    value = _multiplied(_unit_mean(roughness), albedo, roughness)
    return closed_form(value, "albedo mean E_F + albedo_ms (1 - mean E_F)", terms=albedo)


oren_nayar = Albedos(_qualitative, _mean_qualitative)
fujii_qualitative = Albedos(_fujii, _mean_fujii)
fon = Albedos(_fon, _mean_fon)
eon = Albedos(_eon, _mean_eon)
