# SPDX-License-Identifier: MIT
"""Faces by where they lie: an order that no program changes when it writes a mesh anew."""

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.mesh.polygons import chosen, face_of

_KEYS = 3  #: lowest corners that are compared: two faces with three corners in common are copies, or fold together


def by_place(points: Coordinates, corners: Index, starts: Index, faces: Index) -> Index:
    """Chosen faces in the order of their lowest corners.

    Corners are compared by x, then y, then z, exactly; faces by their lowest corner, then by the next two.

    Parameters
    ----------
    points : (n, 3) float
    corners : (m,) int
    starts : (f + 1,) int
    faces : (k,) int

    Returns
    -------
    (k,) int
        The same faces. Those with the same lowest corners keep their order.

    Notes
    -----
    O(c log c) for c corners of the chosen faces.
    """
    if not len(faces):
        return faces
    some, begin = chosen(corners, starts, faces)
    place = points[some] + 0.0  # nought has one sign
    order = np.lexsort((place[:, 2], place[:, 1], place[:, 0]))
    apart = np.ones(len(order), dtype=bool)
    apart[1:] = (place[order[1:]] != place[order[:-1]]).any(axis=1)
    rank = np.empty(len(order), dtype=np.intp)
    rank[order] = np.cumsum(apart)
    owner = face_of(begin)
    lowest = np.lexsort((rank, owner))
    keys = [rank[lowest[begin[:-1] + n]] for n in range(_KEYS)]
    sorted_faces: Index = faces[np.lexsort(keys[::-1])]
    return sorted_faces


def first_of_each(label: Index, ordered: Index) -> Index:
    """The first face (k,) of every group, in the order of the labels.

    Parameters
    ----------
    label : (m,) int
        Group of every face, by number.
    ordered : (c,) int
        The faces of the groups, in any order that decides.
    """
    of = label[ordered]
    row = np.argsort(of, kind="stable")
    first: Index = ordered[row[np.diff(of[row], prepend=of[row][:1] - 1) != 0]] if len(row) else ordered
    return first
