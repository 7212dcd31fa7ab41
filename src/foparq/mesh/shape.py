# SPDX-License-Identifier: MIT
"""Area, normal, shape and flatness of faces."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Index, Reals
from foparq.mesh.edges import Edges
from foparq.mesh.polygons import blocks, chosen, face_of, following
from foparq.mesh.vectors import cross, dot, lengths, overflowing

_TRIANGLE = 3
_HEADROOM = 2  #: powers of two that differences of coordinates need


class Sizes(NamedTuple):
    """How large faces are."""

    vectors: Reals  #: (f, 3) square metres, see :func:`area_vectors`
    span: Reals  #: (f,) square metres, not less than the square of the distance of any two corners


def area_vectors(points: Coordinates, corners: Index, starts: Index) -> Reals:
    """Area vectors of faces, after Newell.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int

    Returns
    -------
    (f, 3) float, square metres
        Perpendicular to the face, from the side on which its corners run counter-clockwise; as long as its area. Of a
        polygon that is not plane, the sum of its projections.

    Notes
    -----
    O(m). Every face is computed from its first corner, so that a far origin takes no digits.

    Examples
    --------
    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> area_vectors(square, np.arange(4), np.array([0, 4])).tolist()
    [[0.0, 0.0, 1.0]]
    """
    return sizes(points, corners, starts).vectors


@overflowing
def sizes(points: Coordinates, corners: Index, starts: Index) -> Sizes:
    """Area vectors of faces, and how far their corners lie apart at most.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int

    Notes
    -----
    O(m), see :func:`area_vectors`. What is thin has little area for its span: few faces need a closer look.
    """
    found, span = np.zeros((len(starts) - 1, 3)), np.zeros(len(starts) - 1)
    for first, stop in blocks(starts):
        at = starts[first : stop + 1] - starts[first]
        place = points.take(corners[starts[first] : starts[stop]], axis=0)
        base = place[at[:-1]]
        if bool((np.diff(at) == _TRIANGLE).all()):
            one, two = place[1::3] - base, place[2::3] - base
            found[first:stop] = cross(one, two)
            span[first:stop] = 2 * (dot(one, one) + dot(two, two))
            continue
        spoke = place - np.repeat(base, np.diff(at), axis=0)
        found[first:stop] = np.add.reduceat(cross(spoke, spoke[following(at)]), at[:-1], axis=0)
        span[first:stop] = 4 * np.maximum.reduceat(dot(spoke, spoke), at[:-1])
    found *= 0.5
    return Sizes(found, span)


class Triangles(NamedTuple):
    """What tells needles and caps among triangles."""

    shortest: Reals  #: (k,) metres
    longest: Reals  #: (k,) metres
    side: Index  #: (k,) the shortest side: 0 from the first corner to the second, 1, 2
    cosine: Reals  #: (k,) of the greatest angle; -1 where two corners are one place
    corner: Index  #: (k,) where the greatest angle is: 0, 1, 2


@overflowing
def triangle_shapes(points: Coordinates, triangles: Index) -> Triangles:
    """Sides and greatest angle of triangles.

    With CGAL (Polygon Mesh Processing), a needle is a triangle whose longest side is more than a given number of times
    as long as its shortest, ``longest > ratio * shortest``; a cap has an angle whose cosine is below a limit,
    ``cosine < limit``.

    Parameters
    ----------
    points : (n, 3) float, metres
    triangles : (k, 3) int

    Returns
    -------
    Triangles

    Notes
    -----
    O(k). Of equal sides or angles the first.
    """
    k = len(triangles)
    shapes = Triangles(np.empty(k), np.empty(k), np.empty(k, np.intp), np.empty(k), np.empty(k, np.intp))
    for first, stop in blocks(np.arange(0, 3 * k + 1, 3)):
        place = points.take(triangles[first:stop], axis=0)
        step = place[:, [1, 2, 0]] - place
        square = np.einsum("ijk,ijk->ij", step, step)
        length = np.sqrt(square)
        shapes.shortest[first:stop], shapes.longest[first:stop] = length.min(axis=1), length.max(axis=1)
        shapes.side[first:stop] = length.argmin(axis=1)
        # The angle at corner c lies between the sides that begin and end there, opposite to the longest side.
        dot = -np.einsum("ijk,ijk->ij", step, step[:, [2, 0, 1]])
        product = length * length[:, [2, 0, 1]]
        cosine = np.where(product > 0, dot / np.where(product > 0, product, 1.0), -1.0)
        shapes.cosine[first:stop] = np.clip(cosine.min(axis=1), -1.0, 1.0)
        shapes.corner[first:stop] = cosine.argmin(axis=1)
    return shapes


class Flatness(NamedTuple):
    """How far polygons are from being plane."""

    distance: (
        Reals  #: (f,) metres, greatest distance of a corner from the best plane; zero for triangles, NaN if untold
    )
    corner: Index  #: (f,) the corner where it is; the first one for triangles


@overflowing
def flatness(points: Coordinates, corners: Index, starts: Index) -> Flatness:
    """Greatest distance of a corner of each face from the plane that fits its corners best.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int

    Returns
    -------
    Flatness

    Notes
    -----
    The plane passes through the mean of the corners; the sum of the squares of their distances from it is least, as in
    val3dity's test 203. O(m).
    """
    distance, where = np.zeros(len(starts) - 1), starts[:-1].copy()
    rows = np.flatnonzero(np.diff(starts) > _TRIANGLE)
    some, begin = chosen(corners, starts, rows)
    for first, stop in blocks(begin):
        at = begin[first : stop + 1] - begin[first]
        size = np.diff(at)
        owner = face_of(at)
        place = points[some[begin[first] : begin[stop]]]
        # Powers of two take no digits; the square of a coordinate may be no number.
        power = np.frexp(np.maximum.reduceat(np.abs(place).max(axis=1), at[:-1]))[1] + _HEADROOM
        place = np.ldexp(place, -power[owner][:, None])
        place = place - place[at[:-1]][owner]
        place -= (np.add.reduceat(place, at[:-1], axis=0) / size[:, None])[owner]
        spread = np.add.reduceat(place[:, :, None] * place[:, None, :], at[:-1], axis=0)
        # Of corners too far apart for their squares no plane can be told.
        spread[~np.isfinite(spread).all(axis=(1, 2))] = np.nan
        normal = _normals(spread)
        away = np.abs(dot(place, normal[owner]))
        # Rising within each face: the last is the greatest.
        order = np.lexsort((-np.arange(len(away)), away, owner))[at[1:] - 1]
        distance[rows[first:stop]] = np.ldexp(away[order], power)
        where[rows[first:stop]] = starts[rows[first:stop]] + order - at[:-1]
    return Flatness(distance, where)


def _normals(spread: Reals) -> Reals:
    """Directions (k, 3) in which matrices (k, 3, 3) spread least; NaN for those that are no numbers."""
    normal = np.full((len(spread), 3), np.nan)
    told = np.flatnonzero(np.isfinite(spread[:, 0, 0]))
    normal[told] = np.linalg.eigh(spread[told])[1][:, :, 0]
    return normal


@overflowing
def folds(edges: Edges, vectors: Reals, starts: Index) -> tuple[Index, Reals]:
    """Fold angle at every edge where two faces meet.

    Parameters
    ----------
    edges : Edges
    vectors : (f, 3) float
        Area vectors of the faces, see :func:`area_vectors`.
    starts : (f + 1,) int

    Returns
    -------
    edge : (k,) int
        Edges with exactly two sides.
    angle : (k,) float, radians
        0 where one face goes on in the plane of the other, pi where it turns back upon it. NaN where a face has no
        area.

    Notes
    -----
    Where both sides run the same way one face is taken as turned over. O(m).
    """
    rows = edges.paired
    at = edges.starts[rows]
    face = face_of(starts)
    angle = np.empty(len(rows))
    for first in range(0, len(rows), 2**17):
        part = at[first : first + 2**17]
        one, two = vectors[face[edges.sides[part]]], vectors[face[edges.sides[part + 1]]]
        cosine = dot(one, two)
        cosine = np.where(edges.along[part] == edges.along[part + 1], -cosine, cosine)
        found = np.arctan2(lengths(cross(one, two)), cosine)
        flat = (lengths(one) > 0) & (lengths(two) > 0)
        angle[first : first + len(part)] = np.where(flat, found, np.nan)
    return rows, angle
