# SPDX-License-Identifier: MIT
"""Geometries that belong together because they are near."""

import numpy as np
import shapely

from foparq.columns import Geometries, Index
from foparq.geom.parts import is_finite
from foparq.geom.stretches import components, in_order_of_first

#: geometries asked in one step
_BLOCK = 20_000


def clusters(geometry: Geometries, *, gap: float) -> Index:
    """Connected components of geometries that are near each other.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None
    gap : float, metres
        Geometries not farther apart than this belong together.

    Returns
    -------
    (n,) int
        Label of the component, numbered in order of first rows. A geometry that is missing, empty or not finite is
        alone.

    Notes
    -----
    O(n log n + near pairs). Distances are planar: depth is not looked at.
    """
    if not len(geometry):
        return np.empty(0, dtype=np.intp)
    # An index over boxes that are no numbers finds nothing.
    geometry = geometry.copy()
    geometry[~is_finite(geometry)] = None
    label = _same_cell(geometry, gap)
    tree = shapely.STRtree(geometry)
    edges: list[Index] = []
    for start in range(0, len(geometry), _BLOCK):
        block = geometry[start : start + _BLOCK]
        i, j = tree.query(block, predicate="dwithin", distance=gap)
        # Edges between what is already one are dropped at once: a crowd has a great many.
        pair = np.stack([label[i + start], label[j]], axis=1)
        edges.append(np.unique(pair[pair[:, 0] < pair[:, 1]], axis=0))
    joined = np.concatenate(edges)
    return in_order_of_first(components(int(label.max()) + 1, joined[:, 0], joined[:, 1])[label])


def _same_cell(geometry: Geometries, gap: float) -> Index:
    """First grouping: geometries with their first vertices in one cell of a grid whose diagonal is ``gap``."""
    alone = np.arange(len(geometry))
    coordinates, row = shapely.get_coordinates(geometry, return_index=True)
    if not len(coordinates) or gap <= 0:
        return alone
    row, first = np.unique(row, return_index=True)
    corner = coordinates[first]
    # A little smaller than exact, so that rounding joins nothing that is not near.
    cell = np.floor((corner - corner.min(axis=0)) / (gap * 0.7))
    _, owner, inverse = np.unique(cell, axis=0, return_index=True, return_inverse=True)
    alone[row] = row[owner][inverse]
    return in_order_of_first(alone)
