# SPDX-License-Identifier: MIT
"""MSH018 t-junction."""

import shapely

from foparq.check.rule import rule
from foparq.columns import union
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface
from foparq.units import Metres


@rule("MSH018", "t-junction", limit="coincide", requires=("MSH001", "MSH002"), preview=True)
def t_junction(surface: Surface, *, coincide: Metres) -> Hits:
    """Vertex on the boundary edge of another face that has no vertex there.

    A *boundary edge* bounds one face. A vertex at the end of a boundary edge gets a finding if it is not farther than
    ``coincide`` from another boundary edge, and farther than that from both ends of it. The surface looks closed there,
    and is open along a crack.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
    coincide : float, metres
        Distance on the object up to which a vertex lies on an edge.

    Returns
    -------
    Hits
        One a vertex and edge: place is the vertex, size its distance from the edge, item the first face at the vertex,
        other the face of the edge. All faces at the vertex and that of the edge are at fault.

    Notes
    -----
    O(n log n + near pairs). Vertices of the face that the edge bounds are not asked. Does not tell vertices that lie
    nearly on each other, nor vertices within a face: where one touches it exactly, see MSH022
    surface-self-intersection.
    """
    shape = surface.shape
    found = shape.t_junctions(coincide / surface.metres)
    where = shapely.points(surface.points[found.vertex])
    other = shape.boundary_faces(found.edge)
    around = union(shape.faces_around(found.vertex), other)
    return hits(shape.first_faces(found.vertex), where, found.distance * surface.metres, other, also=around)
