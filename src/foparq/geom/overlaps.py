# SPDX-License-Identifier: MIT
"""Stretches that two lines share."""

from typing import NamedTuple

import numpy as np

from foparq.geom.pairs import meetings
from foparq.geom.polylines import Flags, Index, Polylines, Reals, summed
from foparq.geom.segments import shared
from foparq.geom.stretches import longest


class Overlaps(NamedTuple):
    """Pairs of lines that share a stretch, k rows in order of (later, earlier)."""

    earlier: Index  #: (k,) the line that comes first
    later: Index  #: (k,)
    length: Reals  #: (k,) all shared pieces together, metres
    start: Reals  #: (k, 2) the longest shared piece, from the origin of the lines
    end: Reals  #: (k, 2)


def line_overlaps(lines: Polylines, exempt: Flags, *, coincide: float) -> Overlaps:
    """Pairs of lines that run along each other for more than ``coincide``.

    Parameters
    ----------
    lines : Polylines, n lines
    exempt : (n,) bool
        Pairs of which both are exempt are not compared.
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Overlaps
        Two segments share the common interval of their projections on the longer one, if they are within ``coincide``
        of each other at both its ends and turned against each other by less than one in four. Pieces are summed a
        pair, so that a line of many vertices is found along a long straight one.

    Notes
    -----
    O(s log s + meetings). Collinear lines that only touch share no more than ``coincide``. A line that runs twice over
    another counts twice.
    """
    within = coincide + lines.slack
    i, j = meetings(lines, coincide=coincide).along
    run = shared(lines.segments(i), lines.segments(j), within=within)
    kept = np.flatnonzero(~(exempt[lines.line[i]] & exempt[lines.line[j]]))
    earlier, later = lines.line[i[kept]], lines.line[j[kept]]
    pair, label = np.unique(later * len(lines) + earlier, return_inverse=True)
    length = summed(label, run.length[kept], len(pair))
    middle = (run.start[kept] + run.end[kept]) / 2
    # Of equal pieces the one nearest to an end of the later line: the same whichever way the lines are drawn.
    head, tail = lines.plane[lines.heads[later]], lines.plane[lines.tails[later]]
    tie = np.minimum(np.hypot(*(middle - head).T), np.hypot(*(middle - tail).T))
    row = kept[longest(label, run.length[kept], tie, slack=4 * lines.slack)]
    over = length > within
    return Overlaps(
        (pair % max(len(lines), 1))[over],
        (pair // max(len(lines), 1))[over],
        length[over],
        run.start[row][over],
        run.end[row][over],
    )
