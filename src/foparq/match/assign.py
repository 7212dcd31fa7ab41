# SPDX-License-Identifier: MIT
"""Places assigned to outlines: each to one at most, the nearer the better."""

import numpy as np
import shapely

from foparq.columns import Coordinates, Geometries, Index, Reals

UNASSIGNED = -1
_CENTRE = 1e-3  #: weight of the distance to the middle, which decides among outlines that hold the place alike


def assign(places: Coordinates, within: Reals, outlines: Geometries) -> Index:
    """Outline of each place.

    The sum of ``within**2 - distance**2`` over all pairs is the greatest that there is; distance is that to the
    outline, zero inside. Of assignments that are equal in this, those nearer to the middle of their outlines are
    better.

    Parameters
    ----------
    places : (n, 2)
    within : (n,) float
        Distance up to which an outline may be that of the place; greater than zero.
    outlines : (m,) shapely polygons

    Returns
    -------
    (n,) int
        Row of the outline, or ``UNASSIGNED``.

    Notes
    -----
    Solved by connected components of places and outlines that are near: O(n log m) where each has few candidates.
    """
    found: Index = np.full(len(places), UNASSIGNED, dtype=np.intp)
    if not len(places) or not len(outlines):
        return found
    spots = shapely.points(places)
    i, j = shapely.STRtree(outlines).query(spots, predicate="dwithin", distance=within)
    if not len(i):
        return found
    from scipy.optimize import linear_sum_assignment  # noqa: PLC0415 - slow to load
    from scipy.sparse import coo_array  # noqa: PLC0415
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    size = np.sqrt(np.maximum(shapely.area(outlines), np.finfo(float).tiny))
    aside = shapely.distance(spots[i], shapely.centroid(outlines[j])) / size[j]
    gain = within[i] ** 2 * (1 + _CENTRE / (1 + aside)) - shapely.distance(spots[i], outlines[j]) ** 2
    n = len(places)
    graph = coo_array((np.ones(len(i)), (i, n + j)), shape=(n + len(outlines),) * 2)
    label = connected_components(graph, directed=False)[1][i]
    order = np.argsort(label, kind="stable")
    for pairs in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        rows, row = np.unique(i[pairs], return_inverse=True)
        columns, column = np.unique(j[pairs], return_inverse=True)
        table = np.zeros((len(rows), len(columns)))
        table[row, column] = gain[pairs]
        one, other = linear_sum_assignment(table, maximize=True)
        kept = table[one, other] > 0
        found[rows[one[kept]]] = columns[other[kept]]
    return found
