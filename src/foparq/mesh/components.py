# SPDX-License-Identifier: MIT
"""Pieces of a surface that share no edge."""

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from foparq.columns import Coordinates, Index, Reals
from foparq.mesh.edges import Edges, faces_joined
from foparq.mesh.grouping import numbered
from foparq.mesh.polygons import blocks, face_of
from foparq.mesh.vectors import lengths, overflowing

#: corners of each component that are measured before the others
_FIRST = 8
#: corners measured in one step
_CHUNK = 2**14


class Components(NamedTuple):
    """Faces joined over shared edges, in order of their lowest faces."""

    label: Index  #: (f,) component of every face
    lowest: Index  #: (k,) lowest face
    faces: Index  #: (k,) number of faces
    area: Reals  #: (k,) square metres
    low: Coordinates  #: (k, 3) lowest corner of the box
    high: Coordinates  #: (k, 3) highest corner of the box

    @property
    def largest(self) -> int:
        """The component of greatest area; of equals that of more faces, then the first. There must be one."""
        return int(np.lexsort((-self.faces, -self.area))[0])

    @property
    def main(self) -> int:
        """The component of most faces; of equals that of greater area, then the first.

        One stray face, however large, makes no body.
        """
        return int(np.lexsort((-self.area, -self.faces))[0])


def components(points: Coordinates, corners: Index, starts: Index, edges: Edges, area: Reals) -> Components:
    """Components of faces over shared edges.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int
    edges : Edges
        Of these corners. All sides of an edge belong together, also where there are more than two.
    area : (f,) float
        Area of every face, see :func:`foparq.mesh.shape.area_vectors`.

    Returns
    -------
    Components

    Notes
    -----
    Faces that share a vertex only are apart; so is a face fallen in to a line, of which no side bounds.
    O(m log m) at worst, linear on surfaces.
    """
    label, lowest = numbered(faces_joined(edges, face_of(starts), len(starts) - 1, agreeing=False))
    count = len(lowest)
    faces = np.bincount(label, minlength=count)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    for first, stop in blocks(starts):
        at = starts[first:stop] - starts[first]
        place = points.take(corners[starts[first] : starts[stop]], axis=0)
        mine = label[first:stop]
        if (mine == mine[0]).all():
            low[mine[0]] = np.minimum(low[mine[0]], place.min(axis=0))
            high[mine[0]] = np.maximum(high[mine[0]], place.max(axis=0))
            continue
        for axis in range(3):
            np.minimum.at(low[:, axis], mine, np.minimum.reduceat(place[:, axis], at))
            np.maximum.at(high[:, axis], mine, np.maximum.reduceat(place[:, axis], at))
    total = np.bincount(label, area, minlength=count).astype(np.float64)
    return Components(label, lowest, faces, total, low, high)


@overflowing
def vertex_distance(points: Coordinates, corners: Index, starts: Index, found: Components, *, to: int) -> Reals:
    """Distance of every component from one of them, between vertices.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int
    found : Components
        Of these faces.
    to : int
        The component to measure from, as a rule the largest.

    Returns
    -------
    (k,) float, metres
        Least distance of two vertices: an upper bound of the distance of the surfaces, which may be nearer between
        their vertices. Zero for ``to`` itself and where a vertex is shared.

    Notes
    -----
    O(n log n).
    """
    distance = np.full(len(found.faces), np.inf)
    distance[to] = 0.0
    owner = found.label[face_of(starts)]
    main = np.zeros(len(points), dtype=bool)
    main[corners[owner == to]] = True
    asked = np.flatnonzero(owner != to)
    if not len(asked):
        return distance
    tree = cKDTree(points[main], balanced_tree=False, compact_nodes=False)
    asked = asked[np.argsort(owner[asked], kind="stable")]
    place = _place_in_run(owner[asked])
    # A few vertices of each component first: what they find spares the others long ways.
    for some in (asked[place < _FIRST], asked[place >= _FIRST]):
        for start in range(0, len(some), _CHUNK):
            part = some[start : start + _CHUNK]
            at, of = points[corners[part]], owner[part]
            box = np.maximum(np.maximum(found.low[to] - at, at - found.high[to]), 0.0)
            near = np.flatnonzero(lengths(box) < distance[of])
            limit = distance[of[near]].max(initial=0.0)
            gap, _ = tree.query(at[near], distance_upper_bound=limit)
            np.minimum.at(distance, of[near], gap)
    return distance


def _place_in_run(value: Index) -> Index:
    """Place of each row among those of equal value; equal values stand together."""
    begin = np.flatnonzero(np.diff(value, prepend=-1))
    return np.arange(len(value)) - np.repeat(begin, np.diff(np.append(begin, len(value))))
