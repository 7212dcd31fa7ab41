# SPDX-License-Identifier: MIT
"""MSH019 spike."""

import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface
from foparq.units import Radians, Ratio


@rule("MSH019", "spike", requires=("MSH001", "MSH002"), preview=True)
def spike(surface: Surface, *, opening: Radians, rise: Ratio) -> Hits:
    """Single vertex that rises out of the surface like a needle.

    The edges of a vertex make a cone about their mean direction. A vertex gets a finding if no boundary edge ends at
    it, its cone opens by ``opening`` at most, and the vertex rises above its lowest neighbour, along the axis of the
    cone, by ``rise`` times the median length of all edges, or more. A slender spire that is as coarse as the rest of
    its building is none.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
    opening : float, radians
        Twice the greatest angle between an edge and the axis: 180 degrees on a plane, 109.5 degrees at the corner of a
        cube.
    rise : float
        Part of the median length of the edges.

    Returns
    -------
    Hits
        One a vertex: place is the vertex, size how far it rises, item the first face there. All faces at the vertex are
        at fault.

    Notes
    -----
    O(n log n). Does not tell a spike that is finely divided up to its tip.
    """
    shape = surface.shape
    vertex, height = shape.spikes(opening, rise)
    around = shape.faces_around(vertex)
    where = shapely.points(surface.points[vertex])
    return hits(shape.first_faces(vertex), where, height * surface.metres, also=around)
