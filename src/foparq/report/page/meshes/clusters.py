# SPDX-License-Identifier: MIT
"""Fewer triangles: vertices in one cell of a grid become one of them."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Index, Reals

_TRIES = 8
_FULL = 0.9  #: of the triangles allowed: what is aimed at
_WELL = 0.6  #: of the triangles allowed: enough not to try a finer grid
_SPARSE = 0.05  #: of the triangles allowed: where cells leave less, the surface is of small pieces
_FINEST = 1e-6  #: cell over the longest side
_TABLE = 2**26  #: cells up to which a table of all of them is faster than sorting
_SAMPLE = 50_000  #: triangles from which the area is estimated
_PER_CELL = 2.5  #: triangles in a cell that a surface passes


class Clustered(NamedTuple):
    """A surface with fewer triangles."""

    points: Reals  #: (v, 3) each a vertex of the surface as it was
    triangles: Index  #: (t, 3)
    cell: float  #: no vertex was moved farther along an axis
    thinned: bool  #: triangles were chosen evenly instead, and no vertex moved


def clustered(points: Coordinates, triangles: Index, most: int) -> Clustered:
    """At most so many triangles.

    Parameters
    ----------
    points : (n, 3) float
        All used; their longest side is about 1.
    triangles : (m, 3) int
    most : int

    Returns
    -------
    Clustered
        In each cell of a cubic grid the vertex nearest to the middle of those in the cell stands for all, or one that
        is the outermost of the surface along an axis, so that the extent is kept. Triangles that are left with fewer
        than three corners, and copies, are dropped. Where cells would leave next to nothing, because the surface is
        made of many small pieces, triangles are chosen evenly.

    Notes
    -----
    O(n log n) for each of a few sizes of cells that are tried; does not look at shape, and may join sheets that are
    nearer than a cell.
    """
    cell = _first_cell(points, triangles, most)
    best: tuple[float, Index, Index] | None = None
    for _ in range(_TRIES):
        cluster = _cells(points, cell)
        kept = _kept(cluster[triangles])
        number = len(kept)
        if number <= most and (best is None or number > len(best[2])):
            best = cell, cluster, kept
        if _WELL * most <= number <= most or (number < most and cell <= _FINEST):
            break
        change = np.sqrt(max(number, 1) / (_FULL * most))
        cell = max(cell * float(np.clip(change, 0.2, 5.0)), _FINEST)
    if best is None or len(best[2]) < _SPARSE * most:
        return Clustered(points, triangles[np.linspace(0, len(triangles) - 1, most).astype(np.intp)], 0.0, True)
    cell, cluster, kept = best
    return Clustered(points[_standing(points, cluster)], cluster[triangles[kept]], cell, False)


def _first_cell(points: Coordinates, triangles: Index, most: int) -> float:
    every = max(len(triangles) // _SAMPLE, 1)
    a, b, c = (points[corner] for corner in triangles[::every].T)
    area = every * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
    return max(float(np.sqrt(_PER_CELL * area / most)), _FINEST)


def _cells(points: Coordinates, cell: float) -> Index:
    """Number (n,) of the cell of each vertex."""
    low = points.min(axis=0)
    across = np.floor((points - low) / cell).astype(np.int64)
    many = across.max(axis=0) + 1
    key = (across[:, 0] * many[1] + across[:, 1]) * many[2] + across[:, 2]
    last = int(many[0] * many[1] * many[2])
    if last > _TABLE:
        number: Index = np.unique(key, return_inverse=True)[1].ravel()
        return number
    there = np.zeros(last, dtype=bool)
    there[key] = True
    numbers: Index = (np.cumsum(there) - 1)[key]
    return numbers


def _kept(corners: Index) -> Index:
    """Rows of the triangles that have three corners left, the first of each."""
    a, b, c = corners.T
    rows = np.flatnonzero((a != b) & (b != c) & (c != a))
    many = int(corners.max(initial=0)) + 1
    x, y, z = np.sort(corners[rows], axis=1).astype(np.int64).T
    # Three numbers in one where they fit, which they do up to two million cells.
    key = (
        (x * many + y) * many + z if many < 2**21 else np.unique(np.stack([x, y, z], 1), axis=0, return_inverse=True)[1]
    )
    first = np.unique(key, return_index=True)[1]
    return rows[np.sort(first)]


def _standing(points: Coordinates, cluster: Index) -> Index:
    """Vertex (k,) that stands for each cluster: one of the outermost, else the nearest to their middle."""
    number = np.bincount(cluster)
    middle = np.stack([np.bincount(cluster, weights=axis) for axis in points.T], axis=1) / number[:, np.newaxis]
    away = ((points - middle[cluster]) ** 2).sum(axis=1)
    away[np.concatenate([points.argmin(axis=0), points.argmax(axis=0)])] = -1.0
    order = np.lexsort((away, cluster))
    first: Index = order[np.cumsum(number) - number]
    return first
