# SPDX-License-Identifier: MIT
"""On which side of a surface places lie, where it has sides."""

from typing import NamedTuple

import numpy as np

from foparq.check.surfaces.skin import Skin
from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.findings.clouds import Signs
from foparq.mesh.winding import border, winding

_UNSURE = 0.25  #: from a whole number: nearer, the surface goes around a place or does not, whatever its holes
_ODD = 0.01  #: of the places near the surface may be unsure
_MOST = 1e9  #: places times border edges: each pair is a solid angle


class Sides(NamedTuple):
    """Places that lie within a surface."""

    signs: Signs
    inside: Index  #: rows of the places; none where the surface has no sides


def sides_of(skin: Skin, places: Coordinates, distance: Reals, mine: Flags, search: float) -> Sides:
    """Which places lie within a mesh.

    Parameters
    ----------
    places : (n, 3) metres
    distance : (n,) metres
        From the surface.
    mine : (n,) bool
        Of which places it is asked.
    search : float, metres
        Nearer places decide whether an open surface has sides.

    Returns
    -------
    Sides
        A closed surface has them, whichever way its faces look. An open one has them if the winding number of the
        places near it is near a whole number: it then goes around them, or does not. Of a sheet it is one half.

    Notes
    -----
    O(n log f) of a closed surface; with b border edges n b more. Where that is too much, an open surface has no sides.
    """
    rows = np.flatnonzero(mine)
    corners = skin.shape.triangulation.triangles
    edges = border(corners)
    none = np.empty(0, dtype=np.intp)
    if not len(edges):
        return Sides(Signs.CLOSED, rows[np.abs(winding(skin.points, corners, places[rows])) > 0.5])  # noqa: PLR2004
    near = rows[distance[rows] <= search]
    if not len(near) or len(edges) * len(rows) > _MOST:
        return Sides(Signs.OPEN, none)
    turns = np.abs(winding(skin.points, corners, places[rows]))
    unsure = np.abs(turns - np.rint(turns)) > _UNSURE
    if np.count_nonzero(unsure & (distance[rows] <= search)) > _ODD * len(near):
        return Sides(Signs.OPEN, none)
    return Sides(Signs.NEARLY, rows[turns > 0.5])  # noqa: PLR2004 - more than half of what is around them
