# SPDX-License-Identifier: MIT
"""Intersections of a surface as faults: groups of crossing faces, and pairs that lie on each other."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index, Reals, union
from foparq.mesh.intersections import Intersections
from foparq.mesh.meetingclusters import clusters
from foparq.mesh.trianglepairs import Meeting
from foparq.mesh.vectors import lengths

_DIGITS = 9  #: to which lengths, areas and places are compared: what differs by rounding only is equal
_TINY = float(np.finfo(float).tiny)


class Groups(NamedTuple):
    """Groups of pairs of faces that cross or touch, by their longest meeting."""

    first: Index  #: (k,) lower face of the pair that has the longest meeting
    second: Index  #: (k,) the other face
    segment: Reals  #: (k, 2, 3) that meeting
    length: Reals  #: (k,) of all meetings of the group
    faces: Index  #: (m,) all faces of all groups, rising


class Overlaps(NamedTuple):
    """Pairs of faces that lie on each other."""

    face: Index  #: (k,) the smaller one
    other: Index  #: (k,)


def _pairs(found: Intersections, face: Index, kinds: tuple[Meeting, ...]) -> tuple[Index, Index, Index]:
    """Rows (k,) of pairs that meet in one of some ways, of triangles of two faces; and the faces, the lower first."""
    row = np.flatnonzero(np.isin(found.kind, [int(kind) for kind in kinds]))
    one, two = face[found.first[row]], face[found.second[row]]
    apart = one != two
    return row[apart], np.minimum(one, two)[apart], np.maximum(one, two)[apart]


def crossing_groups(found: Intersections, face: Index, corners: Index) -> Groups:
    """Crossing and touching faces, those that hang together in one group.

    Parameters
    ----------
    found : Intersections
        Of triangles.
    face : (t,) int
        Face of every triangle.
    corners : (t, 3) int
        Vertices of every triangle.

    Notes
    -----
    O(k log k). Pairs are of one group if a triangle of one is a triangle of the other, or shares a vertex with it. Of
    meetings of one length the first by its ends, so that the order of faces decides nothing.
    """
    row, one, two = _pairs(found, face, (Meeting.TRANSVERSAL, Meeting.CONTACT))
    segment = found.segment[row]
    label = clusters(found.first[row], found.second[row], segment, corners).label
    long = lengths(segment[:, 1] - segment[:, 0])
    shorter: Reals = -np.round(np.log(np.maximum(np.asarray(long, dtype=float), _TINY)), _DIGITS)
    order = np.lexsort([*_by_ends(segment), shorter, label])
    lead = order[np.diff(label[order], prepend=-1) > 0]
    total = np.zeros(len(lead))
    np.add.at(total, label, long)
    return Groups(one[lead], two[lead], segment[lead], total, union(one, two))


def _by_ends(segment: Reals) -> list[Reals]:
    """Keys of segments (k, 2, 3), the last one first: the ends by x, then y, then z, the lower one before the other."""
    ends = np.round(segment, _DIGITS)
    lower = np.zeros(len(ends), dtype=bool)
    for axis in (2, 1, 0):
        first, second = ends[:, 0, axis], ends[:, 1, axis]
        lower = np.where(first != second, first < second, lower)
    ends = np.where(lower[:, np.newaxis, np.newaxis], ends, ends[:, ::-1])
    return [ends[:, end, axis] for end in (1, 0) for axis in (2, 1, 0)]


def overlaps(found: Intersections, face: Index, areas: Reals, rank: Index) -> Overlaps:
    """Pairs of faces that lie in one plane and have area in common, the smaller face first.

    Parameters
    ----------
    found : Intersections
        Of triangles.
    face : (t,) int
        Face of every triangle.
    areas : (f,) float
        Area of every face.
    rank : (f,) int
        Which of two faces of one area is told as the smaller one.
    """
    _, lower, upper = _pairs(found, face, (Meeting.COPLANAR, Meeting.FOLD))
    one, two = np.unique(np.stack([lower, upper]), axis=1)  # triangles of one pair of faces are one pair
    like = np.isclose(areas[one], areas[two], rtol=10.0**-_DIGITS, atol=0.0)
    swapped = np.where(like, rank[two] < rank[one], areas[two] < areas[one])
    return Overlaps(np.where(swapped, two, one), np.where(swapped, one, two))
