"""Rows of rectangular cells, in each of which a function is the polynomial through some nodes."""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.estimate.tree import Array, Flags, Places

TAIL = 2  # coefficients of the highest degrees, which tell along which side a cell is rough
CORNER = 1.0 - 1e-9  # f need not be finite at the very ends of a region
LITTLE = 0.1  # of f's variance in a cell: a polynomial that leaves more than that is of no use


class Rule(NamedTuple):
    """A rule on the unit square: nodes (n n, 2), weights, and the matrix from values along a side
    to coefficients of Legendre's polynomials."""

    nodes: Array
    weight: Array
    coefficients: Array


def _rule(nodes: NDArray[Any]) -> Rule:
    """The rule that integrates the polynomials through some nodes in (-1, 1) on each side."""
    made = np.linalg.inv(np.polynomial.legendre.legvander(nodes, len(nodes) - 1))
    side = 0.5 * (nodes + 1.0)
    return Rule(products(side, side), np.outer(made[0], made[0]).ravel(), made)


@functools.cache
def gauss(n: int) -> Rule:
    return _rule(np.polynomial.legendre.leggauss(n)[0])


@functools.cache
def lobatto(n: int) -> Rule:
    """With nodes in the corners, which a step that cuts a cell parts."""
    inner = np.polynomial.legendre.Legendre.basis(n - 1).deriv().roots().real
    return _rule(np.array([-CORNER, *np.sort(inner), CORNER]))


class Cells(NamedTuple):
    """Rows of cells: where they begin and end, their integrals by two rules, and their polynomials:
    coefficients of Legendre's, (n, fine, fine)."""

    low: Array
    size: Array
    fine: Array
    coarse: Array
    polynomial: Array

    def part(self, which: Flags) -> Cells:
        """Some of them."""
        return Cells(*(column[which] for column in self))

    def joined(self, others: Cells) -> Cells:
        """All of both."""
        return Cells(*(np.concatenate(pair) for pair in zip(self, others, strict=True)))

    def at(self, places: Array, cell: Places) -> Array:
        """The polynomials at places (m, 2), each in the cell given."""
        n = self.polynomial.shape[1]
        inside = 2.0 * (places - self.low[cell]) / self.size[cell] - 1.0
        x, y = (np.polynomial.legendre.legvander(side, n - 1) for side in inside.T)
        found: Array = np.einsum("mi,mij,mj->m", x, self.polynomial[cell], y, optimize=True)
        return found

    def flattened(self, spread: Array, scale: float) -> Cells:
        """With no more than their means where polynomials leave most of what f varies by, as where
        it has steps; spread: the standard deviation that they leave, times the cells' sizes, in
        units of `scale`, as squares of large or small values are no numbers."""
        degree = 2.0 * np.arange(self.polynomial.shape[1]) + 1.0
        square = (self.polynomial / scale) ** 2 / np.outer(degree, degree)
        square[:, 0, 0] = 0.0
        useless = (spread / self.size.prod(axis=1)) ** 2 > LITTLE * square.sum(axis=(1, 2))
        flat = self.polynomial.copy()
        flat[useless] *= np.eye(1, flat[0].size).reshape(flat[0].shape)
        return self._replace(polynomial=flat)

    @property
    def tails(self) -> Array:
        """(n, 2): what the highest degrees along either side make of the polynomials at most."""
        size = np.abs(self.polynomial)
        along = size[:, -TAIL:, :].sum(axis=(1, 2)), size[:, :, -TAIL:].sum(axis=(1, 2))
        return np.stack(along, axis=1)


def products(x: Array, y: Array) -> Array:
    """All pairs, (n, 2)."""
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)


def halves(
    low: Array, size: Array, halved: Flags, side: int, origin: Places
) -> tuple[Array, Array, Places]:
    """The cells with some halved along a side, the halves one after the other."""
    parent = np.repeat(np.arange(len(low)), 1 + halved)
    second = np.concatenate([[False], parent[1:] == parent[:-1]])
    low, size, origin = low[parent], size[parent], origin[parent]
    size[halved[parent], side] *= 0.5
    low[second, side] += size[second, side]
    return low, size, origin
