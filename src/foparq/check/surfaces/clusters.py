# SPDX-License-Identifier: MIT
"""Places that are near each other, as groups."""

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.mesh.grouping import joined

_CELLS = 500_000  #: cells that are grouped at most; they are doubled until they are no more


def clusters(points: Coordinates, width: float) -> Index:
    """(n,) number of the cluster of each point.

    Parameters
    ----------
    points : (n, 3) metres
        One at least.
    width : float, metres
        Cells of this width that hold a point, and touch, are one cluster.

    Notes
    -----
    O(n log n).

    Examples
    --------
    >>> clusters(np.array([[0.0, 0, 0], [0.9, 0, 0], [1.2, 1.1, 0], [9, 9, 9]]), 1.0).tolist()
    [0, 0, 0, 1]
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; only what is not explained needs it

    low = points.min(axis=0)
    while True:
        cells, of = np.unique(np.floor((points - low) / width), axis=0, return_inverse=True)
        if len(cells) <= _CELLS:
            break
        width *= 2
    pairs = cKDTree(cells).query_pairs(1.5, p=np.inf, output_type="ndarray")
    label: Index = np.unique(joined(len(cells), *pairs.T), return_inverse=True)[1]
    return label[of.ravel()]
