# SPDX-License-Identifier: MIT
"""Convex hulls of groups of geometries, and which of them lie within others."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals

_FIRST = 1000  #: hulls of the first step


def hulls_of(geometry: Geometries, label: Index) -> Geometries:
    """Convex hull of each label.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None
    label : (n,) int
        0, 1, 2 ... without gaps.

    Returns
    -------
    (k,) shapely geometries
        Points and lines where a group has no width; empty where it has no vertex. Vertices that are not finite are
        passed over.
    """
    if not len(geometry):
        return geometry
    coordinates, row = shapely.get_coordinates(geometry, return_index=True)
    finite = np.isfinite(coordinates).all(axis=1)
    coordinates, row = coordinates[finite], row[finite]
    order = np.argsort(label[row], kind="stable")
    crowds = np.full(int(label.max()) + 1, shapely.MultiPoint(), dtype=object)
    shapely.multipoints(shapely.points(coordinates[order]), indices=label[row][order], out=crowds)
    hulls: Geometries = shapely.convex_hull(crowds)
    return hulls


def across(geometry: Geometries) -> Reals:
    """Diagonals (n,) of the boxes around geometries."""
    bounds = shapely.bounds(geometry).reshape(-1, 4)
    diagonal: Reals = np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])
    return diagonal


def outermost(hulls: Geometries, group: Index) -> Flags:
    """Hulls that lie within no other hull of their group.

    Parameters
    ----------
    hulls : (n,) convex shapely geometries
    group : (n,) int

    Returns
    -------
    (n,) bool
        Of equal hulls of one group, one is true; of empty ones, none.

    Notes
    -----
    O(n log n + near pairs). Does not look at hulls that overlap in part.
    """
    kept = np.zeros(len(hulls), dtype=bool)
    if not len(hulls):
        return kept
    order = np.lexsort([-shapely.length(hulls), -shapely.area(hulls)])
    order = order[~shapely.is_empty(hulls[order])]
    _, first = np.unique(_keys(hulls, group)[order], return_index=True)
    order = order[np.sort(first)]
    # Containment is transitive and what contains is larger: it is enough to ask the large ones that were kept. Steps
    # grow with what was kept, so that the tree is built a few times only.
    start, step = 0, _FIRST
    while start < len(order):
        block = order[start : start + step]
        roots = np.flatnonzero(kept)
        block = block[~_covered(hulls, group, block, roots)]
        kept[block[~_covered(hulls, group, block, block)]] = True
        start = step = start + step
    return kept


def _covered(hulls: Geometries, group: Index, inner: Index, outer: Index) -> Flags:
    i, j = shapely.STRtree(hulls[outer]).query(hulls[inner], predicate="covered_by")
    other = (group[inner[i]] == group[outer[j]]) & (inner[i] != outer[j])
    covered = np.zeros(len(inner), dtype=bool)
    covered[i[other]] = True
    return covered


def _keys(hulls: Geometries, group: Index) -> Index:
    """(n,) equal for equal hulls of one group."""
    texts = shapely.to_wkb(shapely.normalize(hulls)).tolist()
    numbers: dict[tuple[int, bytes], int] = {}
    keys = [numbers.setdefault(key, len(numbers)) for key in zip(group.tolist(), texts, strict=True)]
    return np.array(keys, dtype=np.intp)
