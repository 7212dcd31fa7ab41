# SPDX-License-Identifier: MIT
"""Lines followed through the places where just two ends meet.

A polyline and its segments drawn one by one are the same linework. A *chain* is a run of lines in which every end but
the outermost two meets exactly one other end. Where three ends or more meet, nobody can say which way a line goes on.
"""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index
from foparq.geom.boxtree import BoxTree
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import ragged
from foparq.geom.stretches import components

NOBODY = -1
#: side of a cell, in tolerances, of which any two places are one: a diagonal of three such sides is shorter than one
CELL = 0.57
_CROWD = 3  #: ends at one place that are no longer two


class Chains(NamedTuple):
    """c chains of n lines, of m vertices and s segments."""

    lines: Polylines  #: the chains
    vertex: Index  #: (m,) vertex of the given lines
    piece: Index  #: (s,) given line that a segment belongs to


def chained(lines: Polylines, *, within: float) -> Chains:
    """Lines joined to chains.

    Parameters
    ----------
    lines : Polylines, n lines
    within : float, metres
        Distance up to which two ends meet, in the plane and in depth. Lines that are no longer, and rings, stay alone.

    Notes
    -----
    O(n log n). Chains are in order of their first line, each begins at its outermost end that comes first. Of two ends
    at the very same place one vertex is left.
    """
    mate = mates(lines, within)
    if not np.any(mate != NOBODY):
        return Chains(lines, np.arange(len(lines.coordinates)), lines.line)
    label, place, backwards = in_chains(mate)
    order = np.lexsort((place, label))
    count = np.diff(lines.offsets)[order]
    owner, member = ragged(np.zeros(len(order), dtype=np.intp), count)
    turned = backwards[order][owner]
    vertex = np.where(turned, lines.tails[order][owner] - member, lines.heads[order][owner] + member)
    chain = label[order][owner]
    follows = (chain[1:] == chain[:-1]) & (owner[1:] != owner[:-1])
    same = np.all(lines.plane[vertex[1:]] == lines.plane[vertex[:-1]], axis=1)
    same &= lines.depth[vertex[1:]] == lines.depth[vertex[:-1]]
    kept = np.ones(len(vertex), dtype=bool)
    kept[:-1] = ~(follows & same)
    vertex, chain, owner = vertex[kept], chain[kept], owner[kept]
    offsets = np.searchsorted(chain, np.arange(int(label.max()) + 2)).astype(np.intp)
    made = Polylines(lines.coordinates[vertex], offsets)
    # A vertex that was left out was the last of its line: the segment to it belongs to the line all the same.
    return Chains(made, vertex, order[owner[made.first]])


def mates(lines: Polylines, within: float) -> Index:
    """The one other end (2 n,) that each end meets, or ``NOBODY``; line k has the ends 2 k and 2 k + 1."""
    mate = np.full(2 * len(lines), NOBODY, dtype=np.intp)
    line, _, forward = open_ends(lines, within)
    slot = 2 * line + ~forward
    rows, i, j, _ = meetings(lines, within)
    degree, partner = np.zeros(len(rows), dtype=np.intp), np.full(len(rows), NOBODY, dtype=np.intp)
    for one, two in ((i, j), (j, i)):
        degree += np.bincount(one, minlength=len(rows))
        partner[one] = two
    single = np.flatnonzero(degree == 1)
    pair = single[degree[partner[single]] == 1]
    mate[slot[rows[pair]]] = slot[rows[partner[pair]]]
    return mate


class Meetings(NamedTuple):
    """Which of e open ends meet each other."""

    rows: Index  #: (r,) ends that are asked: a few of every small cell
    one: Index  #: (p,) of pairs that meet, rows of ``rows``
    two: Index  #: (p,)
    stands_for: Index  #: (e,) for each end, the row of ``rows`` that lies in its cell, and so meets it


def meetings(lines: Polylines, within: float) -> Meetings:
    """Which ends meet each other, of those of :func:`open_ends`; made once."""
    return lines.kept(("meetings", within), lambda: _meetings(lines, within))


def _meetings(lines: Polylines, within: float) -> Meetings:
    _, vertex, _ = open_ends(lines, within)
    rows, stands_for = _thinned(lines, vertex, within)
    turned = lines.plane[vertex[rows]] @ lines.turn
    pairs = [np.zeros((2, 0), dtype=np.intp)]
    for i, j in BoxTree(turned, turned).pairs(distance=within):
        met = _meet(lines, vertex[rows[i]], vertex[rows[j]], within)
        pairs.append(np.stack([i[met], j[met]]))
    one, two = np.concatenate(pairs, axis=1)
    return Meetings(rows, one, two, stands_for)


def _meet(lines: Polylines, one: Index, two: Index, within: float) -> Flags:
    """True (k,) where two vertices are near in the plane and in depth."""
    near: Flags = np.hypot(*(lines.plane[one] - lines.plane[two]).T) <= within
    near &= np.abs(lines.depth[one] - lines.depth[two]) <= within
    return near


def open_ends(lines: Polylines, within: float) -> tuple[Index, Index, Flags]:
    """Ends of lines whose ends are apart by more than ``within``: line, vertex, and whether it is the first one."""
    open_lines = np.flatnonzero(lines.opening > within)
    line = np.repeat(open_lines, 2)
    vertex = np.stack([lines.heads[open_lines], lines.tails[open_lines]], axis=1).ravel()
    return line, vertex, np.tile([True, False], len(open_lines))


def _thinned(lines: Polylines, vertex: Index, within: float) -> tuple[Index, Index]:
    """Rows of ``vertex`` that are enough to tell whether two ends meet or more; and which of them is in whose cell."""
    if not len(vertex):
        return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
    cell = np.floor(np.column_stack([lines.plane[vertex], lines.depth[vertex]]) / (CELL * within))
    order = np.lexsort(cell.T)
    new = np.concatenate([[True], np.any(cell[order[1:]] != cell[order[:-1]], axis=1)])
    begin = np.flatnonzero(new)[np.cumsum(new) - 1]
    rows = np.sort(order[np.arange(len(order)) - begin < _CROWD])
    stands_for = np.empty(len(order), dtype=np.intp)
    stands_for[order] = np.searchsorted(rows, order[begin])
    return rows, stands_for


def in_chains(mate: Index) -> tuple[Index, Index, Flags]:
    """Which chain every line belongs to, its place in it, and whether it is followed backwards.

    Parameters
    ----------
    mate : (2 n,) int
        See :func:`mates`.

    Returns
    -------
    label, place, backwards : (n,)
        Chains are numbered in order of their first line; places rise along the chain, which begins at the free end
        that comes first. A closed chain begins at its first line.

    Notes
    -----
    O(n log n): the end of the way from every line is found by leaps that double.
    """
    n = len(mate) // 2
    mate = mate.copy()
    joined = np.flatnonzero(mate != NOBODY)
    label = components(n, joined // 2, mate[joined] // 2)
    slot = np.arange(2 * n)
    begin = np.full(int(label.max()) + 1 if n else 0, 2 * n, dtype=np.intp)
    np.minimum.at(begin, label[slot // 2], np.where(mate == NOBODY, slot, 2 * n))
    closed = np.flatnonzero(begin == 2 * n)
    if len(closed):
        first = np.full(len(begin), 2 * n, dtype=np.intp)
        np.minimum.at(first, label[slot // 2], slot)
        begin[closed] = first[closed]
        mate[mate[first[closed]]] = NOBODY
        mate[first[closed]] = NOBODY
    # A line is entered by one of its ends, left by the other, and the next is entered by that end's mate.
    ahead = mate[slot ^ 1]
    to = np.where(ahead == NOBODY, slot, ahead)
    steps = (to != slot).astype(np.intp)
    while len(moving := np.flatnonzero(to[to] != to)):
        steps[moving] += steps[to[moving]]
        to[moving] = to[to[moving]]
    line = np.arange(n)
    backwards: Flags = (to[2 * line] ^ 1) == begin[label]
    entered = 2 * line + backwards
    return label, -steps[entered], backwards
