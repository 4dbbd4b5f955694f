"""A file as of the MERL database with GGX in it: what readers can be held against.

    python scripts/merl_file.py ggx.binary [ALPHA [PLACE]]

PLACE: where in a bin its value is taken, 0.5 (default) in the middle, 0 at its edge. All three
channels are the same. Only NumPy is used, and no formula of the package.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SIZES = (90, 90, 180)
SCALES = (1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0)


def ggx(wo: Array, wi: Array, alpha: float) -> Array:
    """f without Fresnel, height-correlated masking: Walter et al. 2007, Heitz 2014."""
    h = wo + wi
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    a2 = alpha * alpha
    d = a2 / (np.pi * (h[..., 2] ** 2 * (a2 - 1.0) + 1.0) ** 2)
    o, i = wo[..., 2], wi[..., 2]
    lambdas = o * np.sqrt(i * i * (1.0 - a2) + a2) + i * np.sqrt(o * o * (1.0 - a2) + a2)
    return np.asarray(d * 0.5 / lambdas)


def directions(theta_h: Array, theta_d: Array, phi_d: Array) -> tuple[Array, Array]:
    """(wo, wi) of Rusinkiewicz' angles, phi_h = 0."""
    x, y = np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d)
    z, c, s = np.cos(theta_d), np.cos(theta_h), np.sin(theta_h)
    wi = np.stack([c * x + s * z, y, c * z - s * x], axis=-1)
    h = np.stack([s + 0.0 * z, 0.0 * y, c + 0.0 * z], axis=-1)
    return 2.0 * z[..., None] * h - wi, wi


def plane(alpha: float, place: float = 0.5) -> Array:
    """Values of one channel in 1/sr, -1 where a direction lies below the horizon."""
    i, j, k = ((np.arange(n) + place) / n for n in SIZES)
    grid = np.meshgrid(i * i * (np.pi / 2), j * (np.pi / 2), k * np.pi, indexing="ij")
    wo, wi = directions(*grid)
    above = (wo[..., 2] > 0.0) & (wi[..., 2] > 0.0)
    up = np.array([0.0, 0.0, 1.0])
    wo, wi = (np.where(above[..., None], w, up) for w in (wo, wi))
    return np.where(above, ggx(wo, wi, alpha), -1.0)


def content(alpha: float, place: float = 0.5) -> bytes:
    """The whole file."""
    values = plane(alpha, place)
    planes = [np.where(values < 0.0, -1.0, values / scale) for scale in SCALES]
    return np.array(SIZES, "<i4").tobytes() + b"".join(p.astype("<f8").tobytes() for p in planes)


if __name__ == "__main__":
    alpha, place = (float(x) for x in (*sys.argv[2:4], *("0.3", "0.5")[len(sys.argv) - 2 :]))
    Path(sys.argv[1]).write_bytes(content(alpha, place))
