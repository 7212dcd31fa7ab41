# SPDX-License-Identifier: MIT
"""Pairs of segments that meet in a way that a rule asks for."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index
from foparq.geom.polylines import Polylines
from foparq.geom.segments import cannot_meet, contacts, shared


class Meetings(NamedTuple):
    """Pairs of segments i < j, ordered."""

    own: Index  #: (2, k) of one line, not consecutive: they cross or touch
    along: Index  #: (2, m) of different lines: they run along each other


def meetings(lines: Polylines, *, coincide: float) -> Meetings:
    """Pairs of segments that meet within ``coincide``, in the plane and in depth there.

    Parameters
    ----------
    lines : Polylines, s segments
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Meetings
        Computed once a tolerance. Does not hold the places where different lines only cross or touch: a crosshatch has
        a hundred million of them, and no rule asks.

    Notes
    -----
    O(s log s + candidates); memory is bounded by the result, not by the candidates.
    """
    return lines.kept(("meetings", coincide), lambda: _meetings(lines, coincide + lines.slack))


def _meetings(lines: Polylines, within: float) -> Meetings:
    none = np.zeros((2, 0), dtype=np.intp)
    own, along = [none], [none]
    for one, two in lines.tree.pairs(distance=within):
        i, j = np.minimum(one, two), np.maximum(one, two)
        same = lines.line[i] == lines.line[j]
        kept = np.flatnonzero(~same | (j != i + 1))
        i, j, same = i[kept], j[kept], same[kept]
        kept = np.flatnonzero(~cannot_meet(lines.segments(i), lines.segments(j), within=within))
        i, j, same = i[kept], j[kept], same[kept]
        pair = np.stack([i[same], j[same]])
        met = contacts(lines.segments(pair[0]), lines.segments(pair[1]), within=within).meets.any(axis=0)
        own.append(pair[:, met])
        pair = np.stack([i[~same], j[~same]])
        run = shared(lines.segments(pair[0]), lines.segments(pair[1]), within=within).length > 0
        along.append(pair[:, run])
    return Meetings(_ordered(np.concatenate(own, axis=1)), _ordered(np.concatenate(along, axis=1)))


def _ordered(pairs: Index) -> Index:
    ordered: Index = pairs[:, np.lexsort((pairs[1], pairs[0]))]
    return ordered
