# SPDX-License-Identifier: MIT
"""MSH011 hole."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH011", "hole", size="m2", requires=("MSH001", "MSH002", "MSH021"))
def hole(surface: Surface) -> Hits:
    """Opening in the surface, bounded by edges at which one face ends and none goes on.

    A *boundary edge* bounds one face. Boundary edges that follow each other around the open fans of their vertices make
    a boundary loop, so that two openings that touch at a vertex are two loops. A loop that does not come back to its
    first vertex, because more than two faces meet somewhere on its way, is an open chain, and told like a loop.

    Every loop is a hole, but for the *rims*: a scan of a bust ends at its base, one of a facade at the edge of the
    view. A surface that is stated to be closed has none. Of one that is stated to have a number of rims they are its
    widest loops. Else the widest loop of each piece of faces joined over edges is supposed to be one; those that nobody
    states are told by MSH010 open-rim. An opening may be longer than the outline around it, but never wider.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
        ``closed`` and ``rims`` are what the manifest states of it.

    Returns
    -------
    Hits
        One a loop: place is the loop, size the area of its fill: that of the loop where it is plane but for a tenth of
        the root of that area, else of the triangles from the centroid of the line to its edges. The item is the face at
        its first edge; all faces along the loop are at fault.

    Notes
    -----
    O(n log n). The number of boundary edges that a count of edges gives is the sum over loops, rims included.
    Copies of a face are not seen (MSH021 duplicate-face): faces delivered twice around an opening would close it.
    Does not tell rims.
    """
    shape = surface.shape
    row = np.flatnonzero(~surface.rim)
    first, faces = shape.faces_along(row)
    size = shape.fills[row] * surface.metres**2
    return hits(first, surface.borders(row), size, also=faces)
