# SPDX-License-Identifier: MIT
"""MSH004 sliver-face."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface
from foparq.units import Radians, Ratio


@rule("MSH004", "sliver-face", requires=("MSH001", "MSH002", "MSH003"), preview=True)
def sliver_face(surface: Surface, *, needle: Ratio, cap: Radians) -> Hits:
    """Triangle that is very thin for its length.

    A triangle gets a finding if it has an area and is a *needle*, whose shortest side is less than ``needle`` of its
    longest one, or a *cap*, of which an angle is greater than ``cap``. These are the two kinds that CGAL tells apart.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
    needle : float
        Part of the longest side.
    cap : float, radians
        Angle beyond which a triangle is a cap.

    Returns
    -------
    Hits
        One a face: place is the face, size its height above its longest side.

    Notes
    -----
    O(n). Does not tell polygons of four corners and more, nor faces without area: see MSH003 degenerate-face.
    """
    face, height = surface.shape.slivers(needle, float(np.cos(cap)))
    return hits(face, surface.outlines(face), height * surface.metres)
