# SPDX-License-Identifier: MIT
"""One point to look at for every finding, whatever its geometry."""

import numpy as np
import shapely

from foparq.columns import Geometries, Reals


def places(geometry: Geometries) -> Reals:
    """Mean vertex of every geometry.

    Parameters
    ----------
    geometry : (n,) shapely geometries
        Points, lines, areas and collections of them; may be ``None`` or empty.

    Returns
    -------
    (n, 3) float
        In the coordinates of the input; NaN for what has no place, and for z where there is no depth.
    """
    count = len(geometry)
    vertices, index = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    number = np.bincount(index, minlength=count).astype(float)
    found = number > 0
    sums = np.stack([np.bincount(index, weights=column, minlength=count) for column in vertices.T], axis=1)  # (n, 3)
    middle = np.full((count, 3), np.nan)
    middle[found] = sums[found] / number[found, np.newaxis]
    return middle
