# SPDX-License-Identifier: MIT
"""Ends of lines: connected, beyond the last crossing, short of the next line, or free.

An *end* is the first or last vertex of a line whose ends are apart by more than ``coincide``. *Other linework* of an
end is every segment of any other line, and the segments of its own line that come after the line, followed from the
end, has left the circle of radius ``reach`` around it. An end that rests on its own line is connected even if the line
has left the circle of radius ``coincide`` only.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Reals
from foparq.geom.leaving import leaving
from foparq.geom.polylines import Polylines, Segments
from foparq.geom.ragged import last_not_above, ragged
from foparq.geom.ranks import line_ranks
from foparq.geom.segments import at_share, cannot_meet, contacts, nearest_share
from foparq.geom.strokes import joints, near_tips

NOBODY = -1


class EndKind(IntEnum):
    """What an end is; every end is exactly one of these."""

    CONNECTED = 0  #: meets other linework
    OVERSHOOT = 1  #: goes beyond its last meeting, by more than ``coincide`` and at most ``reach``
    UNDERSHOOT = 2  #: stops short of other linework, by more than ``coincide`` and at most ``reach``
    FREE = 3  #: nothing within ``reach``


class Ends(NamedTuple):
    """The e ends of some lines, as columns, ordered by line, first vertex before last."""

    line: Index  #: (e,)
    vertex: Index  #: (e,) row of the coordinates
    forward: Flags  #: (e,) true if the line is followed in its own order
    kind: NDArray[np.int8]  #: (e,) :class:`EndKind`
    size: Reals  #: (e,) metres; 0 if connected, ``reach`` if free
    other: Index  #: (e,) line that is met, crossed or missed; ``NOBODY`` if connected or free


def classify_ends(lines: Polylines, *, coincide: float, reach: float) -> Ends:
    """What every end of every line is.

    Parameters
    ----------
    lines : Polylines, n lines
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Ends, e rows
        Computed once a pair of tolerances.

    Notes
    -----
    O((s + e) log s + near pairs), in blocks of bounded memory. The distance to other linework is that to the nearest
    place in the plane, joined with the difference in depth there. Among lines at the same distance the longest is
    named, of equals the first by place.
    Does not look at the middle of lines: two lines that cross without a vertex are no matter of ends.
    """
    return lines.kept(
        ("ends", coincide, reach), lambda: _classify(lines, coincide + lines.slack, reach + lines.slack, reach)
    )


def _classify(lines: Polylines, within: float, radius: float, reach: float) -> Ends:
    short = lines.length_in_space <= within
    line, vertex, forward = _ends(lines, within)
    kind = np.full(len(line), EndKind.CONNECTED, dtype=np.int8)
    size, other = np.zeros(len(line)), np.full(len(line), NOBODY, dtype=np.intp)
    loose = np.flatnonzero(~_share_an_end(lines, vertex, within))
    left = leaving(lines, vertex[loose], forward[loose], radius=radius)
    back = leaving(lines, vertex[loose], forward[loose], radius=within)
    asked = _Asked(lines, line[loose], vertex[loose], forward[loose], left, short)

    gap, near, connected = _nearest(asked, back, within, radius)
    dangling = np.flatnonzero(~connected)
    if short.any():
        connected[dangling[_joined(asked.take(dangling), back[dangling], within)]] = True
    passed, crossed = np.full(len(loose), np.inf), np.full(len(loose), NOBODY, dtype=np.intp)
    dangling = np.flatnonzero(~connected)
    passed[dangling], crossed[dangling] = _last_meeting(asked.take(dangling), within, radius)

    over = ~connected & (passed > within) & np.isfinite(passed)
    under = ~connected & ~over & (gap <= radius)
    free = ~connected & ~over & ~under
    for flags, which, amount, whom in (
        (over, EndKind.OVERSHOOT, passed, crossed),
        (under, EndKind.UNDERSHOOT, gap, near),
        (free, EndKind.FREE, np.full(len(loose), reach), np.full(len(loose), NOBODY)),
    ):
        rows = loose[flags]
        kind[rows], size[rows], other[rows] = which, amount[flags], whom[flags]
    return Ends(line, vertex, forward, kind, size, other)


class _Asked:
    """Ends that are looked at, with what is needed to tell their other linework."""

    def __init__(self, lines: Polylines, line: Index, vertex: Index, forward: Flags, left: Index, short: Flags) -> None:
        self.lines, self.line, self.vertex, self.forward, self.left = lines, line, vertex, forward, left
        self.short = short  #: (n,) lines that are no linework by themselves

    def take(self, rows: Index) -> "_Asked":
        return _Asked(self.lines, self.line[rows], self.vertex[rows], self.forward[rows], self.left[rows], self.short)

    def others(self, end: Index, segment: Index, left: Index | None = None) -> Flags:
        """True where the segment is other linework of the end, its own line from the vertex ``left`` on included."""
        of = self.lines.line[segment]
        own = self.beyond(self.left if left is None else left, end, segment)
        other: Flags = ~self.short[of] & ((of != self.line[end]) | own)
        return other

    def beyond(self, left: Index, end: Index, segment: Index) -> Flags:
        """True where a segment of the end's own line comes after the vertex ``left[end]``; others are not told."""
        start = self.lines.first[segment]
        after: Flags = np.where(self.forward[end], start >= left[end], start + 1 <= left[end])
        return after


def _ends(lines: Polylines, within: float) -> tuple[Index, Index, Flags]:
    open_lines = np.flatnonzero(lines.opening > within)
    line = np.repeat(open_lines, 2)
    vertex = np.stack([lines.heads[open_lines], lines.tails[open_lines]], axis=1).ravel()
    return line, vertex, np.tile([True, False], len(open_lines))


def _share_an_end(lines: Polylines, vertex: Index, within: float) -> Flags:
    """True where another end lies in the same small cell, hence at the same place: most ends of a clean drawing.

    The two ends of one line are farther apart than the cell is wide: the other end is another line's.
    """
    if not len(vertex):
        return np.zeros(0, dtype=bool)
    # The diagonal of a cell with three sides of 0.57 is shorter than one.
    cell = np.floor(np.column_stack([lines.plane[vertex], lines.depth[vertex]]) / (0.57 * within))
    order = np.lexsort(cell.T)
    alike = np.all(cell[order[1:]] == cell[order[:-1]], axis=1)
    crowded = np.zeros(len(vertex), dtype=bool)
    crowded[order[1:][alike]] = True
    crowded[order[:-1][alike]] = True
    return crowded


def _nearest(asked: _Asked, back: Index, within: float, radius: float) -> tuple[Reals, Index, Flags]:
    """Distance to the nearest other linework (inf beyond ``radius``), its line, and whether the end meets anything.

    ``back`` is the vertex of each line from which on its own segments may be met.
    """
    lines = asked.lines
    gap, line = np.full(len(asked.line), np.inf), np.full(len(asked.line), NOBODY, dtype=np.intp)
    connected = np.zeros(len(asked.line), dtype=bool)
    points, depth = lines.plane[asked.vertex], lines.depth[asked.vertex]
    turned = points @ lines.turn
    for end, segment in lines.tree.query(turned, turned, distance=radius):
        kept = np.flatnonzero(asked.others(end, segment, back))
        at, row = end[kept], segment[kept]
        near = lines.segments(row)
        share = nearest_share(points[at], near.start, near.end)
        flat = np.hypot(*(at_share(share, near.start, near.end) - points[at]).T)
        drop = np.abs(at_share(share, near.z0, near.z1) - depth[at])
        connected[at[(flat <= within) & (drop <= within)]] = True
        apart = np.hypot(flat, drop)
        # What is farther is never told; what is no number would hide the others.
        far = np.flatnonzero((apart <= radius + 2 * lines.slack) & asked.others(at, row))
        _keep_least(lines, gap, line, at[far], apart[far], lines.line[row[far]])
    return gap, line, connected


def _joined(asked: _Asked, back: Index, within: float) -> Index:
    """Ends (k,) that meet other linework through lines that are no longer than a point."""
    lines = asked.lines
    found = joints(lines, asked.short, within=within)
    end, joint = near_tips(lines, found, asked.vertex, within=within)
    touched, line = np.unique(np.stack([found.touching, lines.line[found.segment]]), axis=1)
    several = np.bincount(touched, minlength=int(joint.max()) + 1 if len(joint) else 0)
    alone = np.full(len(several), NOBODY, dtype=np.intp)
    alone[touched] = line
    met = (several[joint] > 1) | ((several[joint] == 1) & (alone[joint] != asked.line[end]))
    # A joint that touches one line, maybe the end's own: elsewhere, or at the end alone?
    own = np.flatnonzero(several[joint] == 1)
    order = np.argsort(found.touching, kind="stable")
    first, last = (np.searchsorted(found.touching[order], joint[own], side=side) for side in ("left", "right"))
    of, at = ragged(first, last - first)
    back_again = asked.beyond(back, end[own][of], found.segment[order[at]])
    met[own[of[back_again]]] = True
    return np.unique(end[met])


def _last_meeting(asked: _Asked, within: float, radius: float) -> tuple[Reals, Index]:
    """Length from the end back to its last meeting (inf if none within ``radius``), and the line met."""
    lines = asked.lines
    passed, line = np.full(len(asked.line), np.inf), np.full(len(asked.line), NOBODY, dtype=np.intp)
    end, before, piece = _stretches(asked, radius)
    length = np.hypot(*(piece.end - piece.start).T)
    start, stop = piece.start @ lines.turn, piece.end @ lines.turn
    for row, segment in lines.tree.query(np.minimum(start, stop), np.maximum(start, stop), distance=within):
        kept = np.flatnonzero(asked.others(end[row], segment))
        kept = kept[~cannot_meet(piece.take(row[kept]), lines.segments(segment[kept]), within=within)]
        at, one, two = row[kept], piece.take(row[kept]), segment[kept]
        found = contacts(one, lines.segments(two), within=within)
        # The crossing says where they meet; failing that, the meeting place nearest the end.
        share = np.where(found.meets, found.on_a, np.inf)
        place = np.where(found.meets[0], share[0], share[1:].min(axis=0)) if len(at) else np.zeros(0)
        met = np.flatnonzero(np.isfinite(place))
        at, two, place = at[met], two[met], place[met]
        _keep_least(lines, passed, line, end[at], before[at] + place * length[at], lines.line[two])
    return passed, line


def _stretches(asked: _Asked, radius: float) -> tuple[Index, Reals, Segments]:
    """Pieces of the lines from each end back to ``radius`` of their own length, each directed away from the end.

    Returns
    -------
    end, before, piece
        Row of the end, length between the end and the piece, the piece.
    """
    lines, vertex = asked.lines, asked.vertex
    run = lines.along[vertex]
    head, tail = lines.heads[asked.line], lines.tails[asked.line]
    last = last_not_above(lines.along, vertex, np.maximum(tail, vertex + 1), run + radius)
    first = last_not_above(lines.along, head, vertex + 1, run - radius) + 1
    count = np.where(asked.forward, last - vertex, vertex - first) + 1
    end, place = ragged(np.zeros(len(vertex), dtype=np.intp), count)
    stride = np.where(asked.forward, 1, -1)
    start = vertex[end] + stride[end] * place
    stop = start + stride[end]
    before = np.abs(lines.along[start] - run[end])
    length = np.abs(lines.along[stop] - lines.along[start])
    share = np.clip((radius - before) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    share = np.where(length > 0, share, 1.0)
    p0, p1, z0, z1 = lines.plane[start], lines.plane[stop], lines.depth[start], lines.depth[stop]
    return end, before, Segments(p0, at_share(share, p0, p1), z0, at_share(share, z0, z1))


def _keep_least(lines: Polylines, least: Reals, line: Index, at: Index, value: Reals, of: Index) -> None:
    """Lower ``least[at]`` to ``value`` and name the line; of values that differ by rounding only, the first by rank."""
    ends = np.unique(at)
    named = line[ends] != NOBODY
    at, of = np.concatenate([at, ends[named]]), np.concatenate([of, line[ends[named]]])
    value = np.concatenate([value, least[ends[named]]])
    np.minimum.at(least, at, value)
    tied = value <= least[at] + lines.slack
    at, of = at[tied], of[tied]
    line[at] = of
    doubtful = np.zeros(len(line), dtype=bool)
    doubtful[at[line[at] != of]] = True
    rows = np.flatnonzero(doubtful[at])
    if len(rows):
        choice, index = np.unique(of[rows], return_inverse=True)
        order = rows[np.argsort(-line_ranks(lines, choice)[index], kind="stable")]
        line[at[order]] = of[order]  # the last that is written stays
