# SPDX-License-Identifier: MIT
"""One point to look at on every geometry: on the line, within the area.

It depends on the shape only: a line drawn the other way round, a ring that starts elsewhere, or parts in another order
have the same place, to the last bit.
"""

from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals
from foparq.geom.parts import single_parts
from foparq.geom.ragged import last_not_above, running_sums

#: share of a length or an area, and units in the last place of a coordinate, below which a difference is rounding
_SHARE, _UNITS = 1e-9, 64


class _Candidates(NamedTuple):
    """Places that a geometry may have, of which the one of greatest size is taken."""

    place: Reals  #: (k, 3)
    size: Reals  #: (k,) length or area
    doubt: Reals  #: (k,) by how much the size may be off because of rounding


class _Rows(NamedTuple):
    """Vertices with finite coordinates, those of one run together."""

    vertex: Reals  #: (m, 3)
    run: Index  #: (m,) line or ring of each vertex, rising
    offsets: Index  #: (n + 1,)


def place_on(geometry: Geometries) -> Reals:
    """Point to look at on every geometry.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None
        Of any kind, valid or not.

    Returns
    -------
    (n, 3) float
        Of a line the point at half its length, of a closed one the first vertex by x, then y. Of an area a point
        within it: the middle of its widest stretch at about half its height. Of several parts that of the greatest:
        areas before lines before points; of equals the first by x, then y. Depth is interpolated between vertices;
        NaN where there is none. NaN throughout where no vertex is finite.

    Notes
    -----
    O(vertices log vertices). Vertices that are not finite are passed over.
    """
    parts, owner = single_parts(geometry)
    dimension = shapely.get_dimensions(parts)
    found = _Candidates(np.full((len(parts), 3), np.nan), np.zeros(len(parts)), np.zeros(len(parts)))
    with np.errstate(over="ignore", invalid="ignore"):  # a length may be beyond all numbers
        for kind, make in enumerate((_points, _halfway, _inside)):
            rows = np.flatnonzero(dimension == kind)
            if len(rows):
                for column, value in zip(found, make(parts[rows]), strict=True):
                    column[rows] = value
    placed = np.isfinite(found.place[:, 0])
    greatest = np.full(len(geometry), -1)
    np.maximum.at(greatest, owner[placed], dimension[placed])
    kept = np.flatnonzero(placed & (dimension == greatest[owner]))
    chosen = kept[_greatest(owner[kept], _Candidates(*(column[kept] for column in found)))]
    places = np.full((len(geometry), 3), np.nan)
    places[owner[chosen]] = found.place[chosen]
    return places


def _greatest(label: Index, of: _Candidates) -> Index:
    """Row of the greatest candidate of each label, of equals the first by place."""
    count = int(label.max()) + 1 if len(label) else 0
    most = np.full(count, -np.inf)
    np.maximum.at(most, label, of.size)
    kept = np.flatnonzero(of.size >= most[label] - of.doubt)
    if len(kept) == np.count_nonzero(most > -np.inf):
        return kept
    grid = _UNITS * np.spacing(np.nanmax(np.abs(of.place[kept, :2]), axis=1))
    x, y = (np.round(of.place[kept, axis] / grid) * grid for axis in (0, 1))
    exact = of.place[kept]
    order = np.lexsort((exact[:, 2], exact[:, 1], exact[:, 0], y, x, label[kept]))
    _, first = np.unique(label[kept][order], return_index=True)
    rows: Index = kept[order[first]]
    return rows


def _finite(geometry: Geometries) -> _Rows:
    vertex, run = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    sound = np.isfinite(vertex[:, :2]).all(axis=1)
    if not sound.all():
        vertex, run = vertex[sound], run[sound]
    vertex[~np.isfinite(vertex[:, 2]), 2] = np.nan
    return _Rows(vertex, run, np.searchsorted(run, np.arange(len(geometry) + 1)))


def _points(points: Geometries) -> _Candidates:
    rows = _finite(points)
    place = np.full((len(points), 3), np.nan)
    place[rows.run] = rows.vertex
    nothing = np.zeros(len(points))
    return _Candidates(place, nothing, nothing)


def _halfway(lines: Geometries) -> _Candidates:
    rows = _finite(lines)
    place = np.full((len(lines), 3), np.nan)
    drawn = np.flatnonzero(np.diff(rows.offsets) > 0)
    head, tail = rows.offsets[drawn], rows.offsets[drawn + 1] - 1
    start, end = rows.vertex[head], rows.vertex[tail]
    # Followed from the end that comes first, so that both ways of drawing compute the same.
    backwards = np.zeros(len(lines), dtype=bool)
    backwards[drawn] = _before(end, start)
    mirrored = (rows.offsets[:-1] + rows.offsets[1:] - 1)[rows.run] - np.arange(len(rows.run))
    vertex = rows.vertex[np.where(backwards[rows.run], mirrored, np.arange(len(rows.run)))]
    step = np.zeros(len(vertex))
    step[1:] = np.where(rows.run[1:] == rows.run[:-1], _apart(vertex[1:], vertex[:-1]), 0.0)
    along = running_sums(step, rows.offsets)
    length = along[tail]
    at = last_not_above(along, head, np.maximum(tail, head + 1), length / 2)
    after = np.minimum(at + 1, tail)
    rest = along[after] - along[at]
    share = np.where(rest > 0, (length / 2 - along[at]) / np.where(rest > 0, rest, 1.0), 0.0)
    place[drawn] = _between(vertex[at], vertex[after], share)
    closed = np.zeros(len(lines), dtype=bool)
    closed[drawn] = np.all(start[:, :2] == end[:, :2], axis=1)
    ring = np.flatnonzero(closed[rows.run])
    place[closed] = rows.vertex[ring][_first_by_place(rows.vertex[ring], rows.run[ring])]
    size = np.zeros(len(lines))
    size[drawn] = length
    return _Candidates(place, size, _SHARE * size + _noise(rows, len(lines)))


def _inside(polygons: Geometries) -> _Candidates:
    rings, owner = shapely.get_rings(polygons, return_index=True)
    rows = _finite(rings)
    polygon = owner[rows.run]
    count = len(polygons)
    # Every ring goes from its last vertex to its first: it does where all are finite.
    after = np.arange(1, len(polygon) + 1)
    filled = np.diff(rows.offsets) > 0
    after[rows.offsets[1:][filled] - 1] = rows.offsets[:-1][filled]
    one, two = rows.vertex, rows.vertex[after]
    noise = _noise(_Rows(rows.vertex, polygon, rows.offsets), count)
    level = _level(one[:, 1], polygon, noise)
    crosses = np.flatnonzero((one[:, 1] <= level[polygon]) != (two[:, 1] <= level[polygon]))
    upward = (one[crosses, 1] < two[crosses, 1])[:, None]
    low, high = np.where(upward, one[crosses], two[crosses]), np.where(upward, two[crosses], one[crosses])
    of = polygon[crosses]
    cut = _between(low, high, (level[of] - low[:, 1]) / (high[:, 1] - low[:, 1]))
    # Between the first and the second crossing of the level lies the area, between the third and the fourth ...
    order = np.lexsort((cut[:, 0], of))
    left, right, of = cut[order[::2]], cut[order[1::2]], of[order[::2]]
    middle = _between(left, right, np.full(len(left), 0.5))
    middle[:, 1] = level[of]
    width = right[:, 0] - left[:, 0]
    place = np.full((count, 3), np.nan)
    seen, first = np.unique(polygon, return_index=True)
    place[seen] = rows.vertex[_first_by_place(rows.vertex, polygon)] if len(first) else place[seen]
    widest = _greatest(of, _Candidates(middle, width, _SHARE * width + noise[of]))
    place[of[widest]] = middle[widest]
    area, around = shapely.area(polygons), np.bincount(polygon, weights=_apart(one, two), minlength=count)
    size = np.where(np.isfinite(area), area, 0.0)
    return _Candidates(place, size, _SHARE * size + noise * around)


def _level(y: Reals, polygon: Index, noise: Reals) -> Reals:
    """Height (p,) near the middle of each polygon at which it has no vertex."""
    low, high = np.full(len(noise), np.inf), np.full(len(noise), -np.inf)
    np.minimum.at(low, polygon, y)
    np.maximum.at(high, polygon, y)
    # A vertex at the middle but for rounding lies below it.
    upper = y > (low / 2 + high / 2 + noise)[polygon]
    under, over = np.full(len(noise), -np.inf), np.full(len(noise), np.inf)
    np.maximum.at(under, polygon[~upper], y[~upper])
    np.minimum.at(over, polygon[upper], y[upper])
    return under / 2 + over / 2


def _noise(rows: _Rows, count: int) -> Reals:
    """By how much (count,) a length may be off because coordinates are rounded."""
    largest = np.zeros(count)
    np.maximum.at(largest, rows.run, np.abs(rows.vertex[:, :2]).max(axis=1))
    noise: Reals = _UNITS * np.spacing(largest)
    return noise


def _apart(one: Reals, two: Reals) -> Reals:
    distance: Reals = np.hypot(one[:, 0] - two[:, 0], one[:, 1] - two[:, 1])
    return distance


def _between(one: Reals, two: Reals, share: Reals) -> Reals:
    """Points (k, 3) at a share of the way; where only one of them has a depth, that depth."""
    z0 = np.where(np.isnan(one[:, 2]), two[:, 2], one[:, 2])
    z1 = np.where(np.isnan(two[:, 2]), one[:, 2], two[:, 2])
    start, end = np.column_stack([one[:, :2], z0]), np.column_stack([two[:, :2], z1])
    mixed: Reals = start * (1 - share)[:, None] + end * share[:, None]
    return mixed


def _before(one: Reals, two: Reals) -> Flags:
    """True (k,) where the first place comes before the second by x, then y, then depth."""
    x, y, z = (one[:, axis] - two[:, axis] for axis in range(3))
    before: Flags = (x < 0) | ((x == 0) & ((y < 0) | ((y == 0) & (z < 0))))
    return before


def _first_by_place(vertex: Reals, label: Index) -> Index:
    """Row of the first vertex of each label by x, then y, then depth, in order of labels."""
    order = np.lexsort((vertex[:, 2], vertex[:, 1], vertex[:, 0], label))
    _, first = np.unique(label[order], return_index=True)
    rows: Index = order[first]
    return rows
