# SPDX-License-Identifier: MIT
"""The edges of a surface, and the sides of faces that run along them."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index
from foparq.mesh.grouping import Rows, counting_order, narrow
from foparq.mesh.polygons import face_of, following

_PAIR = 2
_TRIANGLE = 3


class Edges(NamedTuple):
    """Undirected edges, sorted by their lower, then by their higher vertex.

    A side is named by the corner it begins at.
    """

    tail: Index  #: (e,) lower vertex
    head: Index  #: (e,) higher vertex
    starts: Index  #: (e + 1,) sides of edge i are ``sides[starts[i]:starts[i + 1]]``
    sides: Index  #: (s,) rising within each edge
    along: Flags  #: (s,) True where the side runs from tail to head
    returns: Index  #: (r, 2) pairs of sides along which one face runs there and back; they are not among ``sides``

    @property
    def valence(self) -> Index:
        """Number of sides (e,) that bound at each edge."""
        return np.diff(self.starts)

    @property
    def boundary(self) -> Index:
        """Edges (k,) where one face ends and none goes on."""
        return np.flatnonzero(self.valence == 1)

    @property
    def non_manifold(self) -> Index:
        """Edges (k,) where more than two sides meet."""
        return np.flatnonzero(self.valence > _PAIR)

    @property
    def paired(self) -> Index:
        """Edges (k,) where exactly two sides meet."""
        return np.flatnonzero(self.valence == _PAIR)

    @property
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

    O(m + vertices): two counting sorts, by the higher vertex, then by the lower one.

    Examples
    --------
    >>> found = edges(np.array([0, 1, 2, 2, 1, 3]), np.array([0, 3, 6]))
    >>> found.tail.tolist(), found.head.tolist(), found.valence.tolist()
    ([0, 0, 1, 1, 2], [1, 2, 2, 3, 3], [1, 1, 2, 1, 1])
    """
    below = int(corners.max()) + 1 if len(corners) else 0
    here: Rows = corners.astype(narrow(below), copy=False)
    to = here[following(starts)]
    low, high = np.minimum(here, to), np.maximum(here, to)
    order, _ = counting_order(high, below)
    again, _ = counting_order(low[order], below)
    order = order[again]
    low, high = low[order], high[order]
    real = low != high
    if not real.all():
        order, low, high = order[real], low[real], high[real]
    first = np.ones(len(order), dtype=bool)
    first[1:] = (low[1:] != low[:-1]) | (high[1:] != high[:-1])
    at = np.flatnonzero(first)
    along = here[order] == low
    begin = np.append(at, len(order)).astype(np.intp)
    sides = order.astype(np.intp)
    found = Edges(
        low[at].astype(np.intp), high[at].astype(np.intp), begin, sides, along, np.empty((0, 2), dtype=np.intp)
    )
    return _without_returns(found, starts)


def _without_returns(found: Edges, starts: Index) -> Edges:
    """The same edges without the sides along which one face runs there and back."""
    if bool((np.diff(starts) == _TRIANGLE).all()) and len(found.sides) == starts[-1]:
        # A triangle of three sides runs along none of them twice.
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


def side_links(found: Edges) -> tuple[Index, Index]:
    """Pairs of sides that meet at an edge: the first of each edge with every other one.

    Returns
    -------
    one, two : (k,) int
    """
    valence = found.valence
    begin = found.starts[:-1]
    other = np.ones(len(found.sides), dtype=bool)
    other[begin[valence > 0]] = False
    one = np.repeat(found.sides[begin[valence > 1]], valence[valence > 1] - 1)
    return one, found.sides[other]
