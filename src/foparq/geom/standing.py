# SPDX-License-Identifier: MIT
"""Groups of lines, such as the strokes of one symbol: how large they are, and what other linework comes to them.

Every line belongs to one group, or to none (``NOBODY``). *Other linework* of a group is every line that does not belong
to it. An end of a line is *loose* if no other line on its side, of the group or of what is other linework to the group,
comes as near as ``within``.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Flags, Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.chains import CELL, NOBODY, open_ends
from foparq.geom.polylines import Polylines
from foparq.geom.segments import at_share, contacts, cross, nearest_share


def fitting(lines: Polylines, group: Index, count: int, *, size: float) -> Flags:
    """Groups that fit into a circle in the plane, and into its diameter in depth.

    Parameters
    ----------
    lines : Polylines, n lines
    group : (n,) int
        Group of each line, ``NOBODY`` or less than ``count``.
    size : float, metres
        Diameter; a group that is as large fits.

    Returns
    -------
    (count,) bool
        False for groups without lines.

    Notes
    -----
    O(m). The circle is sought only where the box does not tell: its diameter lies between the longer side and the
    diagonal of the box.
    """
    size = size + lines.slack
    of_vertex = group[lines.line_of_vertex]
    vertex = np.flatnonzero(of_vertex != NOBODY)
    of_vertex = of_vertex[vertex]
    place = np.column_stack([lines.plane[vertex], lines.depth[vertex]])
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, of_vertex, place)
    np.maximum.at(high, of_vertex, place)
    side = high - low  # of a group without lines it is infinitely small
    there = np.isfinite(side).all(axis=1) & (side[:, 2] <= size)
    fits: Flags = there & (np.hypot(side[:, 0], side[:, 1]) <= size)
    unclear = np.flatnonzero(there & ~fits & (side[:, :2].max(axis=1, initial=0.0) <= size))
    number = np.full(count, NOBODY, dtype=np.intp)
    number[unclear] = np.arange(len(unclear))
    chosen = np.flatnonzero(number[of_vertex] != NOBODY)
    chosen = chosen[np.argsort(number[of_vertex[chosen]], kind="stable")]
    if len(chosen):
        points = shapely.multipoints(shapely.points(place[chosen, :2]), indices=number[of_vertex[chosen]])
        fits[unclear] = 2.0 * shapely.minimum_bounding_radius(points) <= size
    return fits


def alone(lines: Polylines, group: Index, asked: Flags, *, within: float) -> Flags:
    """Groups near which no other linework lies.

    Parameters
    ----------
    group : (n,) int
    asked : (g,) bool
        Groups that are looked at.
    within : float, metres
        What is not farther, in the plane and in depth, is near.

    Returns
    -------
    (g,) bool
        False for groups that were not asked for.

    Notes
    -----
    O((s + near pairs) log s).
    """
    within = within + lines.slack
    of_segment = group[lines.line]
    mine = np.flatnonzero((of_segment != NOBODY) & asked[of_segment])
    stands = asked.copy()
    turned = lines.plane @ lines.turn
    a, b = turned[lines.first[mine]], turned[lines.first[mine] + 1]
    for at, other in lines.tree.query(np.minimum(a, b), np.maximum(a, b), distance=within):
        of = of_segment[mine[at]]
        kept = np.flatnonzero((of != of_segment[other]) & stands[of])
        pieces = lines.segments(mine[at[kept]]), lines.segments(other[kept])
        met = contacts(*pieces, within=within).meets.any(axis=0)
        stands[of[kept[met]]] = False
    return stands


class Joined(NamedTuple):
    """Where g groups and other linework end at each other."""

    loose: Index  #: (g,) loose ends of the group
    near: Index  #: (g,) of these, near other linework
    met: Index  #: (g,) of these, on other linework
    held: Flags  #: (g,) a loose end of other linework, of another kind, is near the group


def joined(lines: Polylines, group: Index, kind: Index, *, within: float, reach: float, alongside: float) -> Joined:
    """Ends of groups at other linework, and of other linework at groups.

    Parameters
    ----------
    group : (n,) int
    kind : (g,) int
        Equal numbers for groups of one kind: the ends of one hold no other.
    within, reach : float, metres
        Distance up to which two places are one, and up to which an end is near a line.
    alongside : float, radians
        An end of a group is not near a line that turns less against the segment that ends there, unless that line ends
        there as well, loose: a cross on an edge lies along it, and does not end at it.

    Notes
    -----
    O((s + near pairs) log s).
    """
    within, reach = within + lines.slack, reach + lines.slack
    every = _not_crowded(lines, group, _Tips(*open_ends(lines, within)), within)
    tips = every.take(np.flatnonzero(group[every.line] != NOBODY))
    loose, near, met = _ending(lines, group, tips, within, reach, alongside)
    of_line = np.append(kind, NOBODY)[group]  # what belongs to no group has no kind
    resting, on = _resting(lines, group, every, within, reach)
    for row, apart in _facing(lines, group, tips, every.take(resting), on, reach):
        near[row] = True
        met[row[apart <= within]] = True
    held = np.zeros(len(kind), dtype=bool)
    held[on[of_line[every.line[resting]] != kind[on]]] = True
    of = group[tips.line]
    count = [np.bincount(of[rows], minlength=len(kind)) for rows in (loose, loose & near, loose & met)]
    return Joined(count[0], count[1], count[2], held)


class _Tips(NamedTuple):
    """Ends of lines."""

    line: Index
    vertex: Index
    forward: Flags

    def take(self, rows: Index) -> "_Tips":
        return _Tips(self.line[rows], self.vertex[rows], self.forward[rows])


def _not_crowded(lines: Polylines, group: Index, tips: _Tips, within: float) -> _Tips:
    """Ends, less those that share a small cell with one of the same group, or of none: these are not loose."""
    if not len(tips.line):
        return tips
    cell = np.floor(np.column_stack([lines.plane, lines.depth])[tips.vertex] / (CELL * within))
    cell = np.column_stack([cell, group[tips.line]])
    order = np.lexsort(cell.T)
    alike = np.all(cell[order[1:]] == cell[order[:-1]], axis=1)
    alone_there = np.ones(len(cell), dtype=bool)
    alone_there[order[1:][alike]] = False
    alone_there[order[:-1][alike]] = False
    return tips.take(np.flatnonzero(alone_there))


def _apart(lines: Polylines, vertex: Index, segment: Index) -> Reals:
    """Distances (k,) of vertices from segments, in the plane and joined with the difference in depth there."""
    piece, place = lines.segments(segment), lines.plane[vertex]
    share = nearest_share(place, piece.start, piece.end)
    flat = np.hypot(*(at_share(share, piece.start, piece.end) - place).T)
    apart: Reals = np.hypot(flat, at_share(share, piece.z0, piece.z1) - lines.depth[vertex])
    return apart


def _ending(
    lines: Polylines, group: Index, tips: _Tips, within: float, reach: float, alongside: float
) -> tuple[Flags, Flags, Flags]:
    """Which ends (k,) of groups are loose, near other linework that they do not lie along, and on it."""
    loose = np.ones(len(tips.line), dtype=bool)
    near, met = np.zeros_like(loose), np.zeros_like(loose)
    turned = lines.plane[tips.vertex] @ lines.turn
    inward = lines.plane[np.where(tips.forward, tips.vertex + 1, tips.vertex - 1)] - lines.plane[tips.vertex]
    for asked, found in lines.tree.query(turned, turned, distance=max(within, reach)):
        others = np.flatnonzero(lines.line[found] != tips.line[asked])
        at, segment = asked[others], found[others]
        apart = _apart(lines, tips.vertex[at], segment)
        same = group[lines.line[segment]] == group[tips.line[at]]
        loose[at[same & (apart <= within)]] = False
        product, step = np.abs(cross(inward[at], lines.way[segment])), lines.step[segment]
        across = product >= np.sin(alongside) * np.hypot(*inward[at].T) * step - lines.slack * step
        near[at[~same & across & (apart <= reach)]] = True
        met[at[~same & across & (apart <= within)]] = True
    return loose, near, met


def _resting(lines: Polylines, group: Index, tips: _Tips, within: float, reach: float) -> tuple[Index, Index]:
    """Rows of loose ends of lines, and the groups that they are near and do not belong to; each pair once."""
    mine = np.flatnonzero(group[lines.line] != NOBODY)
    corners = lines.plane @ lines.turn
    a, b = corners[lines.first[mine]], corners[lines.first[mine] + 1]
    turned = corners[tips.vertex]
    pairs = [np.zeros((2, 0), dtype=np.intp)]
    for row, at in BoxTree(turned, turned).query(np.minimum(a, b), np.maximum(a, b), distance=reach):
        of = group[lines.line[mine[row]]]
        kept = np.flatnonzero(of != group[tips.line[at]])
        kept = kept[_apart(lines, tips.vertex[at[kept]], mine[row[kept]]) <= reach]
        pairs.append(np.unique(np.stack([at[kept], of[kept]]), axis=1))
    end, of = np.unique(np.concatenate(pairs, axis=1), axis=1)
    asked, at = np.unique(end, return_inverse=True)
    row, met = _touching(lines, group, tips.take(asked), within)
    # What meets the end is of the group itself: nothing else holds it.
    every = np.bincount(row, minlength=len(asked))
    width = int(group.max(initial=0)) + 2
    known, times = np.unique(row * width + met + 1, return_counts=True)
    wanted = at * width + of + 1
    place = np.searchsorted(known, wanted)
    known, times = np.append(known, NOBODY), np.append(times, 0)
    loose = every[at] == np.where(known[place] == wanted, times[place], 0)
    return end[loose], of[loose]


def _facing(
    lines: Polylines, group: Index, tips: _Tips, others: _Tips, on: Index, reach: float
) -> Iterator[tuple[Index, Reals]]:
    """Rows of ends of groups near which other ends rest on the group, and how far from them."""
    corners = lines.plane @ lines.turn
    mine, theirs = corners[tips.vertex], corners[others.vertex]
    for other, row in BoxTree(mine, mine).query(theirs, theirs, distance=reach):
        kept = np.flatnonzero(group[tips.line[row]] == on[other])
        a, b = tips.vertex[row[kept]], others.vertex[other[kept]]
        apart = np.hypot(np.hypot(*(lines.plane[a] - lines.plane[b]).T), lines.depth[a] - lines.depth[b])
        near = np.flatnonzero(apart <= reach)
        yield row[kept[near]], apart[near]


def _touching(lines: Polylines, group: Index, tips: _Tips, within: float) -> tuple[Index, Index]:
    """Rows of ends, and the groups of the segments of other lines that they meet, once for each such segment."""
    turned = lines.plane[tips.vertex] @ lines.turn
    rows, groups = [np.zeros(0, dtype=np.intp)], [np.zeros(0, dtype=np.intp)]
    for at, segment in lines.tree.query(turned, turned, distance=within):
        others = np.flatnonzero(lines.line[segment] != tips.line[at])
        others = others[_apart(lines, tips.vertex[at[others]], segment[others]) <= within]
        rows.append(at[others])
        groups.append(group[lines.line[segment[others]]])
    return np.concatenate(rows), np.concatenate(groups)
