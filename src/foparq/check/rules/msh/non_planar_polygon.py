# SPDX-License-Identifier: MIT
"""MSH005 non-planar-polygon."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface
from foparq.units import Metres


@rule("MSH005", "non-planar-polygon", limit="within", requires=("MSH001", "MSH002", "MSH003"), preview=True)
def non_planar_polygon(surface: Surface, *, within: Metres) -> Hits:
    """Face of four corners and more that do not lie in one plane.

    A face gets a finding if a corner is farther than ``within`` from the plane that fits its corners best: the one
    through their mean of which the squares of their distances have the least sum. Every program cuts such a face into
    triangles of its own choice, and shows another surface.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
    within : float, metres
        Distance on the object up to which a corner lies in the plane.

    Returns
    -------
    Hits
        One a face: place is the face, size the greatest distance of a corner from the plane.

    Notes
    -----
    O(n). Does not compare the directions of the triangles of a face, as val3dity's test 204 does.
    """
    distance = surface.shape.unevenness() * surface.metres
    face = np.flatnonzero(distance > within)
    return hits(face, surface.outlines(face), distance[face])
