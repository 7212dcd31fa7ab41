# SPDX-License-Identifier: MIT
"""Points against linework: which point lies on which line, and how far from it the others are."""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
import shapely

from foparq.columns import Coordinates, Geometries, Index, Reals

NOTHING = -1  #: in ``Footing.line``: no line is there
_AT_ONCE = 1_000_000  #: vertices that are looked at together
_DEEP = 0.1  #: share of the vertices with a depth from which a drawing stands in space


class Footing(NamedTuple):
    """Linework on which n points lie."""

    line: Index  #: (n,) row of the nearest line, or ``NOTHING``
    distance: Reals  #: (n,) to it; to the nearest line in the plane where there is ``NOTHING``; infinite without lines
    vertex: Reals  #: (n,) to the nearest vertex of that line; infinite where there is ``NOTHING``


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


def footing(points: Coordinates, work: Linework, *, within: Reals, deep: bool) -> Footing:
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

    Returns
    -------
    Footing
        Of lines that are equally near the first.

    Notes
    -----
    O(n log m + vertices of the lines near a point).
    """
    n = len(points)
    found = Footing(np.full(n, NOTHING, dtype=np.intp), np.full(n, np.inf), np.full(n, np.inf))
    known = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not len(work.lines) or not len(known):
        return found
    lines, tree = work.lines, work.tree
    spots = shapely.points(points[known, :2])
    to_nearest, nearest = tree.query_nearest(spots, all_matches=False)
    found.distance[known[to_nearest]] = shapely.distance(spots[to_nearest], tree.geometries[nearest])
    near, line = tree.query(spots, predicate="dwithin", distance=within[known])
    row = known[near]
    for some in _parcels(shapely.get_num_coordinates(lines[line])):
        _stand(points, lines, row[some], line[some], found, within=within, deep=deep)
    return found


def _parcels(sizes: Index) -> list[slice]:
    """Slices of pairs with about ``_AT_ONCE`` vertices each."""
    number = np.cumsum(sizes) // _AT_ONCE
    edges = [0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(sizes)]
    return [slice(a, b) for a, b in pairwise(edges) if a < b]


def _stand(
    points: Coordinates, lines: Geometries, row: Index, line: Index, found: Footing, *, within: Reals, deep: bool
) -> None:
    """Enter the nearest of some pairs of point and line."""
    corner, pair = shapely.get_coordinates(lines[line], include_z=True, return_index=True)
    corner = np.nan_to_num(corner) if deep else corner[:, :2]
    target = points[row][:, : corner.shape[1]]
    to_vertex, to_line = np.full(len(line), np.inf), np.full(len(line), np.inf)
    np.minimum.at(to_vertex, pair, np.linalg.norm(corner - target[pair], axis=1))
    first = np.flatnonzero(pair[1:] == pair[:-1])
    start, step, of = corner[first], corner[first + 1] - corner[first], pair[first]
    square = np.einsum("ij,ij->i", step, step)
    share = np.einsum("ij,ij->i", target[of] - start, step) / np.where(square > 0, square, 1.0)
    foot = start + np.clip(share, 0.0, 1.0)[:, None] * step
    np.minimum.at(to_line, of, np.linalg.norm(foot - target[of], axis=1))
    to_line = np.minimum(to_line, to_vertex)
    order = np.lexsort((line, to_line, row))
    best = order[np.unique(row[order], return_index=True)[1]]
    standing = np.where(found.line[row[best]] == NOTHING, np.inf, found.distance[row[best]])
    best = best[(to_line[best] <= within[row[best]]) & (to_line[best] < standing)]
    found.line[row[best]], found.distance[row[best]] = line[best], to_line[best]
    found.vertex[row[best]] = to_vertex[best]
