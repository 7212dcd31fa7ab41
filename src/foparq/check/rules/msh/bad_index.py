# SPDX-License-Identifier: MIT
"""MSH001 bad-index."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Faces


@rule("MSH001", "bad-index", size="items")
def bad_index(faces: Faces) -> Hits:
    """Face that names a vertex that the file does not have, or has fewer than three corners.

    A face gets a finding if one of its corners has a number below that of the first vertex or above that of the last,
    or if it has no more than two corners. No surface can be made of it: no other rule sees the face, and it closes no
    hole.

    Parameters
    ----------
    faces : Faces, n rows
        Every face of the file, in its order.

    Returns
    -------
    Hits
        One a face; the size is the number of its corners without a vertex, 0 where it has too few. The place is a
        vertex of the face that exists; missing if none does.

    Notes
    -----
    O(corners).
    """
    row = np.flatnonzero(faces.short | (faces.absent > 0))
    return hits(row, shapely.points(faces.place[row]), faces.absent[row].astype(float))
