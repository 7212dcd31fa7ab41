# SPDX-License-Identifier: MIT
"""Points against linework: which point lies on which line, and how far from it the others are."""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
import shapely

from foparq.columns import Coordinates, Flags, Geometries, Index, Reals

NOTHING = -1  #: in ``Footing.line``: no line is there
_AT_ONCE = 1_000_000  #: vertices that are looked at together
_LEAST = 1e-12  #: metres; nothing is nearer than that
_DEEP = 0.1  #: share of the vertices with a depth from which a drawing stands in space


class Footing(NamedTuple):
    """Linework on which n points lie."""

    line: Index  #: (n,) row of the nearest line, or ``NOTHING``
    distance: Reals  #: (n,) to it; to the nearest line in the plane where there is ``NOTHING``; infinite without lines
    vertex: Reals  #: (n,) to the nearest vertex of that line; infinite where there is ``NOTHING``
    at_vertex: Flags  #: (n,) that vertex is as near as a line must be


@dataclass(frozen=True, slots=True)
class Linework:
    """Lines and points with an index, built once; coordinates are right, up, depth."""

    lines: Geometries  #: (m,) shapely lines and points
    tree: shapely.STRtree  #: of the same, in the plane

    @classmethod
    def of(cls, lines: Geometries) -> Self:
        """Index of some lines."""
        return cls(lines, shapely.STRtree(shapely.force_2d(lines)))


def stands_in_space(lines: Geometries) -> bool:
    """Whether linework has depths: more than a tenth of its vertices are not at depth zero.

    Parameters
    ----------
    lines : (m,) shapely geometries
        In sheet coordinates: right, up, depth.
    """
    depth = np.nan_to_num(shapely.get_coordinates(lines, include_z=True)[:, 2])
    return bool(np.count_nonzero(depth) > _DEEP * len(depth))


def footing(
    points: Coordinates, work: Linework, *, within: Reals, deep: bool, rounding: Coordinates | None = None
) -> Footing:
    """Linework on which points lie.

    Parameters
    ----------
    points : (n, 3)
        Right, up, depth. A point with a coordinate that is not finite lies nowhere.
    work : Linework, m lines
        In the same frame.
    within : (n,) float
        Distance up to which a point lies on a line.
    deep : bool
        Whether depths are compared.
    rounding : (3,) float, optional
        By how much the coordinates may have been rounded, in addition: along that axis, and no other.

    Returns
    -------
    Footing
        Of lines that are equally near the first.

    Notes
    -----
    O(n log m + vertices of the lines near a point). What rounding may hide is a box; a point lies on a line that meets
    the ellipsoid around that box and the circle within which it lies anyway, and nearness is measured by it.
    """
    n, axes = len(points), 3 if deep else 2
    found = Footing(np.full(n, NOTHING, dtype=np.intp), np.full(n, np.inf), np.full(n, np.inf), np.zeros(n, dtype=bool))
    half = np.zeros(axes) if rounding is None else rounding[:axes]
    reach = within[:, None] + np.sqrt(axes) * half
    known = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not len(work.lines) or not len(known):
        return found
    lines, tree = work.lines, work.tree
    spots = shapely.points(points[known, :2])
    to_nearest, nearest = tree.query_nearest(spots, all_matches=False)
    found.distance[known[to_nearest]] = shapely.distance(spots[to_nearest], tree.geometries[nearest])
    near, line = tree.query(spots, predicate="dwithin", distance=within[known] + float(np.linalg.norm(half)))
    row = known[near]
    parcels = _parcels(shapely.get_num_coordinates(lines[line]))
    if not parcels:
        return found
    gaps = [_gaps(points[row[some]], lines[line[some]], reach[row[some]]) for some in parcels]
    to_line, to_vertex, foot, vertex = (np.concatenate(column) for column in zip(*gaps, strict=True))
    order = np.lexsort((line, to_line, row))
    best = order[np.unique(row[order], return_index=True)[1]]
    best = best[to_line[best] <= 1.0]
    found.line[row[best]], found.distance[row[best]] = line[best], foot[best]
    found.vertex[row[best]], found.at_vertex[row[best]] = vertex[best], to_vertex[best] <= 1.0
    return found


def _parcels(sizes: Index) -> list[slice]:
    """Slices of pairs with about ``_AT_ONCE`` vertices each."""
    number = np.cumsum(sizes) // _AT_ONCE
    edges = [0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(sizes)]
    return [slice(a, b) for a, b in pairwise(edges) if a < b]


class _Gaps(NamedTuple):
    # Of p pairs of point and line.
    to_line: Reals  #: (p,) in times the reach along each axis
    to_vertex: Reals  #: (p,) to the nearest vertex, likewise
    foot: Reals  #: (p,) metres to the place on the line that is nearest by that measure
    vertex: Reals  #: (p,) metres to that vertex


def _gaps(points: Coordinates, lines: Geometries, reach: Coordinates) -> _Gaps:
    axes = reach.shape[1]
    corner, pair = shapely.get_coordinates(lines, include_z=True, return_index=True)
    unit = np.maximum(reach, _LEAST)[pair]
    # From the point, so that large coordinates lose no digits.
    spot = (np.nan_to_num(corner)[:, :axes] - points[pair, :axes]) / unit
    far = np.linalg.norm(spot, axis=1)
    to_vertex, vertex = _least(len(lines), pair, far, np.linalg.norm(spot * unit, axis=1))
    first = np.flatnonzero(pair[1:] == pair[:-1])
    start, step, of = spot[first], spot[first + 1] - spot[first], pair[first]
    square = np.einsum("ij,ij->i", step, step)
    share = -np.einsum("ij,ij->i", start, step) / np.where(square > 0, square, 1.0)
    aside = start + np.clip(share, 0.0, 1.0)[:, None] * step
    to_line, foot = _least(len(lines), of, np.linalg.norm(aside, axis=1), np.linalg.norm(aside * unit[first], axis=1))
    alone = to_vertex <= to_line  # a point among the linework has no segments
    return _Gaps(np.where(alone, to_vertex, to_line), to_vertex, np.where(alone, vertex, foot), vertex)


def _least(n: int, of: Index, measure: Reals, metres: Reals) -> tuple[Reals, Reals]:
    """The least measure (n,) of each, and the metres that belong to it."""
    least, length = np.full(n, np.inf), np.full(n, np.inf)
    np.minimum.at(least, of, measure)
    tied = measure <= least[of]
    np.minimum.at(length, of[tied], metres[tied])
    return least, length
