# SPDX-License-Identifier: MIT
"""MSH022 surface-self-intersection."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH022", "surface-self-intersection", requires=("MSH001", "MSH002", "MSH003", "MSH006", "MSH021"))
def surface_self_intersection(surface: Surface) -> Hits:
    """Faces that cross, or touch where they share no vertex.

    Two faces get a finding if they have more in common than the vertices and the edge that they share, by number or by
    coordinates: they cross, or a vertex or an edge of one touches the other. Whether they do is decided exactly, on the
    coordinates as delivered. Polygons of more than three corners are looked at as triangles.

    Pairs that have a face or neighbouring faces in common are told together: a fold of hundred faces is one fault.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a group of pairs: place is what the pair with the longest line has in common, size the length in common of
        all pairs, item and other the faces of that pair. The faces of all pairs are at fault.

    Notes
    -----
    O(n log n + pairs). With more than two million pairs, those of MSH023 among them, it ends at its bound. Does not
    tell faces that lie on each other in one plane: see MSH023 coplanar-overlap; nor copies of a face: see MSH021
    duplicate-face.
    """
    shape = surface.shape
    found = shape.crossing_groups
    where = surface.segments(found.segment)
    return hits(found.first, where, found.length * surface.metres, found.second, also=found.faces)
