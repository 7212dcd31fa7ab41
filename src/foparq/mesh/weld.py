# SPDX-License-Identifier: MIT
"""Vertices at the same place, and places that are near."""

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from foparq.columns import Coordinates, Index, Reals
from foparq.mesh.grouping import Words, likely_groups, mixed, run_starts
from foparq.mesh.vectors import overflowing


def welded(points: Coordinates) -> Index:
    """The lowest vertex with the same coordinates, bit for bit.

    Parameters
    ----------
    points : (n, 3) float
        Zero equals negative zero. Coordinates that are no numbers are compared by their bits.

    Returns
    -------
    (n,) int
        ``welded(points)[corners]`` are the corners of the welded surface.

    Notes
    -----
    O(n log n): keys of 64 bits are sorted, and what agrees in them is compared in full.

    Examples
    --------
    >>> welded(np.array([[0.0, 1, 2], [5, 5, 5], [-0.0, 1, 2]])).tolist()
    [0, 1, 0]
    """
    lowest = np.arange(len(points), dtype=np.intp)
    words = np.ascontiguousarray(points + 0.0).view(np.uint64)
    key = mixed(words[:, 0])
    for axis in (1, 2):
        key = mixed(key ^ words[:, axis])
    rows, starts = likely_groups(key)
    rows, starts = _equal_runs(words, rows, starts)
    lowest[rows] = np.repeat(rows[starts[:-1]], np.diff(starts))
    return lowest


def _equal_runs(words: Words, rows: Index, starts: Index) -> tuple[Index, Index]:
    """Groups of rows split where their words differ; rising within each."""
    differs = np.zeros(len(rows), dtype=bool)
    found = words.take(rows, axis=0)
    for axis in range(3):
        differs[1:] |= found[1:, axis] != found[:-1, axis]
    differs[starts[:-1]] = False
    if not differs.any():
        return rows, starts
    # Different places with like keys: sorted by what they are.
    group = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    mixed_up = np.zeros(len(starts) - 1, dtype=bool)
    mixed_up[group[differs]] = True
    some = np.flatnonzero(mixed_up[group])
    order = some[np.lexsort((rows[some], *found[some].T, group[some]))]
    rows[some], found[some] = rows[order], found[order]
    first = np.ones(len(rows), dtype=bool)
    first[1:] = (found[1:] != found[:-1]).any(axis=1) | (group[1:] != group[:-1])
    return rows, run_starts(first)


class Near(NamedTuple):
    """Pairs of vertices at different places that are near."""

    first: Index  #: (k,)
    second: Index  #: (k,) greater than ``first``
    distance: Reals  #: (k,) metres, above zero
    total: int  #: number of all such pairs
    complete: bool  #: whether all pairs are here; else each vertex with its nearest only


@overflowing
def near(points: Coordinates, *, coincide: float, most: int) -> Near:
    """Vertices nearer to each other than to be told apart, at places that differ.

    Parameters
    ----------
    points : (n, 3) float, metres
        Distinct places: one vertex of each, see :func:`welded`. All finite.
    coincide : float, metres
        Places not farther apart than this are near.
    most : int
        If there are more pairs than this, every vertex that has near ones is given with its nearest alone.

    Returns
    -------
    Near
        Sorted by first, then second.

    Notes
    -----
    O(n log n + pairs up to ``most``); the count of pairs takes no memory. Memory is bounded by n and ``most``.
    Distances are computed from differences of coordinates, so that a far origin takes no digits.
    """
    empty = np.empty(0, dtype=np.intp)
    if len(points) < 2 or coincide <= 0:  # noqa: PLR2004 - a pair needs two
        return Near(empty, empty, np.empty(0), 0, complete=True)
    tree = cKDTree(points, balanced_tree=False, compact_nodes=False)
    gap, other = tree.query(points, k=[2], distance_upper_bound=np.nextafter(coincide, np.inf))
    gap, other = gap[:, 0], other[:, 0]
    crowd = np.flatnonzero(np.isfinite(gap))
    if not len(crowd):
        return Near(empty, empty, np.empty(0), 0, complete=True)
    few = cKDTree(points[crowd])
    count = (int(few.count_neighbors(few, coincide)) - len(crowd)) // 2
    if count <= most:
        pair = crowd[few.query_pairs(coincide, output_type="ndarray").reshape(-1, 2)]
    else:
        pair = np.stack([crowd, other[crowd]], axis=1)
    pair.sort(axis=1)
    pair = np.unique(pair, axis=0)
    first, second = pair[:, 0].astype(np.intp), pair[:, 1].astype(np.intp)
    distance = np.linalg.norm(points[second] - points[first], axis=1)
    return Near(first, second, distance, count, complete=count <= most)


def unreferenced(count: int, corners: Index) -> Index:
    """Vertices that no face uses.

    Parameters
    ----------
    count : int
        Number of vertices.
    corners : (m,) int

    Returns
    -------
    (k,) int
        Rising.
    """
    used = np.zeros(count, dtype=bool)
    used[corners] = True
    return np.flatnonzero(~used)
