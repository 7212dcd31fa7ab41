# SPDX-License-Identifier: MIT
"""How large the borders of a surface are."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Index, Reals
from foparq.mesh.borders import Borders
from foparq.mesh.polygons import blocks, face_of, following, members
from foparq.mesh.shape import area_vectors, flatness
from foparq.mesh.vectors import cross, lengths, overflowing

#: vertices of a border up to which every pair of them is measured
_EVERY_PAIR = 1024
#: directions in which longer borders are looked at; no direction is farther than 0.08 from one of them
_DIRECTIONS = 1024
#: of the root of the area of a border: how far it may leave its plane and be plane
_LEVEL = 0.1
#: distances computed in one step
_DISTANCES = 2**21


class BorderSizes(NamedTuple):
    """Sizes of borders."""

    length: Reals  #: (k,) metres
    diameter: Reals  #: (k,) metres, greatest distance of two vertices
    centroid: Coordinates  #: (k, 3) of the border line
    area: Reals  #: (k,) square metres: length of the area vector of the loop; NaN for a chain
    fan: Reals  #: (k,) square metres: area of the triangles from the centroid to the edges


@overflowing
def border_sizes(points: Coordinates, borders: Borders) -> BorderSizes:
    """Length, diameter, centroid and area of every border.

    Parameters
    ----------
    points : (n, 3) float, metres
    borders : Borders
        See :func:`foparq.mesh.borders.borders`.

    Returns
    -------
    BorderSizes
        ``area`` is that of the plane figure onto which the loop falls with the greatest area (Newell); ``fan`` is that
        of a plain fill and never less.

    Notes
    -----
    The diameter is exact for borders of up to 1,024 vertices; that of a longer one is taken between the vertices that
    are outermost in 1,024 directions, and less than 0.4 % too small. O(b) but for the diameter.
    """
    count = len(borders.last)
    found = BorderSizes(np.zeros(count), np.zeros(count), np.zeros((count, 3)), np.zeros(count), np.zeros(count))
    for first, stop in blocks(borders.starts):
        _measure(points, borders, found, first, stop)
    found.area[~borders.closed] = np.nan
    _diameters(points, borders, found.diameter)
    return found


def fill_areas(points: Coordinates, borders: Borders, sizes: BorderSizes) -> Reals:
    """Area of what would close every border.

    Parameters
    ----------
    points : (n, 3) float, metres
    borders : Borders
    sizes : BorderSizes
        Of these borders.

    Returns
    -------
    (k,) float, square metres
        Of a border that lies in a plane but for a tenth of the root of its area, that area, however ragged it is: the
        area vector. Of any other one that of the triangles from its centroid to its edges: lobes of the area vector
        that turn against each other would cancel. A chain is closed from its end to its beginning.

    Notes
    -----
    O(b).
    """
    begin, vertex = _vertices(borders, np.arange(len(borders.last)))
    if not len(borders.last):
        return np.zeros(0)
    flat = lengths(area_vectors(points, vertex, begin))
    level = flatness(points, vertex, begin).distance <= _LEVEL * np.sqrt(flat)
    return np.where(level, flat, np.maximum(flat, sizes.fan))


def _measure(points: Coordinates, borders: Borders, found: BorderSizes, first: int, stop: int) -> None:
    """All sizes but the diameter, of a range of borders."""
    at = borders.starts[first : stop + 1] - borders.starts[first]
    owner = face_of(at)
    vertex = borders.vertices[borders.starts[first] : borders.starts[stop]]
    to = vertex[following(at)]
    to[at[1:] - 1] = borders.last[first:stop]
    origin = points[vertex[at[:-1]]]
    here, there = points.take(vertex, axis=0) - origin[owner], points.take(to, axis=0) - origin[owner]
    step = there - here
    long = lengths(step)
    length = np.add.reduceat(long, at[:-1])
    # A border without length is one place.
    weight = long / np.where(length > 0, length, 1.0)[owner] / 2
    centre = np.add.reduceat((here + there) * weight[:, None], at[:-1], axis=0)
    found.length[first:stop] = length
    found.centroid[first:stop] = centre + origin
    vector = cross(here - centre[owner], there - centre[owner]) / 2
    whole = np.add.reduceat(vector, at[:-1], axis=0)
    found.area[first:stop] = lengths(whole)
    found.fan[first:stop] = np.add.reduceat(lengths(vector), at[:-1])


def _vertices(borders: Borders, rows: Index) -> tuple[Index, Index]:
    """Starts and vertices of borders, of chains with the last one."""
    open_rows = ~borders.closed[rows]
    begin, member = members(borders.starts, rows)
    vertex = np.insert(borders.vertices[member], begin[1:][open_rows], borders.last[rows][open_rows])
    begin[1:] += np.cumsum(open_rows)
    return begin, vertex


def _diameters(points: Coordinates, borders: Borders, diameter: Reals) -> None:
    """Write the diameter of every border; those of like size lie in one matrix, a row each."""
    size = np.diff(borders.starts) + ~borders.closed
    width = np.int64(1) << np.ceil(np.log2(np.maximum(size, 2))).astype(np.int64)
    for columns in np.unique(width[size <= _EVERY_PAIR]).tolist():
        alike = np.flatnonzero((width == columns) & (size <= _EVERY_PAIR))
        most = max(1, _DISTANCES // columns**2)
        for k in range(0, len(alike), most):
            rows = alike[k : k + most]
            begin, vertex = _vertices(borders, rows)
            # The first vertex fills each row up.
            place = np.minimum(begin[:-1, None] + np.arange(columns), len(vertex) - 1)
            inside = np.arange(columns) < np.diff(begin)[:, None]
            at = points[vertex[np.where(inside, place, begin[:-1, None])]]
            diameter[rows] = _greatest(at - at[:, :1])
    for row in np.flatnonzero(size > _EVERY_PAIR).tolist():
        place = points[_vertices(borders, np.array([row]))[1]]
        place = place - place[0]
        x, y, z = np.ascontiguousarray(place.T)
        extreme = np.unique([int(np.argmax(a * x + b * y + c * z)) for a, b, c in _directions().tolist()])
        diameter[row] = _greatest(place[extreme][None])[0]


def _greatest(place: Reals) -> Reals:
    """Greatest distance (k,) of two of the places (k, w, 3) of each row."""
    square = np.zeros((len(place), place.shape[1], place.shape[1]))
    for axis in range(3):
        square += np.square(place[:, :, None, axis] - place[:, None, :, axis])
    distance: Reals = np.sqrt(square.max(axis=(1, 2)))
    return distance


def _directions() -> Reals:
    """Unit vectors (d, 3) spread evenly: the spiral of Fibonacci."""
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(_DIRECTIONS)
    height = 1 - (2 * np.arange(_DIRECTIONS) + 1) / _DIRECTIONS
    aside = np.sqrt(1 - height**2)
    return np.stack([aside * np.cos(turn), aside * np.sin(turn), height], axis=1)
