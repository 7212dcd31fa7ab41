# SPDX-License-Identifier: MIT
"""MSH012 non-manifold-edge."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH012", "non-manifold-edge", requires=("MSH001", "MSH002"))
def non_manifold_edge(surface: Surface) -> Hits:
    """Edge at which more than two faces meet.

    Two sides of faces are one edge if they run between the same two vertices, in either direction. An edge gets a
    finding if three sides and more lie on it. A face that runs along an edge there and back, as a polygon does to its
    openings, does not count there.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One an edge: place is the edge, size its length, item the first face on it and other the second.

    Notes
    -----
    O(n log n). A face delivered twice makes its edges so; it is told by MSH021 duplicate-face as well.
    """
    shape = surface.shape
    edge = shape.edges.non_manifold
    first, second = shape.faces_at(edge)
    size = shape.edge_lengths(edge) * surface.metres
    return hits(first, surface.edges(edge), size, second, also=shape.all_faces_at(edge))
