# SPDX-License-Identifier: MIT
"""Ranges of unequal length, laid end to end."""

import numpy as np

from foparq.columns import Index, Reals


def ragged(start: Index, count: Index) -> tuple[Index, Index]:
    """All members of k ranges.

    Parameters
    ----------
    start, count : (k,) int
        Range r holds ``start[r]`` and the ``count[r] - 1`` numbers after it.

    Returns
    -------
    owner, member : (sum of count,) int
        Range of each member, and the member.

    Examples
    --------
    >>> ragged(np.array([10, 20]), np.array([1, 2]))
    (array([0, 1, 1]), array([10, 20, 21]))
    """
    count = np.maximum(count, 0)
    owner = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - before[owner] + start[owner]


def running_sums(value: Reals, offsets: Index) -> Reals:
    """Sum of each range up to each of its members.

    Parameters
    ----------
    value : (m,) float
    offsets : (n + 1,) int
        Range r holds ``value[offsets[r]:offsets[r + 1]]``.

    Returns
    -------
    (m,) float
        Every range is summed by itself: a huge one takes no digits from the others.

    Examples
    --------
    >>> running_sums(np.array([1e300, 1.0, 2.0]), np.array([0, 1, 3]))
    array([1.e+300, 1.e+000, 3.e+000])
    """
    sums = np.array(value, dtype=np.float64)
    count = np.diff(offsets)
    # Ranges of like length lie in one matrix, a row each, at most half of it padding.
    width = np.int64(1) << np.ceil(np.log2(np.maximum(count, 1))).astype(np.int64)
    for columns in np.unique(width[count > 1]).tolist():
        rows = np.flatnonzero((width == columns) & (count > 1))
        place = np.arange(columns)
        inside = place < count[rows][:, None]
        at = offsets[rows][:, None] + place
        run = np.cumsum(np.where(inside, value[np.where(inside, at, 0)], 0.0), axis=1)
        sums[at[inside]] = run[inside]
    return sums


def last_not_above(value: Reals, low: Index, high: Index, limit: Reals) -> Index:
    """Last member of a rising range that is not greater than a limit.

    Parameters
    ----------
    value : (m,) float
    low, high : (k,) int
        The range is ``value[low:high]``; it rises, or stays.
    limit : (k,) float

    Returns
    -------
    (k,) int
        Row of ``value``; ``low`` if all are greater.

    Examples
    --------
    >>> last_not_above(np.array([0.0, 1.0, 2.0]), np.array([0, 0]), np.array([3, 3]), np.array([1.5, -1.0]))
    array([1, 0])
    """
    low, high = low.copy(), high.copy()
    while True:
        open_rows = np.flatnonzero(high - low > 1)
        if not len(open_rows):
            return low
        middle = (low[open_rows] + high[open_rows]) // 2
        above = value[middle] > limit[open_rows]
        high[open_rows[above]] = middle[above]
        low[open_rows[~above]] = middle[~above]
