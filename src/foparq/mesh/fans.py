# SPDX-License-Identifier: MIT
"""The fans of faces around vertices."""

import numpy as np

from foparq.columns import Index
from foparq.mesh.compiled import compiled
from foparq.mesh.edges import Edges
from foparq.mesh.grouping import counting_order, join, join_all
from foparq.mesh.polygons import face_of, following


def fans(corners: Index, starts: Index, edges: Edges, *, count: int) -> Index:
    """Number of fans of faces around each vertex.

    Two faces of a vertex are of one fan if a chain of faces at the vertex leads from one to the other, each sharing
    with the next an edge that ends at the vertex. A vertex with more than one fan is not manifold, whatever its edges
    are.

    Parameters
    ----------
    corners : (m,) int
    starts : (f + 1,) int
    edges : Edges
        Of these corners, see :func:`foparq.mesh.edges.edges`.
    count : int
        Number of vertices.

    Returns
    -------
    (count,) int
        Zero for a vertex that no face uses.

    Notes
    -----
    Corners of one face at one vertex are of one fan: a polygon that touches itself is a fault of another kind. A face
    fallen in to a line, of which no side bounds, is of no fan.
    O(m log m) at worst, linear on surfaces.
    """
    label: Index = np.arange(len(corners), dtype=np.intp)
    _join_corners(label, corners, following(starts), edges.starts, edges.sides)
    join_all(label, *_own_corners(corners, starts, edges))
    # A face that bounds with a side that ends at a vertex does so with another one that begins there.
    bounds = np.zeros(len(corners), dtype=bool)
    bounds[edges.sides] = True
    counted = np.zeros(len(corners), dtype=bool)
    counted[label[bounds]] = True
    found: Index = np.bincount(corners[counted], minlength=count)
    return found


@compiled
def _join_corners(label: Index, corners: Index, after: Index, begin: Index, sides: Index) -> None:
    """Join the corners at both ends of every edge."""
    for edge in range(len(begin) - 1):
        for row in range(begin[edge] + 1, begin[edge + 1]):
            one, two = sides[begin[edge]], sides[row]
            if corners[one] == corners[two]:
                join(label, one, two)
                join(label, after[one], after[two])
            else:
                # The sides run opposite ways: the corner that begins one lies at the vertex where the other ends.
                join(label, one, after[two])
                join(label, after[one], two)


def _own_corners(corners: Index, starts: Index, edges: Edges) -> tuple[Index, Index]:
    """Pairs of corners of one face at one vertex."""
    if edges.plain(starts):
        none = np.empty(0, dtype=np.intp)
        return none, none
    face = face_of(starts)
    order, _ = counting_order(corners, int(corners.max()) + 1 if len(corners) else 0)
    again = np.flatnonzero((corners[order[1:]] == corners[order[:-1]]) & (face[order[1:]] == face[order[:-1]]))
    return order[again].astype(np.intp), order[again + 1].astype(np.intp)
