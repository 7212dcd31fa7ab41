# SPDX-License-Identifier: MIT
"""Borders by how wide they are: an opening may be longer than the outline around it, but never wider."""

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.mesh.borders import Borders
from foparq.mesh.holes import BorderSizes

_DIGITS = 6  #: of logarithms of lengths that are compared: what differs by rounding of coordinates only is equal
_TINY = float(np.finfo(float).tiny)


def by_width(points: Coordinates, found: Borders, sizes: BorderSizes) -> Index:
    """Borders, wider ones first, of like width longer ones; of equals that of the lowest vertex by x, then y, then z.

    Parameters
    ----------
    points : (n, 3) float, metres
    found : Borders
    sizes : BorderSizes
        Of these borders.

    Returns
    -------
    (k,) int

    Notes
    -----
    O(b log b) for b edges of borders.
    """
    if not len(found.last):
        return np.empty(0, dtype=np.intp)
    vertex, at = np.unique(found.vertices, return_inverse=True)
    place = points[vertex]
    rank = np.empty(len(vertex), dtype=np.intp)
    rank[np.lexsort((place[:, 2], place[:, 1], place[:, 0]))] = np.arange(len(vertex))
    low = np.minimum.reduceat(rank[at], found.starts[:-1])
    wide, long = (np.round(np.log(np.maximum(size, _TINY)), _DIGITS) for size in (sizes.diameter, sizes.length))
    return np.lexsort((low, -long, -wide))
