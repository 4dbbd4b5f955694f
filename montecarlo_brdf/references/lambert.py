"""Lambert: f = albedo/pi, so A = albedo exactly, at every angle. Lambert, Photometria (1760)."""

from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True
SOURCE = "A = albedo (Lambert 1760)"


def albedo(cos_theta_o: float, *, albedo: float) -> Truth:
    return closed_form(albedo, SOURCE)


def bihemispherical(*, albedo: float) -> Truth:
    return closed_form(albedo, SOURCE)
