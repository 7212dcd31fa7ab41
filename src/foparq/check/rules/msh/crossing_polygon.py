# SPDX-License-Identifier: MIT
"""MSH006 crossing-polygon."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH006", "crossing-polygon", size="items", requires=("MSH001", "MSH002", "MSH003"))
def crossing_polygon(surface: Surface) -> Hits:
    """Face of four corners and more whose outline crosses itself.

    A face gets a finding if it cannot be cut into triangles between its corners, as they lie in the plane that faces it
    most: its sides cross, so that nobody knows what is surface and what is not. So does a face with more corners than
    can be looked at, 5,000.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a face: place is the face, size the number of its corners.

    Notes
    -----
    O(n); a polygon that is not convex takes the square of its corners. Does not judge triangles, which cross nothing in
    themselves, nor how far a polygon is from being plane. MSH022 surface-self-intersection and MSH023 coplanar-overlap
    see no such face.
    """
    left = np.setdiff1d(surface.shape.triangulation.left, surface.shape.degenerate)
    return hits(left, surface.outlines(left), np.diff(surface.starts)[left].astype(float))
