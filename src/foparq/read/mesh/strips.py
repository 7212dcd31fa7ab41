# SPDX-License-Identifier: MIT
"""Triangles of strips and fans."""

import numpy as np

from foparq.columns import Index

_CUT = -1  #: ends a strip; the next begins behind it


def triangles_of_strips(corners: Index, starts: Index) -> Index:
    """Triangles of strips, every second one turned round.

    Parameters
    ----------
    corners : (m,) int
        Vertices; -1 cuts a strip in two.
    starts : (s + 1,) int
        Strip i has the vertices ``corners[starts[i]:starts[i + 1]]``.

    Returns
    -------
    (t, 3) int
        Without those that name a vertex twice: they join two strips and are no faces.

    Notes
    -----
    O(m).

    Examples
    --------
    >>> triangles_of_strips(np.array([0, 1, 2, 3]), np.array([0, 4])).tolist()
    [[0, 1, 2], [2, 1, 3]]
    """
    first = np.zeros(len(corners), dtype=bool)
    first[starts[:-1][starts[:-1] < starts[1:]]] = True
    first[1:] |= corners[:-1] == _CUT
    place = np.arange(len(corners)) - np.maximum.accumulate(np.where(first, np.arange(len(corners)), 0))
    # A triangle ends at every third vertex and those behind it.
    end = np.flatnonzero((place >= 2) & (corners != _CUT))  # noqa: PLR2004 - of three
    odd = place[end] % 2 == 1
    a, b, c = corners[end - 2], corners[end - 1], corners[end]
    triangles = np.column_stack([np.where(odd, b, a), np.where(odd, a, b), c])
    faces: Index = triangles[(a != b) & (b != c) & (c != a)]
    return faces


def triangles_of_fan(corners: Index) -> Index:
    """(m - 2, 3) triangles of one fan around its first vertex.

    Examples
    --------
    >>> triangles_of_fan(np.array([7, 1, 2, 3])).tolist()
    [[7, 1, 2], [7, 2, 3]]
    """
    hub = np.full(max(len(corners) - 2, 0), corners[0] if len(corners) else 0, dtype=np.intp)
    return np.column_stack([hub, corners[1:-1][: len(hub)], corners[2:]])
