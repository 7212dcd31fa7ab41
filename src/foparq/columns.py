# SPDX-License-Identifier: MIT
"""What columns hold: array types by the kind of their values, and sets of row numbers.

The shape stands where a column is declared: ``(n,)``, ``(n, 3)``.
"""

import numpy as np
from numpy.typing import NDArray

Coordinates = NDArray[np.float64]  #: (n, 2) or (n, 3): places, one a row
Flags = NDArray[np.bool_]
Geometries = NDArray[np.object_]  #: shapely geometries; ``None`` where there is none
Index = NDArray[np.intp]  #: row numbers and counts
Integers = NDArray[np.int32]
Reals = NDArray[np.float64]
Texts = NDArray[np.object_]  #: str


_CLOSE = 8  #: times the number of rows, that the greatest may be


def union(*columns: Index) -> Index:
    """Rows that stand in any of some columns, each once, in order.

    Notes
    -----
    O(n) where rows are in order already, or numbers from 0 that lie close; else O(n log n) by sorting. ``numpy.unique``
    of whole numbers goes through a hash table since numpy 2.3, which takes ten times as long as sorting a million rows.

    Examples
    --------
    >>> union(np.array([3, 1]), np.array([1, 2])).tolist()
    [1, 2, 3]
    """
    filled = [column for column in columns if len(column)]
    rows: Index = np.concatenate(filled) if filled else np.empty(0, dtype=np.intp)
    if (rows[1:] > rows[:-1]).all():
        return rows
    if rows.min() >= 0 and rows.max() < _CLOSE * len(rows):
        there = np.zeros(int(rows.max()) + 1, dtype=bool)
        there[rows] = True
        return np.flatnonzero(there)
    rows.sort()
    first = np.ones(len(rows), dtype=bool)
    first[1:] = rows[1:] != rows[:-1]
    distinct: Index = rows[first]
    return distinct
