# SPDX-License-Identifier: MIT
"""Points of a reference that no surface is near to, and where most of them are."""

import numpy as np

from foparq.check.surfaces.clusters import clusters
from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.findings.clouds import Place, Uncovered


def uncovered(points: Coordinates, distance: Reals, away: Flags, search: float, *, grouped: bool) -> Uncovered:
    """Uncovered points, and a place in the largest cluster of them.

    Parameters
    ----------
    points : (n, 3) metres
    distance : (n,) metres
    away : (n,) bool
        Points that are not covered.
    search : float, metres
        Cells of this width that have such a point, and touch, are one cluster.
    grouped : bool
        False: no cluster is looked for.

    Notes
    -----
    O(n log n).
    """
    rows = np.flatnonzero(away)
    if not len(rows) or not grouped:
        return Uncovered(len(rows))
    label = clusters(points[rows], search)
    sizes = np.bincount(label)
    # Of clusters of one size, that with the point farthest from the surface; of several such, the first in space.
    largest = rows[sizes[label] == sizes.max()]
    far = largest[distance[largest] == distance[largest].max()]
    return Uncovered(len(rows), place_of(points, first_of(points, far)), int(sizes.max()))


def first_of(points: Coordinates, rows: Index) -> int:
    """Of some points the one with the smallest x, then y, then z: the same, whatever the order of all."""
    x, y, z = points[rows].T
    return int(rows[np.lexsort((z, y, x))[0]])


def place_of(points: Coordinates, row: int) -> Place:
    """Coordinates of a point."""
    x, y, z = points[row].tolist()
    return x, y, z
