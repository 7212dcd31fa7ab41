# SPDX-License-Identifier: MIT
"""Polygons as triangles of their own vertices."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.mesh.polygons import blocks, chosen, face_of, following
from foparq.mesh.shape import area_vectors
from foparq.mesh.vectors import overflowing

_TRIANGLE = 3
#: corners from which a fan is tried before a polygon is cut ear by ear; two are enough for quadrangles
_TRIED = 4
#: corners beyond which the triangles of a fan are needles that all meet in one vertex, and take long to tell apart
_SHEAF = 64


class Triangulation(NamedTuple):
    """Triangles of polygons, face by face."""

    triangles: Index  #: (t, 3) vertices, counter-clockwise as the polygon's are
    face: Index  #: (t,) face of each triangle, rising
    left: Index  #: (k,) faces that were not cut: too many corners, no area, or a ring that crosses itself


@overflowing
def triangulate(points: Coordinates, corners: Index, starts: Index, *, most: int) -> Triangulation:
    """Triangles that fill the polygons, without new vertices.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int
    most : int
        Polygons with more corners than this are left out, unless they are convex.

    Returns
    -------
    Triangulation
        Triangles are passed through as they are, whatever their area; where all faces are triangles, ``triangles`` is
        a view of ``corners``.

    Notes
    -----
    A polygon is looked at in its own plane, along the axis that its area vector is nearest to. If all triangles of a
    fan from one of its first four corners turn the right way, it is that fan; so are all convex polygons and simple
    quadrangles. Of more than 64 corners, a convex one loses every second corner until three are left. Others lose one
    ear after another: O(c^2) for c corners. Bridges to openings may be part of the ring.
    A ring that crosses itself may pass for a fan, or is ``left``.
    """
    size = np.diff(starts)
    if bool((size == _TRIANGLE).all()):
        return Triangulation(corners.reshape(-1, _TRIANGLE), np.arange(len(size)), np.empty(0, dtype=np.intp))
    three = np.flatnonzero(size == _TRIANGLE)
    parts = [corners[starts[three][:, None] + np.arange(_TRIANGLE)]]
    owners = [three]
    rows = np.flatnonzero(size > _TRIANGLE)
    some, begin = chosen(corners, starts, rows)
    flat, sound = _flattened(points, some, begin)
    open_rows = np.flatnonzero(sound)
    left = [rows[~sound]]
    for turn in range(_TRIED):
        ring, ring_starts = _turned(begin, open_rows, turn)
        good = _is_fan(flat[ring], ring_starts)
        large = np.diff(ring_starts) > _SHEAF
        fan, owner = _fans(ring, ring_starts, np.flatnonzero(good & ~large))
        parts.append(some[fan])
        owners.append(rows[open_rows[owner]])
        for row in np.flatnonzero(good & large).tolist():
            ring_of = ring[ring_starts[row] : ring_starts[row + 1]]
            halves = _halves(flat[ring_of])
            if halves is None and len(ring_of) > most:
                left.append(rows[open_rows[row : row + 1]])
                continue
            cut = _fan(len(ring_of)) if halves is None else halves
            parts.append(some[ring_of[cut]])
            owners.append(np.full(len(cut), rows[open_rows[row]]))
        open_rows = open_rows[~good]
    for row in open_rows.tolist():
        ring_of = np.arange(begin[row], begin[row + 1])
        ears = _ears(flat[ring_of]) if len(ring_of) <= most else None
        if ears is None:
            left.append(rows[row : row + 1])
        else:
            parts.append(some[ring_of[ears]])
            owners.append(np.full(len(ears), rows[row]))
    face = np.concatenate(owners)
    order = np.argsort(face, kind="stable")
    return Triangulation(np.concatenate(parts)[order], face[order], np.sort(np.concatenate(left)))


def _flattened(points: Coordinates, corners: Index, starts: Index) -> tuple[Reals, Flags]:
    """Corners (m, 2) in the plane of two axes, counter-clockwise, from the first corner; and the faces with an area."""
    vector = area_vectors(points, corners, starts)
    axis = np.abs(vector).argmax(axis=1)
    along = np.take_along_axis(vector, axis[:, None], axis=1)[:, 0]
    first, second = (
        np.where(along > 0, (axis + 1) % 3, (axis + 2) % 3),
        np.where(along > 0, (axis + 2) % 3, (axis + 1) % 3),
    )
    flat = np.empty((len(corners), 2))
    for start, stop in blocks(starts):
        at = slice(starts[start], starts[stop])
        owner = face_of(starts[start : stop + 1] - starts[start]) + start
        place = points[corners[at]] - points[corners[starts[owner]]]
        row = np.arange(len(place))
        flat[at, 0], flat[at, 1] = place[row, first[owner]], place[row, second[owner]]
    return flat, along != 0


def _turned(starts: Index, rows: Index, turn: int) -> tuple[Index, Index]:
    """Corners of chosen polygons from corner ``turn`` on, and where each begins."""
    count = starts[rows + 1] - starts[rows]
    begin = np.zeros(len(rows) + 1, dtype=np.intp)
    np.cumsum(count, out=begin[1:])
    owner = face_of(begin)
    place = np.arange(begin[-1]) - begin[owner] + turn
    return starts[rows[owner]] + place % count[owner], begin


def _cross(a: Reals, b: Reals, c: Reals) -> Reals:
    """Twice the area (k,) of plane triangles (k, 2), above zero if counter-clockwise."""
    product: Reals = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
    return product


def _is_fan(flat: Reals, starts: Index) -> Flags:
    """Whether all triangles from the first corner of each polygon have an area and turn the right way."""
    if len(starts) == 1:
        return np.zeros(0, dtype=bool)
    area = _cross(flat[starts[:-1]][face_of(starts)], flat, flat[following(starts)])
    # The first and the last side begin or end at the first corner.
    area[starts[:-1]] = area[starts[1:] - 1] = 1.0
    return np.asarray(np.logical_and.reduceat(area > 0, starts[:-1]))


def _fans(ring: Index, starts: Index, rows: Index) -> tuple[Index, Index]:
    """Triangles (t, 3) of the fans from the first corners of chosen polygons, and the polygon of each."""
    count = starts[rows + 1] - starts[rows] - 2
    owner = np.repeat(rows, count)
    begin = np.cumsum(count) - count
    place = np.arange(len(owner)) - np.repeat(begin, count) + starts[owner] + 1
    return np.stack([ring[starts[owner]], ring[place], ring[place + 1]], axis=1), owner


def _fan(count: int) -> Index:
    """Triangles (c - 2, 3) of the fan from the first of c corners."""
    place = np.arange(1, count - 1)
    return np.stack([np.zeros_like(place), place, place + 1], axis=1)


def _halves(flat: Reals) -> Index | None:
    """Triangles (c - 2, 3) of a strictly convex polygon (c, 2), counter-clockwise, that is a fan; else None.

    Every second corner is cut off, then every second of the rest: no vertex has more than two for each turn.
    """
    if not bool((_cross(np.roll(flat, 1, axis=0), flat, np.roll(flat, -1, axis=0)) > 0).all()):
        return None
    ring, found = np.arange(len(flat)), []
    while len(ring) >= _TRIANGLE:
        tip = np.arange(1, len(ring), 2)
        cut = np.stack([ring[tip - 1], ring[tip], ring[(tip + 1) % len(ring)]], axis=1)
        if not bool((_cross(flat[cut[:, 0]], flat[cut[:, 1]], flat[cut[:, 2]]) > 0).all()):
            return None
        found.append(cut)
        ring = np.delete(ring, tip)
    return np.concatenate(found)


def _ears(flat: Reals) -> Index | None:
    """Triangles (c - 2, 3) of a simple polygon (c, 2), counter-clockwise; None where no ear is found."""
    ring = list(range(len(flat)))
    found: list[tuple[int, int, int]] = []
    here, tried = 0, 0
    while len(ring) > _TRIANGLE:
        if tried > len(ring):
            return None
        here %= len(ring)
        ear = ring[here - 1], ring[here], ring[(here + 1) % len(ring)]
        if _is_ear(flat, ring, ear):
            found.append(ear)
            del ring[here]
            # The next but one: ears taken in turn make no sheaf of needles.
            here, tried = here + 1, 0
        else:
            here, tried = here + 1, tried + 1
    last = (ring[0], ring[1], ring[2])
    if not float(_cross(*flat[list(last)])) > 0:
        return None
    return np.array([*found, last], dtype=np.intp)


def _is_ear(flat: Reals, ring: list[int], ear: tuple[int, int, int]) -> bool:
    """Whether a triangle of three corners in a row turns the right way and holds no other corner."""
    a, b, c = flat[list(ear)]
    if not float(_cross(a, b, c)) > 0:
        return False
    other = flat[ring]
    inside = (_cross(a, b, other) >= 0) & (_cross(b, c, other) >= 0) & (_cross(c, a, other) >= 0)
    # Ends of a bridge lie at a corner of the ear; what they lead to is looked at by itself.
    for corner in (a, b, c):
        inside &= (other != corner).any(axis=1)
    return not bool(inside.any())
