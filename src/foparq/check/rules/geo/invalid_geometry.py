# SPDX-License-Identifier: MIT
"""GEO001 invalid-geometry."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.validity import invalid_geometries
from foparq.model.inputs import Features


@rule("GEO001", "invalid-geometry", size="items", measures=("119",))
def invalid_geometry(features: Features) -> Hits:
    """Geometry that is missing, broken, or bounds no area.

    A geometry is at fault if it is null or empty, if a coordinate is not a finite number, if a line has fewer than two
    vertices, if a ring has fewer than four or is not closed, or if GEOS calls its polygon invalid: hole outside the
    shell, nested holes or shells, interior cut in two, rings that cross each other, duplicate rings, too few distinct
    points.

    Parameters
    ----------
    features : Features, n rows
        Lines, areas and points.

    Returns
    -------
    Hits
        One a geometry, size 1. The place is the one GEOS names, empty if the geometry has none. GEOS names the first
        fault of a polygon only: mend it and check again.

    Notes
    -----
    O(vertices log vertices). Does not report a ring whose only fault is that it crosses or touches itself: see
    GEO004 self-intersection. Does not look at depth.
    """
    found = invalid_geometries(features.geometry)
    return hits(found.row, found.place, np.ones(len(found.row)))
