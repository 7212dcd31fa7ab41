# SPDX-License-Identifier: MIT
"""Areas that can be measured although their boundary crosses itself."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries


def measurable(areas: Geometries) -> tuple[Geometries, Flags]:
    """The ground that each area covers, as a valid geometry.

    Parameters
    ----------
    areas : (n,) shapely polygons of finite coordinates, valid or not

    Returns
    -------
    covered : (n,) shapely polygons or multipolygons
        A valid area as it is. Of others the places that lie an odd number of boundaries inside, which is what a
        drawing program fills: a spike of no width, or a loop too small to be seen, takes nothing away from the rest.
    there : (n,) bool
        False where nothing is covered.

    Notes
    -----
    O(vertices log vertices) for an area whose boundary meets itself seldom. A working copy for measuring: the areas
    stay as they are. Does not say whether an area is sound: see ``self_meetings`` and ``invalid_geometries``.
    """
    covered = areas.copy()
    broken = np.flatnonzero(~shapely.is_valid(areas))
    for row in broken:
        rings = shapely.get_rings(areas[row])
        coordinates, ring = shapely.get_coordinates(rings[shapely.get_num_points(rings) > 1], return_index=True)
        lines = shapely.multilinestrings(shapely.linestrings(coordinates, indices=ring))
        covered[row] = shapely.build_area(shapely.node(lines))
    there: Flags = ~(shapely.is_missing(covered) | shapely.is_empty(covered))
    return covered, there
