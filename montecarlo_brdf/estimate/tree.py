"""Cells that were made by halving others, found again by comparing one number at a time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]

#: side that is compared (LEAF: none), with what, and the nodes of what lies below and from there on
WIDTH = 4
LEAF = -1.0


class Tree:
    """Nodes of a tree over cells in rows and columns, as rows of WIDTH numbers."""

    def __init__(self, x: Array, y: Array) -> None:
        self.nodes = np.empty((0, WIDTH))
        #: the nodes of all cells, rows of y for one x after the other
        self.first = np.zeros((len(x) - 1, len(y) - 1), dtype=int)
        self._divide(self._new(1)[0], (x, y), self.first)

    def _new(self, many: int) -> Places:
        found = len(self.nodes) + np.arange(many)
        self.nodes = np.concatenate([self.nodes, np.full((many, WIDTH), LEAF)])
        return found

    def _divide(self, node: int, edges: Sequence[Array], cells: Places) -> None:
        """Nodes below one for the cells between some edges, which are written into `cells`."""
        if cells.size == 1:
            cells[0, 0] = node
            return
        side = int(cells.shape[0] == 1)
        middle = cells.shape[side] // 2
        below, above = self._new(2)
        self.nodes[node] = side, edges[side][middle], below, above
        for child, part in ((below, slice(None, middle)), (above, slice(middle, None))):
            reach = slice(part.start, None if part.stop is None else part.stop + 1)
            inner = [e[reach] if k == side else e for k, e in enumerate(edges)]
            self._divide(int(child), inner, cells[part] if side == 0 else cells[:, part])

    def halved(self, node: Places, which: Flags, side: int, middle: Array) -> Places:
        """The nodes of cells some of which are halved along a side, the halves one after the
        other."""
        parents = node[which]
        children = self._new(2 * len(parents))
        sides = np.full(len(parents), side)
        below, above = children[::2], children[1::2]
        self.nodes[parents] = np.stack([sides, middle[which], below, above], axis=1)
        found = np.repeat(node, 1 + which)
        found[np.repeat(which, 1 + which)] = children
        return found
