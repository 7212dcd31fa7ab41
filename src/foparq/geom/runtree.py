# SPDX-License-Identifier: MIT
"""Boxes around runs of consecutive segments, a tree for every line by itself.

Pairs of segments of one line are found without a look at the other lines: fifty thousand copies of one line cost no
more than fifty thousand different ones.
"""

from collections.abc import Iterator

import numpy as np

from foparq.columns import Index, Reals
from foparq.geom.ragged import ragged

_FANOUT = 4
#: pairs of boxes tested in one step
_CHUNK = 2**20

_Level = tuple[Reals, Reals, Index, Index]


def pairs_of_runs(low: Reals, high: Reals, offsets: Index, *, distance: float) -> Iterator[tuple[Index, Index]]:
    """Pairs of boxes of one run that are near in both axes, but for neighbours.

    Parameters
    ----------
    low, high : (s, 2) float
        Opposite corners.
    offsets : (n + 1,) int
        Run r holds boxes ``offsets[r]:offsets[r + 1]``.
    distance : float
        Greatest gap along either axis.

    Yields
    ------
    i, j : (k,) int
        Boxes with i + 1 < j, every pair once, in chunks.
    """
    long = np.flatnonzero(np.diff(offsets) > 2)  # noqa: PLR2004 - neighbours only
    levels = _levels(low, high, offsets[long], np.diff(offsets)[long])
    for top, (*_, start, count) in enumerate(levels):
        root = start[count == 1] if top else start[:0]
        # A run has its root where one box is left; higher levels repeat it.
        root = root[levels[top - 1][3][count == 1] > 1] if top else root
        stack = [(top, root, root)]
        while stack:
            yield from _step(levels, stack, distance)


def _step(
    levels: list[_Level], stack: list[tuple[int, Index, Index]], distance: float
) -> Iterator[tuple[Index, Index]]:
    level, a, b = stack.pop()
    most = _CHUNK // _FANOUT**2
    if len(a) > most:
        stack.extend((level, a[k : k + most], b[k : k + most]) for k in range(0, len(a), most))
        return
    low, high, start, count = levels[level - 1]
    run = np.searchsorted(levels[level][2], a, side="right") - 1
    brood = np.arange(_FANOUT)
    first = start[run]
    last = first + count[run] - 1
    above = levels[level][2][run]
    i = np.repeat((first + (a - above) * _FANOUT)[:, None] + brood, _FANOUT, axis=1).ravel()
    j = np.tile((first + (b - above) * _FANOUT)[:, None] + brood, (1, _FANOUT)).ravel()
    last = np.repeat(last, _FANOUT**2)
    kept = np.flatnonzero((i <= last) & (j <= last) & (i + 1 < j if level == 1 else i <= j))
    i, j = i[kept], j[kept]
    for axis in (0, 1):
        kept = np.flatnonzero((low[i, axis] <= high[j, axis] + distance) & (low[j, axis] <= high[i, axis] + distance))
        i, j = i[kept], j[kept]
    if level > 1:
        stack.append((level - 1, i, j))
    elif len(i):
        yield i, j


def _levels(low: Reals, high: Reals, start: Index, count: Index) -> list[_Level]:
    """Boxes of each level, and where in them each run begins and how many it has; the first level are the boxes."""
    levels = [(low, high, start, count)]
    while len(count) and count.max() > 1:
        low, high, start, count = levels[-1]
        fewer = -(-count // _FANOUT)
        run, place = ragged(np.zeros(len(count), dtype=np.intp), fewer)
        head = start[run] + place * _FANOUT
        member = np.minimum(head[:, None] + np.arange(_FANOUT), (start + count - 1)[run][:, None])
        levels.append((low[member].min(axis=1), high[member].max(axis=1), np.cumsum(fewer) - fewer, fewer))
    return levels
