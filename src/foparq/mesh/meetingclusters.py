# SPDX-License-Identifier: MIT
"""Intersections of a mesh that belong together, because their triangles are the same or share a point."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from foparq.columns import Index, Reals, union


class Clusters(NamedTuple):
    """c clusters of k pairs of triangles.

    Attributes
    ----------
    label : (k,) int
        Cluster of each pair, numbered in the order of their first pairs.
    pairs, triangles : (c,) int
        How many pairs and how many triangles a cluster has.
    low, high : (c, 3) float
        Box around the places where its triangles meet.
    """

    label: Index
    pairs: Index
    triangles: Index
    low: Reals
    high: Reals


def clusters(first: Index, second: Index, segment: Reals, corners: Index) -> Clusters:
    """Connected components of intersecting triangles.

    Two pairs belong together if a triangle of one is a triangle of the other, or shares a point with it.

    Parameters
    ----------
    first, second : (k,) int
        Rows of triangles that intersect.
    segment : (k, 2, 3) float
        Where they do.
    corners : (n, 3) int
        Points of the triangles. Where points of equal coordinates are to be one, give their common number.

    Returns
    -------
    Clusters

    Notes
    -----
    O(k log k). Of pairs that were not kept nothing is known: two clusters may be one through them.
    """
    if not len(first):
        none = np.empty(0, dtype=np.intp)
        return Clusters(none, none, none, np.empty((0, 3)), np.empty((0, 3)))
    rows = union(first, second)
    one, two = np.searchsorted(rows, first), np.searchsorted(rows, second)
    points = union(corners[rows].ravel())
    touched = len(rows) + np.searchsorted(points, corners[rows].ravel())
    start = np.concatenate([one, np.repeat(np.arange(len(rows)), 3)])
    end = np.concatenate([two, touched])
    n = len(rows) + len(points)
    _, component = connected_components(
        coo_array((np.ones(len(start), dtype=bool), (start, end)), shape=(n, n)), directed=False
    )
    # Numbered anew, in the order of the first pairs.
    _, seen, label = np.unique(component[one], return_index=True, return_inverse=True)
    number = np.empty(len(seen), dtype=np.intp)
    number[np.argsort(seen)] = np.arange(len(seen))
    label = number[label]
    of_component = np.empty(component.max() + 1, dtype=np.intp)
    of_component[component[one]] = label
    low, high = np.full((len(seen), 3), np.inf), np.full((len(seen), 3), -np.inf)
    np.minimum.at(low, label, segment.min(axis=1))
    np.maximum.at(high, label, segment.max(axis=1))
    triangles = np.bincount(of_component[component[: len(rows)]], minlength=len(seen))
    return Clusters(label, np.bincount(label), triangles, low, high)
