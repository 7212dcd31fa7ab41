# SPDX-License-Identifier: MIT
"""Packed tree of boxes, joined level by level with whole-array steps.

Boxes are sorted along a Z-order curve and packed four to a node, bottom up. A join holds a list of node pairs, replaces
it by the pairs of their children and keeps those whose boxes are near. Long lists are split, so that memory is bounded
whatever the drawing is like.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Index, Reals

_FANOUT = 4
#: points looked at to tell the bulk of a drawing from what lies far outside
_SAMPLE = 1000
#: pairs of boxes tested in one step: 2**21 pairs take about 100 MB
_CHUNK = 2**21


class BoxTree:
    """n axis-parallel boxes.

    Parameters
    ----------
    low, high : (n, 2) float
        Opposite corners. Boxes may be points.
    """

    def __init__(self, low: Reals, high: Reals) -> None:
        self._order = np.argsort(z_order(low / 2 + high / 2), kind="stable")
        self._levels: list[tuple[Reals, Reals, Reals, Reals]] = []
        columns = [low[self._order, 0], low[self._order, 1], high[self._order, 0], high[self._order, 1]]
        while True:
            rest = -len(columns[0]) % _FANOUT or (_FANOUT if not len(columns[0]) else 0)
            # A box that is empty is near nothing.
            columns = [
                np.concatenate([column, np.full(rest, empty)])
                for column, empty in zip(columns, (np.inf, np.inf, -np.inf, -np.inf), strict=True)
            ]
            self._levels.append((columns[0], columns[1], columns[2], columns[3]))
            if len(columns[0]) == _FANOUT:
                break
            grouped = [column.reshape(-1, _FANOUT) for column in columns]
            columns = [group.min(axis=1) for group in grouped[:2]] + [group.max(axis=1) for group in grouped[2:]]

    def __len__(self) -> int:
        return len(self._order)

    def pairs(self, *, distance: float) -> Iterator[tuple[Index, Index]]:
        """Pairs of boxes that are near in both axes.

        Parameters
        ----------
        distance : float
            Greatest gap along either axis.

        Yields
        ------
        i, j : (k,) int
            Rows of the boxes; every unordered pair once, in no particular order, in chunks.
        """
        root = np.zeros(1, dtype=np.intp)
        stack = [(len(self._levels) - 1, root, root)]
        most = _CHUNK // _FANOUT**2
        brood = np.arange(_FANOUT)
        while stack:
            level, a, b = stack.pop()
            if len(a) > most:
                stack.extend((level, a[k : k + most], b[k : k + most]) for k in range(0, len(a), most))
                continue
            i = np.repeat(a[:, None] * _FANOUT + brood, _FANOUT, axis=1).ravel()
            j = np.tile(b[:, None] * _FANOUT + brood, (1, _FANOUT)).ravel()
            kept = np.flatnonzero(i < j if level == 0 else i <= j)
            i, j = i[kept], j[kept]
            x0, y0, x1, y1 = self._levels[level]
            for low, high in ((x0, x1), (y0, y1)):
                kept = np.flatnonzero((low[i] <= high[j] + distance) & (low[j] <= high[i] + distance))
                i, j = i[kept], j[kept]
            if level:
                stack.append((level - 1, i, j))
            elif len(i):
                yield self._order[i], self._order[j]

    def query(self, low: Reals, high: Reals, *, distance: float) -> Iterator[tuple[Index, Index]]:
        """Boxes of the tree near given boxes.

        Parameters
        ----------
        low, high : (q, 2) float
        distance : float
            Greatest gap along either axis.

        Yields
        ------
        asked, i : (k,) int
            Row of the given box, row of the box in the tree. All pairs of one given box come in the same chunk.
        """
        ahead = np.arange(len(low))
        # Neighbours are asked together: the memory they touch is the same.
        ahead = ahead[np.argsort(z_order(low / 2 + high / 2), kind="stable")] if len(ahead) else ahead
        stack = [ahead[k : k + _CHUNK // 8] for k in range(0, len(ahead), _CHUNK // 8)][::-1]
        brood = np.arange(_FANOUT)
        while stack:
            block = stack.pop()
            asked, node = block, np.zeros(len(block), dtype=np.intp)
            for level in range(len(self._levels) - 1, -1, -1):
                if len(asked) * _FANOUT > _CHUNK and len(block) > 1:
                    stack.extend([block[len(block) // 2 :], block[: len(block) // 2]])
                    break
                asked = np.repeat(asked, _FANOUT)
                node = (node[:, None] * _FANOUT + brood).ravel()
                x0, y0, x1, y1 = self._levels[level]
                for axis, (least, most) in enumerate(((x0, x1), (y0, y1))):
                    near = (least[node] <= high[asked, axis] + distance) & (low[asked, axis] <= most[node] + distance)
                    kept = np.flatnonzero(near)
                    asked, node = asked[kept], node[kept]
            else:
                if len(asked):
                    yield asked, self._order[node]


def z_order(points: Reals) -> NDArray[np.uint64]:
    """Place of points (n, 2) along a Z-order curve of 2**31 cells a side."""
    if not len(points):
        return np.zeros(0, dtype=np.uint64)
    # What lies far outside of the bulk shares its border cells, and takes no fineness from it.
    few = np.sort(points[:: max(1, len(points) // _SAMPLE)], axis=0)
    tenth = len(few) // 10
    low, high = few[tenth], few[-1 - tenth]
    low, high = low - 4 * (high - low), high + 4 * (high - low)
    low, high = np.maximum(low, points.min(axis=0)), np.minimum(high, points.max(axis=0))
    side = float((high - low).max()) or 1.0
    cells = ((np.clip(points, low, high) - low) * ((2**31 - 1) / side)).astype(np.uint64)
    return _spread(cells[:, 0]) | (_spread(cells[:, 1]) << np.uint64(1))


def _spread(cells: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Bits of 32-bit numbers moved apart to every second place of 64."""
    for shift, mask in (
        (16, 0x0000FFFF0000FFFF), (8, 0x00FF00FF00FF00FF), (4, 0x0F0F0F0F0F0F0F0F),
        (2, 0x3333333333333333), (1, 0x5555555555555555),
    ):  # fmt: skip
        cells = (cells | (cells << np.uint64(shift))) & np.uint64(mask)
    return cells
