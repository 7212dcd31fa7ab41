# SPDX-License-Identifier: MIT
"""MSH016 unreferenced-vertex."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Vertices


@rule("MSH016", "unreferenced-vertex", size="items")
def unreferenced_vertex(vertices: Vertices) -> Hits:
    """Vertex that no face uses.

    Parameters
    ----------
    vertices : Vertices, n rows
        Every vertex of the file, in its order.

    Returns
    -------
    Hits
        One a vertex, size 1. The place is missing where its coordinates are no finite numbers.

    Notes
    -----
    O(n). Does not tell vertices of faces that cannot be used because another of their corners is wrong: such faces use
    their vertices all the same.
    """
    row = np.flatnonzero(~vertices.used)
    return hits(row, shapely.points(vertices.points[row]), np.ones(len(row)))
