# SPDX-License-Identifier: MIT
"""Stretches that two lines share."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.pairs import runs_of_two
from foparq.geom.polylines import Polylines, summed
from foparq.geom.ranks import line_ranks
from foparq.geom.segments import shared
from foparq.geom.stretches import components, longest
from foparq.geom.tangents import runs_along


class Overlaps(NamedTuple):
    """Pairs of lines that share a stretch, k rows."""

    other: Index  #: (k,) the line that stays: of lines that overlap each other, the longest
    line: Index  #: (k,) the line at fault
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
        pair. Curves that touch at a tangent share nothing, see :func:`foparq.geom.tangents.runs_along`. Of a group of
        lines that overlap each other all but the longest are at fault, so that the order of the lines changes no
        count; the boundary of an area never is because of a line.

    Notes
    -----
    O(s log s + meetings). Collinear lines that only touch share no more than ``coincide``. A line that runs twice over
    another counts twice.
    """
    within = coincide + lines.slack
    i, j = runs_of_two(lines, coincide=coincide)
    run = shared(lines.segments(i), lines.segments(j), within=within)
    kept = np.flatnonzero(~(exempt[lines.line[i]] & exempt[lines.line[j]]) & (run.length > 0))
    kept = kept[runs_along(lines, i[kept], j[kept], run.start[kept], run.end[kept], within=within)]
    earlier, later = lines.line[i[kept]], lines.line[j[kept]]
    pair, label = np.unique(later * len(lines) + earlier, return_inverse=True)
    length = summed(label, run.length[kept], len(pair))
    middle = (run.start[kept] + run.end[kept]) / 2
    # Of equal pieces the one nearest to an end of either line: the same whichever way the drawing is turned.
    tie = np.minimum(_from_an_end(lines, earlier, middle), _from_an_end(lines, later, middle))
    over = np.flatnonzero(length > within)
    row = kept[longest(label, run.length[kept], tie, middle, slack=lines.slack)][over]
    first, second = _from_the_longest(lines, exempt, lines.line[i[row]], lines.line[j[row]])
    return Overlaps(first, second, length[over], run.start[row], run.end[row])


def _from_an_end(lines: Polylines, line: Index, place: Reals) -> Reals:
    """Distance (k,) of places from the nearer end of a line; inf for a ring."""
    ends = [np.hypot(*(place - lines.plane[at[line]]).T) for at in (lines.heads, lines.tails)]
    distance: Reals = np.where(lines.opening[line] > lines.slack, np.minimum(*ends), np.inf)
    return distance


def _from_the_longest(lines: Polylines, exempt: Flags, one: Index, two: Index) -> tuple[Index, Index]:
    """The same pairs, each from the nearer to the farther of its lines, told from the longest line of the group.

    So every line of a group but the longest is the farther one of some pair. In a group with boundaries of areas the
    boundaries stay instead.
    """
    if not len(one):
        return one, two
    from scipy.sparse import coo_array  # noqa: PLC0415 - slow to load, and few drawings need it
    from scipy.sparse.csgraph import dijkstra  # noqa: PLC0415

    line, index = np.unique(np.concatenate([one, two]), return_inverse=True)
    i, j = index[: len(one)], index[len(one) :]
    label = components(len(line), i, j)
    rank = line_ranks(lines, line)
    order = np.lexsort((rank, label))
    longest_line = order[np.unique(label[order], return_index=True)[1]]
    bounded = np.zeros(len(longest_line), dtype=bool)
    bounded[label[exempt[line]]] = True
    sources = np.concatenate([np.flatnonzero(exempt[line]), longest_line[~bounded]])
    graph = coo_array((np.ones(len(i)), (i, j)), shape=(len(line), len(line))).tocsr()
    steps = dijkstra(graph, directed=False, indices=sources, unweighted=True, min_only=True)
    swap = (steps[i] > steps[j]) | ((steps[i] == steps[j]) & (rank[i] > rank[j]))
    return np.where(swap, two, one), np.where(swap, one, two)
