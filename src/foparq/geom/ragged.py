# SPDX-License-Identifier: MIT
"""Ranges of unequal length, laid end to end."""

import numpy as np

from foparq.columns import Index


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
