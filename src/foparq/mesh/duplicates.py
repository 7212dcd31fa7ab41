# SPDX-License-Identifier: MIT
"""Faces that are there twice."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index
from foparq.mesh.compiled import compiled
from foparq.mesh.grouping import Words, likely_groups, mixed

#: sides compared in one step
_SIDES = 2**20
#: the bit that says which way a side runs
_WAY = np.uint64(1)
_HALF = np.uint64(32)  #: bits of a side that hold one vertex
_NOTHING = np.uint64(0)


class Duplicates(NamedTuple):
    """Faces that repeat an earlier one, rising."""

    face: Index  #: (k,)
    original: Index  #: (k,) the first face of the same sides
    turned: Flags  #: (k,) True where the face runs the other way round than the original


def duplicate_faces(corners: Index, starts: Index) -> Duplicates:
    """Faces with the same sides as an earlier face, in either direction.

    Triangles have the same sides if they have the same three vertices. Of polygons the cyclic order counts too: two
    that share their vertices but join them otherwise are different.

    Parameters
    ----------
    corners : (m,) int
        Of the welded surface, if faces at the same place shall be found.
    starts : (f + 1,) int

    Returns
    -------
    Duplicates

    Notes
    -----
    O(m log m): a sum over the sides of a face that knows no order is sorted, and what agrees in it is compared side by
    side. Sides whose ends are one vertex are left out.

    Examples
    --------
    >>> duplicate_faces(np.array([0, 1, 2, 1, 0, 2]), np.array([0, 3, 6]))
    Duplicates(face=array([1]), original=array([0]), turned=array([ True]))
    """
    key = _sums(corners, starts)
    rows, begin = likely_groups(key)
    original = np.repeat(rows[begin[:-1]], np.diff(begin))
    face: list[Index] = []
    of: list[Index] = []
    turned: list[Flags] = []
    pending = np.flatnonzero(rows != original)
    while len(pending):
        same, back = _same_sides(corners, starts, rows[pending], original[pending])
        found = pending[same]
        face.append(rows[found])
        of.append(original[found])
        turned.append(back[same])
        # Faces of like keys that differ: the first of those left of each group is looked at in turn.
        pending = pending[~same]
        owner = original[pending]
        first = np.ones(len(pending), dtype=bool)
        first[1:] = owner[1:] != owner[:-1]
        original[pending] = rows[pending][first][np.cumsum(first) - 1]
        pending = pending[~first]
    empty = [np.empty(0, dtype=np.intp)]
    all_faces, all_of = np.concatenate(empty + face), np.concatenate(empty + of)
    all_turned = np.concatenate([np.empty(0, dtype=bool), *turned])
    order = np.argsort(all_faces)
    return Duplicates(all_faces[order], all_of[order], all_turned[order])


def _sums(corners: Index, starts: Index) -> Words:
    """Key (f,) of the sides of every face, whatever their order and direction."""
    return mixed(_sums_of_sides(corners.astype(np.uint64), starts))


@compiled
def _sums_of_sides(corners: Words, starts: Index) -> Words:
    total = np.zeros(len(starts) - 1, dtype=np.uint64)
    for face in range(len(starts) - 1):
        here = corners[starts[face + 1] - 1] if starts[face + 1] > starts[face] else _NOTHING
        for corner in range(starts[face], starts[face + 1]):
            to = corners[corner]
            if here != to:
                total[face] += mixed((min(here, to) << _HALF) ^ max(here, to))
            here = to
    return total


def _same_sides(corners: Index, starts: Index, one: Index, two: Index) -> tuple[Flags, Flags]:
    """Whether k pairs of faces have the same sides, and whether they do not run them the same way."""
    same, turned = np.zeros(len(one), dtype=bool), np.zeros(len(one), dtype=bool)
    width = np.maximum(starts[one + 1] - starts[one], starts[two + 1] - starts[two])
    for size in np.unique(width).tolist():
        alike = np.flatnonzero(width == size)
        for k in range(0, len(alike), max(1, _SIDES // size)):
            rows = alike[k : k + max(1, _SIDES // size)]
            left, right = (_sorted_sides(corners, starts, faces[rows], size) for faces in (one, two))
            same[rows] = ((left | _WAY) == (right | _WAY)).all(axis=1)
            turned[rows] = (left != right).any(axis=1)
    return same, turned


def _sorted_sides(corners: Index, starts: Index, faces: Index, width: int) -> Words:
    """Sides (k, width) of faces, sorted within each: lower vertex, higher vertex, and the way between them.

    Sides whose ends are one vertex, and places beyond the last side, come last and are all the same.
    """
    count = starts[faces + 1] - starts[faces]
    place = np.arange(width)
    inside = place < count[:, None]
    here = starts[faces][:, None] + np.where(inside, place, 0)
    there = starts[faces][:, None] + np.where(place + 1 < count[:, None], place + 1, 0)
    vertex, to = corners[here], corners[there]
    # Vertices are numbered in 31 bits: as many as two thousand million.
    key: Words = (np.minimum(vertex, to) << 33 | np.maximum(vertex, to) << 1 | (vertex < to)).astype(np.uint64)
    key[~inside | (vertex == to)] = np.iinfo(np.uint64).max
    key.sort(axis=1)
    return key
