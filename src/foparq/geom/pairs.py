# SPDX-License-Identifier: MIT
"""Pairs of segments that meet in a way that a rule asks for."""

import numpy as np

from foparq.columns import Flags, Index
from foparq.geom.polylines import Polylines
from foparq.geom.runtree import pairs_of_runs
from foparq.geom.segments import ALONG, cannot_meet, contacts, shared

#: a little below the cosine that ``shared`` asks for, so that rounding rejects nothing
_NEARLY = ALONG - 1e-9


def own_meetings(lines: Polylines, *, coincide: float) -> Index:
    """Pairs of segments of one line that meet within ``coincide``, in the plane and in depth there.

    Parameters
    ----------
    lines : Polylines, s segments
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    (2, k) int
        Segments i < j, ordered. Consecutive ones are left out.

    Notes
    -----
    O(s log s + candidates); memory is bounded by the result, not by the candidates.
    """
    within = coincide + lines.slack
    turned = lines.plane @ lines.turn
    start, end = turned[lines.first], turned[lines.first + 1]
    found = [np.zeros((2, 0), dtype=np.intp)]
    for i, j in pairs_of_runs(np.minimum(start, end), np.maximum(start, end), lines.segment_offsets, distance=within):
        one, two = lines.segments(i), lines.segments(j)
        kept = np.flatnonzero(~cannot_meet(one, two, within=within))
        met = kept[contacts(one.take(kept), two.take(kept), within=within).meets.any(axis=0)]
        found.append(np.stack([i[met], j[met]]))
    return _ordered(np.concatenate(found, axis=1))


def runs_of_two(lines: Polylines, *, coincide: float) -> Index:
    """Pairs of segments of different lines that run along each other within ``coincide``, also in depth.

    Parameters
    ----------
    lines : Polylines, s segments
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    (2, k) int
        Segments i < j, ordered. Places where lines only cross or touch are left out: a crosshatch has a hundred
        million of them, and no rule asks.

    Notes
    -----
    O(s log s + candidates); memory is bounded by the result, not by the candidates.
    """
    within = coincide + lines.slack
    found = [np.zeros((2, 0), dtype=np.intp)]
    for one, two in lines.tree.pairs(distance=within):
        apart = np.flatnonzero(lines.line[one] != lines.line[two])
        i, j = np.minimum(one[apart], two[apart]), np.maximum(one[apart], two[apart])
        kept = np.flatnonzero(_parallel(lines, i, j))
        i, j = i[kept], j[kept]
        run = np.flatnonzero(shared(lines.segments(i), lines.segments(j), within=within).length > 0)
        found.append(np.stack([i[run], j[run]]))
    return _ordered(np.concatenate(found, axis=1))


def _parallel(lines: Polylines, i: Index, j: Index) -> Flags:
    """False (k,) where two segments are turned too far to run along each other; a rejection before the exact test."""
    step = lines.way
    along = step[i, 0] * step[j, 0] + step[i, 1] * step[j, 1]
    parallel: Flags = np.abs(along) >= _NEARLY * lines.step[i] * lines.step[j]
    return parallel


def _ordered(pairs: Index) -> Index:
    ordered: Index = pairs[:, np.lexsort((pairs[1], pairs[0]))]
    return ordered
