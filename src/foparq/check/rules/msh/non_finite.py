# SPDX-License-Identifier: MIT
"""MSH002 non-finite."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Faces


@rule("MSH002", "non-finite", size="items")
def non_finite(faces: Faces) -> Hits:
    """Face at a vertex whose coordinates are no finite numbers.

    A face gets a finding if a vertex of it has a coordinate that is not a number, or is infinite. No other rule sees
    the face.

    Parameters
    ----------
    faces : Faces, n rows
        Every face of the file, in its order.

    Returns
    -------
    Hits
        One a face; the size is the number of such corners. The place is a vertex of the face that has one; missing if
        none has.

    Notes
    -----
    O(corners). Does not tell a vertex without a finite place that no face uses: see MSH016 unreferenced-vertex.
    """
    row = np.flatnonzero(faces.endless > 0)
    return hits(row, shapely.points(faces.place[row]), faces.endless[row].astype(float))
