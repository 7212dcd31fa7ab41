# SPDX-License-Identifier: MIT
"""The border of a surface: its boundary edges joined end to end.

A dart is an edge with a direction: dart 2j runs along the side of boundary edge j, dart 2j + 1 against it. The ends of
edge j are named like the darts that leave them.
"""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.mesh.edges import Edges
from foparq.mesh.grouping import joined
from foparq.mesh.polygons import following, preceding
from foparq.mesh.rings import Rings, rings, simple
from foparq.mesh.vectors import cross, dot, lengths, overflowing

_PAIR = 2


class Borders(NamedTuple):
    """Loops and chains of boundary edges, in order of their lowest edges."""

    starts: Index  #: (k + 1,) edges of border i are ``edges[starts[i]:starts[i + 1]]``
    edges: Index  #: (b,) rows of the edge table, in the order of the border
    vertices: Index  #: (b,) vertex where each of these edges begins, in the direction of the border
    last: Index  #: (k,) vertex where the last edge ends: of a loop, the first vertex
    closed: Flags  #: (k,) True for a loop


@overflowing
def borders(points: Coordinates, corners: Index, starts: Index, edges: Edges) -> Borders:
    """Boundary edges as loops, each through a vertex at most once, and as chains that end at other edges.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int
    edges : Edges

    Returns
    -------
    Borders
        A border runs along the side of its lowest edge; seen from above, a hole lies to its right.

    Notes
    -----
    At a vertex with one fan of faces, the border goes on from one end of the fan to the other. At a vertex with several
    fans it crosses the gap to the next fan, in their order around the vertex, so that holes which touch there are
    holes of their own. If then a border passes a vertex twice, it is cut there in two loops.

    Where a fan ends at an edge with more than two sides, the border goes on if the vertex has one other such end and
    both go the same way; else it ends there, as a chain.

    O(m + b log b) for b boundary edges; a border that passes a vertex twice costs a step of Python for each of its
    edges.
    """
    rows = edges.boundary
    if not len(rows):
        none = np.empty(0, dtype=np.intp)
        return Borders(np.zeros(1, dtype=np.intp), none, none, none, np.empty(0, dtype=bool))
    sides = edges.sides[edges.starts[rows]]
    after = following(starts)
    at = np.stack([sides, after[sides]], axis=1).ravel()  # the corner at each end
    mate = _mates(points, corners, starts, edges, at)
    found = simple(rings(mate), corners[at])
    return _table(found, corners[at], rows)


def _table(found: Rings, vertex: Index, rows: Index) -> Borders:
    last = found.starts[1:] - 1
    return Borders(
        found.starts, rows[found.darts >> 1], vertex[found.darts], vertex[found.darts[last] ^ 1], found.closed
    )


def _mates(points: Coordinates, corners: Index, starts: Index, edges: Edges, at: Index) -> Index:
    """The end (2b,) that each end of a boundary edge is joined to; -1 where the border ends."""
    fan = _fan_labels(corners, starts, edges, at)
    order = np.argsort(fan, kind="stable")
    alike = np.flatnonzero(fan[order[1:]] == fan[order[:-1]])
    one, two = order[alike], order[alike + 1]
    mate = np.full(len(at), -1, dtype=np.intp)
    mate[one], mate[two] = two, one
    _join_broken(mate, corners[at])
    # Fans of one vertex: each has an end that the border leaves by, and one that it arrives at.
    vertex = corners[at[one]]
    leaves = np.where(one % 2 == 0, one, two)
    fans = np.bincount(vertex, minlength=int(vertex.max()) + 1) if len(vertex) else np.zeros(0, np.intp)
    pinched = np.flatnonzero(fans[vertex] > 1)
    if len(pinched):
        leaves, vertex = leaves[pinched], vertex[pinched]
        arrives = mate[leaves]
        order = np.lexsort((leaves, _bearing(points, corners, starts, at, leaves), vertex))
        leaves, arrives, vertex = leaves[order], arrives[order], vertex[order]
        first = np.ones(len(vertex), dtype=bool)
        first[1:] = vertex[1:] != vertex[:-1]
        begin = np.flatnonzero(first)
        following_fan = np.arange(1, len(vertex) + 1)
        following_fan[np.append(begin[1:], len(vertex)) - 1] = begin
        mate[arrives], mate[leaves[following_fan]] = leaves[following_fan], arrives
    return mate


def _join_broken(mate: Index, vertex: Index) -> None:
    """Join the two ends of a vertex whose fans end at edges with more than two sides, if one arrives and one leaves."""
    broken = np.flatnonzero(mate < 0)
    order = broken[np.argsort(vertex[broken], kind="stable")]
    number = np.bincount(vertex[broken], minlength=int(vertex.max()) + 1) if len(broken) else broken
    order = order[number[vertex[order]] == _PAIR] if len(broken) else order
    one, two = order[::2], order[1::2]
    passes = (one + two) % 2 == 1
    mate[one[passes]], mate[two[passes]] = two[passes], one[passes]


def _fan_labels(corners: Index, starts: Index, edges: Edges, at: Index) -> Index:
    """Label (2b,) of the fan that each end belongs to: corners joined over edges with exactly two sides."""
    border = np.zeros(int(corners.max()) + 1 if len(corners) else 0, dtype=bool)
    border[corners[at]] = True
    rows = np.flatnonzero(border[corners])
    place = np.full(len(corners), -1, dtype=np.intp)
    place[rows] = np.arange(len(rows))
    after = following(starts)
    paired = edges.paired
    paired = edges.starts[paired[border[edges.tail[paired]] | border[edges.head[paired]]]]
    one = np.concatenate([edges.sides[paired], edges.returns[:, 0]])
    two = np.concatenate([edges.sides[paired + 1], edges.returns[:, 1]])
    opposite = corners[one] != corners[two]
    null = np.flatnonzero(corners == corners[after])
    first = np.concatenate([one, after[one], null])
    second = np.concatenate([np.where(opposite, after[two], two), np.where(opposite, two, after[two]), after[null]])
    kept = place[first] >= 0
    return joined(len(rows), place[first[kept]], place[second[kept]])[place[at]]


def _bearing(points: Coordinates, corners: Index, starts: Index, at: Index, leaves: Index) -> Reals:
    """Angle (k,) of the darts that leave vertices, counter-clockwise about the mean normal of the faces there."""
    vertex = corners[at[leaves]]
    base, of = np.unique(vertex, return_inverse=True)
    place = np.full(len(points), -1, dtype=np.intp)
    place[base] = np.arange(len(base))
    rows = np.flatnonzero(place[corners] >= 0)
    here = points[corners[rows]]
    spread = cross(points[corners[following(starts)[rows]]] - here, points[corners[preceding(starts)[rows]]] - here)
    normal: Reals = np.stack(
        [np.bincount(place[corners[rows]], spread[:, k], minlength=len(base)) for k in range(3)], axis=1
    )
    # Two axes across the normal; the one that the normal is least along gives the first.
    least = np.eye(3)[np.abs(normal).argmin(axis=1)]
    right = cross(normal, least)
    up = cross(normal, right)
    size = lengths(right), lengths(up)
    right, up = (axis / np.where(long > 0, long, 1.0)[:, None] for axis, long in zip((right, up), size, strict=True))
    step = points[corners[at[leaves ^ 1]]] - points[vertex]
    angle: Reals = np.arctan2(dot(step, up[of]), dot(step, right[of]))
    return angle
