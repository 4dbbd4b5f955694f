"""Disney/Burley diffuse: f = albedo/pi (1 + X (1-mu_i)^5)(1 + X (1-mu_o)^5).

X = F_D90 - 1 = 2 roughness (h.v)^2 - 1/2.  Burley, SIGGRAPH course notes 2012, section 5.3. X is
linear in the directions, so A is an exact polynomial in mu_o, roughness r and s^2: no conditioning.
"""

from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True


def albedo(cos_theta_o: float, *, albedo: float, roughness: float) -> Truth:
    mu, r = cos_theta_o, roughness
    linear = 41.0 / 42.0 + r / 21.0 + r * mu / 84.0
    grazing = 2.0 * r * mu / 3.0 + r - 0.5 + 5.0 * r * r / 72.0 - r / 21.0 + 1.0 / 84.0
    grazing += r * mu * (r * (1.0 / 42.0 - mu / 56.0) - 1.0 / 84.0)
    value = albedo * (linear + (1.0 - mu) ** 5 * grazing)
    terms = albedo * (linear + 1.0 + r)
    return closed_form(value, "exact polynomial of Burley's diffuse (2012)", terms=terms)


def bihemispherical(*, albedo: float, roughness: float) -> Truth:
    r = roughness
    value = albedo * (1681.0 / 1764.0 + 767.0 * r / 7056.0 + 149.0 * r * r / 42336.0)
    return closed_form(value, "1681/1764 + 767 r/7056 + 149 r^2/42336")
