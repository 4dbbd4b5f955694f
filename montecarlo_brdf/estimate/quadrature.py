"""Coordinates on the hemisphere of wi that follow the lobe: half-vector slope and azimuth.

With H = wi + wo, t = tan(theta_h) and azimuth phi_h against the plane of incidence, the horizon
mu_i = 0 is the curve t_max(phi) = T cos(phi) + sqrt(T^2 cos^2(phi) + 1), T = tan(theta_o). So

    x = log(1 + (t/s)^2) / log(1 + (t_max/s)^2),   b = phi_h/(2 pi),   (x, b) in [0, 1)^2

covers exactly the hemisphere, gives every scale from s to the horizon the same room, and turns a
lobe of any width into a smooth function. dw = 4 (h.v) cos^3(theta_h) t dt dphi (Walter et al.
2007).
"""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

import numpy as np

Array = Any
SMALLEST = 1e-7
#: A value so many times as large as any at the nodes around it belongs to what they have missed.
MISSED = 10.0
#: directions and the solid angle that each stands for
Probes = tuple[Array, Array]


class Coordinates:
    """The map between (x, b) and wi for a fixed wo; `scale` is the smallest slope of interest."""

    def __init__(self, wo: Array, scale: float) -> None:
        self.wo = np.asarray(wo, dtype=float)
        self.mu = float(self.wo[2])
        self.sine = float(np.hypot(self.wo[0], self.wo[1]))
        self.turn = self.wo[:2] / self.sine if self.sine > 0.0 else np.array([1.0, 0.0])
        self.scale = max(float(scale), SMALLEST)

    def horizon(self, cos_phi: Array) -> Array:
        """t_max, without cancellation on either side."""
        k = self.sine / self.mu * cos_phi
        root = np.abs(k) + np.sqrt(k * k + 1.0)
        return np.where(k >= 0.0, root, 1.0 / root)

    def directions(self, x: Array, b: Array) -> tuple[Array, Array]:
        """(wi, dw/dx db) for coordinates in (0, 1): wi has shape (n, 3)."""
        phi = 2.0 * np.pi * b
        cos_phi, sin_phi = np.cos(phi), np.sin(phi)
        t_max = self.horizon(cos_phi)
        s2 = self.scale**2
        span = np.log1p(t_max**2 / s2)
        t2 = s2 * np.expm1(x * span)
        t = np.sqrt(t2)
        to_horizon = s2 * np.exp(x * span) * np.expm1((1.0 - x) * span) / (t_max + t)
        hz = 1.0 / np.sqrt(1.0 + t2)
        hv = hz * (self.mu + self.sine * cos_phi * t)
        h = np.stack([t * cos_phi, t * sin_phi, np.ones_like(t)], axis=-1) * hz[..., None]
        wi = 2.0 * hv[..., None] * h - np.array([self.sine, 0.0, self.mu])
        wi[..., 2] = self.mu * to_horizon * (t + 1.0 / t_max) / (1.0 + t2)
        wi /= np.sqrt(np.sum(wi * wi, axis=-1))[..., None]
        jacobian = 4.0 * hv * hz**3 * 0.5 * s2 * np.exp(x * span) * span * 2.0 * np.pi
        return self._to_frame(wi), jacobian

    def coordinates(self, wi: Array) -> tuple[Array, Array]:
        """(x, b) of directions (n, 3) above the horizon."""
        h = np.asarray(wi) + self.wo
        along = h[:, 0] * self.turn[0] + h[:, 1] * self.turn[1]
        across = h[:, 1] * self.turn[0] - h[:, 0] * self.turn[1]
        slope = np.hypot(along, across)
        cos_phi = np.where(slope > 0.0, along / np.where(slope > 0.0, slope, 1.0), 1.0)
        span = np.log1p((self.horizon(cos_phi) / self.scale) ** 2)
        x = np.log1p((slope / h[:, 2] / self.scale) ** 2) / span
        return np.clip(x, 0.0, 1.0), np.mod(np.arctan2(across, along) / (2.0 * np.pi), 1.0)

    def _to_frame(self, w: Array) -> Array:
        """From the plane of incidence back to the azimuth of wo."""
        c, s = self.turn
        turned = w.copy()
        turned[..., 0] = c * w[..., 0] - s * w[..., 1]
        turned[..., 1] = s * w[..., 0] + c * w[..., 1]
        return turned


class Integral(NamedTuple):
    """A deterministic integral with an error estimate, and what of that lies where probes alone saw
    it."""

    value: float
    error: float
    missed: float = 0.0


def scale_of(wo: Array, wi: Array) -> float:
    """A slope below which few of the drawn directions lie."""
    h = np.asarray(wi) + np.asarray(wo)
    slopes = np.hypot(h[:, 0], h[:, 1]) / np.maximum(h[:, 2], 1e-300)
    if not len(slopes):
        return 1.0
    wide, sharp = np.quantile(slopes, (0.1, 1e-3))
    return float(min(0.3 * wide, 3.0 * sharp))  # differ where a sharp lobe is drawn now and then


@functools.lru_cache(maxsize=8)
def grid(nx: int, nb: int) -> tuple[Array, Array, Array]:
    """Gauss-Legendre in x, midpoints in b: nodes and weights, flattened."""
    node, weight = np.polynomial.legendre.leggauss(nx)
    b = (np.arange(nb) + 0.5) / nb
    x, bb = np.meshgrid(0.5 * (node + 1.0), b, indexing="ij")
    w = np.repeat(0.5 * weight / nb, nb)
    return x.ravel(), bb.ravel(), w


SIZES = ((24, 16), (48, 32), (96, 64), (128, 256), (192, 768))


def integrate(
    function: Any, coordinates: Coordinates, target: float = 1e-6, probes: tuple[Probes, ...] = ()
) -> Integral:
    """Integral of function(wi) over the hemisphere; nodes grow until two sizes agree.

    The error is the difference between the last two sizes: of the coarser one, so it errs on the
    safe side for an integrand that is resolved at all. Where two sizes agree because both miss a
    lobe, `probes` may see it: what they say that it holds is then the error.
    """
    last, error = np.nan, np.inf
    for nx, nb in SIZES:
        x, b, w = grid(nx, nb)
        wi, jacobian = coordinates.directions(x, b)
        values = function(wi)
        value = float(np.sum(w * jacobian * values))
        error = abs(value - last)
        if error <= target * abs(value):
            break
        last = value
    error = error if np.isfinite(error) else abs(value)
    highest = _highest_around(np.abs(values).reshape(nx, nb))
    place = coordinates, x.reshape(nx, nb)[:, 0], highest
    missed = max((_missed(function, probe, *place) for probe in probes), default=0.0)
    return Integral(value, max(error, missed) + 1e-14 * abs(value), missed)


def _highest_around(values: Array) -> Array:
    """Of every node and its eight neighbours the highest; b goes around."""
    b = np.maximum(values, np.maximum(np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)))
    padded = np.pad(b, ((1, 1), (0, 0)), mode="edge")
    return np.maximum(b, np.maximum(padded[:-2], padded[2:]))


def _missed(
    function: Any, probe: Probes, coordinates: Coordinates, nodes: Array, highest: Array
) -> float:
    """The integral of what is far above the values at the nodes around it."""
    wi, angle = probe
    if not len(wi):
        return 0.0
    values = np.abs(function(wi))
    x, b = coordinates.coordinates(wi)
    i = np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), x)
    j = np.minimum((b * highest.shape[1]).astype(int), highest.shape[1] - 1)
    return float(np.sum((values * angle)[values > MISSED * highest[i, j]]))
