# SPDX-License-Identifier: MIT
"""MSH013 non-manifold-vertex."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH013", "non-manifold-vertex", size="items", requires=("MSH001", "MSH002"))
def non_manifold_vertex(surface: Surface) -> Hits:
    """Vertex at which two sheets of the surface touch without an edge in common.

    The faces around a vertex that lead from one to the next over edges at that vertex are a *fan*. A vertex gets a
    finding if its faces make more than one fan.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a vertex: place is the vertex, size the number of fans, item the first face there.

    Notes
    -----
    O(n log n). Does not tell edges at which more than two faces meet; they join their faces into one fan: see MSH012
    non-manifold-edge.
    """
    shape = surface.shape
    vertex = np.flatnonzero(shape.fans > 1)
    size, around = shape.fans[vertex].astype(float), shape.faces_around(vertex)
    return hits(shape.first_faces(vertex), shapely.points(surface.points[vertex]), size, also=around)
