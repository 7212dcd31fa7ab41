# SPDX-License-Identifier: MIT
"""The edges of a surface, and the sides of faces that run along them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foparq.columns import Flags, Index
from foparq.mesh.compiled import compiled
from foparq.mesh.grouping import join, settle
from foparq.mesh.polygons import face_of

_PAIR = 2
_TRIANGLE = 3


@dataclass(frozen=True)
class Edges:
    """Undirected edges, sorted by their lower, then by their higher vertex.

    A side is named by the corner it begins at.
    """

    tail: Index  #: (e,) lower vertex
    head: Index  #: (e,) higher vertex
    starts: Index  #: (e + 1,) sides of edge i are ``sides[starts[i]:starts[i + 1]]``
    sides: Index  #: (s,) rising within each edge
    along: Flags  #: (s,) True where the side runs from tail to head
    returns: Index  #: (r, 2) pairs of sides along which one face runs there and back; they are not among ``sides``

    def plain(self, starts: Index) -> bool:
        """Whether all faces are triangles of three vertices, of which none comes back to an edge or a vertex."""
        return bool((np.diff(starts) == _TRIANGLE).all()) and len(self.sides) == starts[-1]

    @cached_property
    def valence(self) -> Index:
        """Number of sides (e,) that bound at each edge."""
        return np.diff(self.starts)

    @cached_property
    def boundary(self) -> Index:
        """Edges (k,) where one face ends and none goes on."""
        return np.flatnonzero(self.valence == 1)

    @cached_property
    def non_manifold(self) -> Index:
        """Edges (k,) where more than two sides meet."""
        return np.flatnonzero(self.valence > _PAIR)

    @cached_property
    def paired(self) -> Index:
        """Edges (k,) where exactly two sides meet."""
        return np.flatnonzero(self.valence == _PAIR)

    @cached_property
    def inconsistent(self) -> Index:
        """Edges (k,) where exactly two sides meet and both run the same way: the faces look to different sides."""
        rows = self.paired
        at = self.starts[rows]
        alike: Index = rows[self.along[at] == self.along[at + 1]]
        return alike


def edges(corners: Index, starts: Index) -> Edges:
    """Edge table of a surface.

    Parameters
    ----------
    corners : (m,) int
        Vertex of every corner.
    starts : (f + 1,) int
        First corner of every face.

    Returns
    -------
    Edges

    Notes
    -----
    A side whose ends are one vertex is no edge. A face that runs along an edge there and back does not bound there:
    those two sides are not counted, and the edge remains, if need be without any side. So a polygon that reaches its
    openings over bridges has no border along them, and a face fallen in to a line changes nothing of its neighbours.
    A face that runs along an edge twice the same way counts twice.

    O(m + vertices): two counting sorts, by the higher vertex, then by the lower one; compiled.

    Examples
    --------
    >>> found = edges(np.array([0, 1, 2, 2, 1, 3]), np.array([0, 3, 6]))
    >>> found.tail.tolist(), found.head.tolist(), found.valence.tolist()
    ([0, 0, 1, 1, 2], [1, 2, 2, 3, 3], [1, 1, 2, 1, 1])
    """
    below = int(corners.max()) + 1 if len(corners) else 0
    to = _ends(corners, starts)
    tail, head, begin, sides, along = _table(corners, to, _sides(corners, to, below))
    return _without_returns(Edges(tail, head, begin, sides, along, np.empty((0, 2), dtype=np.intp)), starts)


@compiled
def _ends(corners: Index, starts: Index) -> Index:
    """Vertex (m,) at which the side of each corner ends."""
    to = np.empty(len(corners), dtype=np.intp)
    for face in range(len(starts) - 1):
        first, last = starts[face], starts[face + 1] - 1
        for corner in range(first, last):
            to[corner] = corners[corner + 1]
        if last >= first:
            to[last] = corners[first]
    return to


@compiled
def _sides(corners: Index, to: Index, below: int) -> Index:
    """Sides whose ends differ, by lower end, then by higher end, then by number."""
    at_low, at_high = np.zeros(below + 1, dtype=np.intp), np.zeros(below + 1, dtype=np.intp)
    count = 0
    for corner in range(len(corners)):
        if corners[corner] != to[corner]:
            at_low[min(corners[corner], to[corner]) + 1] += 1
            at_high[max(corners[corner], to[corner]) + 1] += 1
            count += 1
    for vertex in range(below):
        at_low[vertex + 1] += at_low[vertex]
        at_high[vertex + 1] += at_high[vertex]
    by_high, sides = np.empty(count, dtype=np.intp), np.empty(count, dtype=np.intp)
    for corner in range(len(corners)):
        if corners[corner] != to[corner]:
            high = max(corners[corner], to[corner])
            by_high[at_high[high]] = corner
            at_high[high] += 1
    for row in range(count):
        corner = by_high[row]
        low = min(corners[corner], to[corner])
        sides[at_low[low]] = corner
        at_low[low] += 1
    return sides


@compiled
def _table(corners: Index, to: Index, sides: Index) -> tuple[Index, Index, Index, Index, Flags]:
    """Lower and higher end and first side of each edge, the sides, and whether they run to the higher end."""
    tail, head, begin = np.empty_like(sides), np.empty_like(sides), np.empty(len(sides) + 1, dtype=np.intp)
    along = np.empty(len(sides), dtype=np.bool_)
    edge = -1
    for row in range(len(sides)):
        here, there = corners[sides[row]], to[sides[row]]
        low, high = min(here, there), max(here, there)
        along[row] = here == low
        if edge < 0 or tail[edge] != low or head[edge] != high:
            edge += 1
            tail[edge], head[edge], begin[edge] = low, high, row
    begin[edge + 1] = len(sides)
    return tail[: edge + 1].copy(), head[: edge + 1].copy(), begin[: edge + 2].copy(), sides, along


def _without_returns(found: Edges, starts: Index) -> Edges:
    """The same edges without the sides along which one face runs there and back."""
    if found.plain(starts):
        return found
    face = face_of(starts)[found.sides]
    edge = np.repeat(np.arange(len(found.tail)), found.valence)
    again = np.zeros(len(face) + 1, dtype=bool)
    again[1:-1] = (face[1:] == face[:-1]) & (edge[1:] == edge[:-1])
    rows = np.flatnonzero(again[:-1] | again[1:])
    if not len(rows):
        return found
    group = np.cumsum(~again[rows]) - 1
    along = found.along[rows]
    ahead = np.bincount(group, along)
    least = np.minimum(ahead, np.bincount(group) - ahead)
    # The rank of each side among those of its group that run its way.
    run = np.cumsum(along)
    run = np.where(along, run, np.arange(1, len(rows) + 1) - run)
    first = np.flatnonzero(~again[rows])
    ran: Index = np.cumsum(along)[first] - along[first]
    before = np.where(along, ran[group], (first - ran)[group])
    kept = np.ones(len(face), dtype=bool)
    back = run - before <= least[group]
    kept[rows[back]] = False
    # As many run there as back in every group, so that both lists go alike.
    returns = np.stack([found.sides[rows[back & along]], found.sides[rows[back & ~along]]], axis=1)
    begin = np.zeros_like(found.starts)
    np.cumsum(np.bincount(edge[kept], minlength=len(found.tail)), out=begin[1:])
    return Edges(found.tail, found.head, begin, found.sides[kept], found.along[kept], returns)


def edge_of_side(found: Edges, corners: int) -> Index:
    """Edge (m,) that the side of each of m corners bounds at; -1 where it bounds at none."""
    edge = np.full(corners, -1, dtype=np.intp)
    edge[found.sides] = np.repeat(np.arange(len(found.tail)), found.valence)
    return edge


def faces_joined(found: Edges, face: Index, count: int, *, agreeing: bool) -> Index:
    """Lowest face (count,) of those that each face is joined to over edges.

    Parameters
    ----------
    face : (m,) int
        Of every corner.
    count : int
        Number of faces.
    agreeing : bool
        Only edges join where exactly two sides meet, and run opposite ways; else all do.
    """
    label: Index = np.arange(count, dtype=np.intp)
    _join_faces(label, face, found.starts, found.sides, found.along, agreeing)
    return label


@compiled
def _join_faces(label: Index, face: Index, begin: Index, sides: Index, along: Flags, agreeing: bool) -> None:  # noqa: FBT001 - a kernel
    for edge in range(len(begin) - 1):
        first, stop = begin[edge], begin[edge + 1]
        if agreeing and (stop - first != _PAIR or along[first] == along[first + 1]):
            continue
        for row in range(first + 1, stop):
            join(label, face[sides[first]], face[sides[row]])
    settle(label)
