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


class Runs(NamedTuple):
    """Pairs of segments of different lines that share a stretch, r rows, and the k pairs of their lines."""

    i: Index  #: (r,) segment of the earlier line
    j: Index  #: (r,) segment of the later line
    start: Reals  #: (r, 2) the shared piece, from the origin of the lines
    end: Reals  #: (r, 2)
    pair: Index  #: (r,) row of the pair of lines
    one: Index  #: (k,) earlier line of each pair, ordered by the later
    two: Index  #: (k,) later line
    length: Reals  #: (k,) all shared pieces together, metres
    longest: Index  #: (k,) row of the longest piece

    def take(self, pairs: Flags) -> "Runs":
        """The chosen pairs; of the runs, those that belong to them."""
        number = np.cumsum(pairs) - 1
        kept = pairs[self.pair]
        at = np.cumsum(kept) - 1
        return Runs(
            self.i[kept], self.j[kept], self.start[kept], self.end[kept], number[self.pair[kept]],
            self.one[pairs], self.two[pairs], self.length[pairs], at[self.longest[pairs]],
        )  # fmt: skip


def shared_runs(lines: Polylines, exempt: Flags, *, coincide: float) -> Runs:
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
    Runs
        Two segments share the common interval of their projections on the longer one, if they are within ``coincide``
        of each other at both its ends and turned against each other by less than one in four. Curves that touch at a
        tangent share nothing, see :func:`foparq.geom.tangents.runs_along`. Made once for each ``exempt``.

    Notes
    -----
    O(s log s + meetings). Collinear lines that only touch share no more than ``coincide``. A line that runs twice over
    another counts twice.
    """
    key = ("runs", coincide, exempt.tobytes() if exempt.any() else b"")
    return lines.kept(key, lambda: _shared_runs(lines, exempt, coincide + lines.slack, coincide))


def _shared_runs(lines: Polylines, exempt: Flags, within: float, coincide: float) -> Runs:
    i, j = runs_of_two(lines, coincide=coincide)
    run = shared(lines.segments(i), lines.segments(j), within=within)
    kept = np.flatnonzero(~(exempt[lines.line[i]] & exempt[lines.line[j]]) & (run.length > 0))
    kept = kept[runs_along(lines, i[kept], j[kept], run.start[kept], run.end[kept], within=within)]
    start, end, pieces = run.start[kept], run.end[kept], run.length[kept]
    earlier, later = lines.line[i[kept]], lines.line[j[kept]]
    pair, label = np.unique(later * len(lines) + earlier, return_inverse=True)
    length = summed(label, pieces, len(pair))
    middle = (start + end) / 2
    # Of equal pieces the one nearest to an end of either line: the same whichever way the drawing is turned.
    tie = np.minimum(_from_an_end(lines, earlier, middle), _from_an_end(lines, later, middle))
    row = longest(label, pieces, tie, middle, slack=lines.slack)
    runs = Runs(i[kept], j[kept], start, end, label, pair % len(lines), pair // len(lines), length, row)
    return runs.take(length > within)


def line_overlaps(
    lines: Polylines, exempt: Flags, *, coincide: float, apart: Index | None = None, stays: Flags | None = None
) -> Overlaps:
    """Pairs of lines of which one is at fault because it runs along the other for more than ``coincide``.

    Parameters
    ----------
    lines : Polylines, n lines
    exempt : (n,) bool
        Pairs of which both are exempt are not compared.
    coincide : float, metres
        Distance up to which two places are one.
    apart : (n,) int, optional
        Lines with different numbers have nothing to do with each other.
    stays : (n,) bool, optional
        Further lines of which no pair is compared, and which are never at fault.

    Returns
    -------
    Overlaps
        As :func:`shared_runs`. Of a group of lines that overlap each other all but the longest are at fault, so that
        the order of the lines changes no count; an exempt line never is because of another one.
    """
    runs = shared_runs(lines, exempt, coincide=coincide)
    if stays is not None and stays.any():
        exempt = exempt | stays
        runs = runs.take(~(exempt[runs.one] & exempt[runs.two]))
    if apart is not None:
        runs = runs.take(apart[runs.one] == apart[runs.two])
    first, second = _from_the_longest(lines, exempt, runs.one, runs.two)
    return Overlaps(first, second, runs.length, runs.start[runs.longest], runs.end[runs.longest])


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
