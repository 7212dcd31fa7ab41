# SPDX-License-Identifier: MIT
"""MSH017 duplicate-vertex."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Vertices


@rule("MSH017", "duplicate-vertex", size="items")
def duplicate_vertex(vertices: Vertices) -> Hits:
    """Vertex whose coordinates another vertex of the file has too.

    Many formats and programs write a vertex once for every face or for every piece of the texture: the surface is cut
    open there by its numbers, though not by its coordinates. Whether the cut counts is the profile's word: ``weld`` of
    ``[mesh]``.

    Parameters
    ----------
    vertices : Vertices, n rows
        Every vertex of the file, in its order.

    Returns
    -------
    Hits
        One a place that several vertices have: item is the first of them, other the second, size their number.

    Notes
    -----
    O(n log n). The same coordinates means all bits, but for the sign of nought, also where they are no numbers: there
    the place is missing. Does not tell vertices that are merely near each other.
    """
    count = np.bincount(vertices.same, minlength=len(vertices))
    row = np.flatnonzero(count > 1)
    again = np.flatnonzero(vertices.same != np.arange(len(vertices)))[::-1]
    second = np.empty(len(vertices), dtype=np.intp)
    second[vertices.same[again]] = again  # the first of them is written last
    return hits(row, shapely.points(vertices.points[row]), count[row].astype(float), second[row])
