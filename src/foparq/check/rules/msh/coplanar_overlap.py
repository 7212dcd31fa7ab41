# SPDX-License-Identifier: MIT
"""MSH023 coplanar-overlap."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH023", "coplanar-overlap", size="m2", requires=("MSH001", "MSH002", "MSH003", "MSH006", "MSH021"))
def coplanar_overlap(surface: Surface) -> Hits:
    """Faces that lie on each other in one plane.

    Two faces get a finding if they lie exactly in one plane and have an area in common, also where they share a vertex
    or an edge: a face folded back onto its neighbour. Decided exactly, on the coordinates as delivered.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a pair: item and place are the smaller face, other the larger one, size the area of the smaller one.

    Notes
    -----
    O(n log n + pairs). With more than two million pairs, those of MSH022 among them, it ends at its bound. Does not
    tell copies of a face: see MSH021 duplicate-face; nor two skins that lie on each other but for rounding, which cross
    everywhere: see MSH022 surface-self-intersection.
    """
    shape = surface.shape
    face, other = shape.overlaps.face, shape.overlaps.other
    return hits(face, surface.faces(face), shape.areas[face] * surface.metres**2, other, also=other)
