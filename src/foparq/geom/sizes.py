# SPDX-License-Identifier: MIT
"""How large things are, whichever way they are turned."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries


def smaller_than(geometry: Geometries, size: float) -> Flags:
    """Geometries that fit into a circle of less than this diameter, in the plane.

    Parameters
    ----------
    geometry : (n,) shapely geometries
    size : float
        In their unit.

    Returns
    -------
    (n,) bool
        False for empty geometries and for coordinates that are not finite.

    Notes
    -----
    O(vertices). The circle is sought only where the bounding box does not tell: its diameter lies between the longer
    side and the diagonal of the box.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
        low_x, low_y, high_x, high_y = shapely.bounds(geometry).T
        width, height = high_x - low_x, high_y - low_y
        small: Flags = np.hypot(width, height) < size
        unclear = np.flatnonzero(~small & (np.maximum(width, height) < size))
        small[unclear] = 2.0 * shapely.minimum_bounding_radius(geometry[unclear]) < size
        # Boxes pass over what is no number, lengths do not.
        small[small] = np.isfinite(shapely.length(geometry[small]))
    return small
