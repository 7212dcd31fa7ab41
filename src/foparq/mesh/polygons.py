# SPDX-License-Identifier: MIT
"""Corners, sides and faces of ragged polygons."""

from collections.abc import Iterator

import numpy as np

from foparq.columns import Index

#: corners looked at in one step: 2**18 corners with their vectors fit into the cache of a processor
_BLOCK = 2**18


def face_of(starts: Index) -> Index:
    """Face (m,) of every corner."""
    return np.repeat(np.arange(len(starts) - 1, dtype=np.intp), np.diff(starts))


def following(starts: Index) -> Index:
    """Corner (m,) that follows every corner around its face.

    Examples
    --------
    >>> following(np.array([0, 3, 7])).tolist()
    [1, 2, 0, 4, 5, 6, 3]
    """
    after = np.arange(1, starts[-1] + 1, dtype=np.intp)
    filled = np.diff(starts) > 0
    after[starts[1:][filled] - 1] = starts[:-1][filled]
    return after


def preceding(starts: Index) -> Index:
    """Corner (m,) that precedes every corner around its face.

    Examples
    --------
    >>> preceding(np.array([0, 3, 7])).tolist()
    [2, 0, 1, 6, 3, 4, 5]
    """
    before = np.arange(-1, starts[-1] - 1, dtype=np.intp)
    filled = np.diff(starts) > 0
    before[starts[:-1][filled]] = starts[1:][filled] - 1
    return before


def members(starts: Index, rows: Index) -> tuple[Index, Index]:
    """All members of chosen ranges.

    Parameters
    ----------
    starts : (n + 1,) int
        Range r holds ``starts[r]`` ... ``starts[r + 1] - 1``.
    rows : (k,) int
        The ranges, in any order.

    Returns
    -------
    starts : (k + 1,) int
        Of the chosen ranges, laid end to end.
    member : (sum,) int

    Examples
    --------
    >>> members(np.array([0, 2, 5]), np.array([1, 0]))
    (array([0, 3, 5]), array([2, 3, 4, 0, 1]))
    """
    count = starts[rows + 1] - starts[rows]
    begin = np.zeros(len(rows) + 1, dtype=np.intp)
    np.cumsum(count, out=begin[1:])
    member = np.arange(begin[-1], dtype=np.intp) + np.repeat(starts[rows] - begin[:-1], count)
    return begin, member


def chosen(corners: Index, starts: Index, rows: Index) -> tuple[Index, Index]:
    """The polygons of chosen faces.

    Parameters
    ----------
    corners : (m,) int
    starts : (f + 1,) int
    rows : (k,) int
        The faces, in any order.

    Returns
    -------
    corners, starts
        As the parameters; face i is face ``rows[i]`` of the given ones.
    """
    begin, member = members(starts, rows)
    return corners[member], begin


def blocks(starts: Index, *, most: int = _BLOCK) -> Iterator[tuple[int, int]]:
    """Ranges of faces whose corners are not many.

    Parameters
    ----------
    starts : (f + 1,) int
    most : int
        Corners of one range; a single face may have more.

    Yields
    ------
    first, stop : int
        Faces ``first`` ... ``stop - 1``, in order, all of them.
    """
    first, count = 0, len(starts) - 1
    while first < count:
        stop = int(np.searchsorted(starts, starts[first] + most, side="right")) - 1
        stop = min(max(stop, first + 1), count)
        yield first, stop
        first = stop
