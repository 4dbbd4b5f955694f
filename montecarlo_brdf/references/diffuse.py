"""Diffuse surfaces whose albedos are elementary.

lambert               f = albedo/pi, so A = albedo exactly, at every angle. Lambert 1760.
lambert_unnormalised  f = c, the division by pi forgotten, so A = pi c.
lommel_seeliger       f = albedo/(2 pi (mu_i + mu_o)). Seeliger 1884; Hapke 2012, eq. 8.35. With
                      albedo 1 it is GGX with alpha = 1, F = 1 and height-correlated masking.
                      Well conditioned everywhere: the difference is never below 0.3.
minnaert              f = (albedo/pi) (mu_i mu_o)^(k-1). Minnaert, Astrophys. J. 93 (1941).
disney_diffuse        f = albedo/pi (1 + X (1-mu_i)^5)(1 + X (1-mu_o)^5), X = F_D90 - 1 =
                      2 roughness (h.v)^2 - 1/2. Burley, SIGGRAPH course notes 2012, section 5.3.
                      X is linear in the directions, so A is an exact polynomial in mu_o,
                      roughness r and s^2: no conditioning.

Conditioning of Minnaert: a relative change of mu_o changes A by |k-1| times as much. That is
harmless for the cosine itself, but an angle in radians near 90 degrees loses digits when its cosine
is taken (1e-16/mu_o relative): take sin(90 degrees - theta) instead.
"""

import math

from montecarlo_brdf.references._truth import Albedos, Truth, closed_form

LAMBERT = "A = albedo (Lambert 1760)"
lambert = Albedos(
    lambda mu, *, albedo: closed_form(albedo, LAMBERT),
    lambda *, albedo: closed_form(albedo, LAMBERT),
)
lambert_unnormalised = Albedos(
    lambda mu, *, c: closed_form(math.pi * c, "A = pi c"),
    lambda *, c: closed_form(math.pi * c, "A = pi c"),
)


def _lommel_seeliger(mu: float, *, albedo: float) -> Truth:
    tail = mu * math.log1p(1.0 / mu) if mu > 0.0 else 0.0
    source = "A = albedo (1 - mu_o ln(1 + 1/mu_o))"
    return closed_form(albedo * (1.0 - tail), source, terms=albedo)


def _mean_lommel_seeliger(*, albedo: float) -> Truth:
    value = albedo * 4.0 / 3.0 * (1.0 - math.log(2.0))
    return closed_form(value, "albedo (4/3)(1 - ln 2)", terms=albedo)


def _minnaert(mu: float, *, albedo: float, k: float) -> Truth:
    """For k > -1; for k < 1 A is infinite at mu_o = 0."""
    source = "A = 2 albedo mu_o^(k-1)/(k+1) (Minnaert 1941, integrated)"
    if k <= -1.0 or (mu == 0.0 and k < 1.0):
        return Truth(math.inf if albedo else 0.0, 0.0, "closed form", source)
    value = 2.0 * albedo * mu ** (k - 1.0) / (k + 1.0)
    # k-1 is rounded, and its error is multiplied by the logarithm of the cosine
    slack = abs(k - 1.0) + abs(math.log(mu or 1.0)) * (1.0 + abs(k))
    return closed_form(value, source, condition=slack)


def _mean_minnaert(*, albedo: float, k: float) -> Truth:
    source = "4 albedo/(k+1)^2"
    if k <= -1.0:
        return Truth(math.inf if albedo else 0.0, 0.0, "closed form", source)
    return closed_form(4.0 * albedo / (k + 1.0) ** 2, source)


def _disney(mu: float, *, albedo: float, roughness: float) -> Truth:
    r = roughness
    linear = 41.0 / 42.0 + r / 21.0 + r * mu / 84.0
    grazing = 2.0 * r * mu / 3.0 + r - 0.5 + 5.0 * r * r / 72.0 - r / 21.0 + 1.0 / 84.0
    grazing += r * mu * (r * (1.0 / 42.0 - mu / 56.0) - 1.0 / 84.0)
    value = albedo * (linear + (1.0 - mu) ** 5 * grazing)
    terms = albedo * (linear + 1.0 + r)
    return closed_form(value, "exact polynomial of Burley's diffuse (2012)", terms=terms)


def _mean_disney(*, albedo: float, roughness: float) -> Truth:
    r = roughness
    value = albedo * (1681.0 / 1764.0 + 767.0 * r / 7056.0 + 149.0 * r * r / 42336.0)
    return closed_form(value, "1681/1764 + 767 r/7056 + 149 r^2/42336")


lommel_seeliger = Albedos(_lommel_seeliger, _mean_lommel_seeliger)
minnaert = Albedos(_minnaert, _mean_minnaert)
disney_diffuse = Albedos(_disney, _mean_disney)
