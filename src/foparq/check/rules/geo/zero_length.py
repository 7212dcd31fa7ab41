# SPDX-License-Identifier: MIT
"""GEO002 zero-length."""

import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.places import place_on
from foparq.geom.shapes import point_like
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("GEO002", "zero-length", limit="coincide", measures=("119",), requires=("GEO001",))
def zero_length(lines: Lines, *, coincide: Metres) -> Hits:
    """Line that is no longer than a point.

    A line is at fault if all its segments together are not longer than ``coincide``, in space.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a line: place is the point at half its length, size its length.

    Notes
    -----
    O(vertices). Does not report a point-like part of a longer line: see GEO003 repeated-vertex.
    """
    table = lines.polylines
    row = point_like(table, coincide=coincide)
    return hits(row, shapely.points(place_on(lines.geometry[row])[:, :2]), table.length_in_space[row])
