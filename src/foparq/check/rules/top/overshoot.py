# SPDX-License-Identifier: MIT
"""TOP012 overshoot."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule(
    "TOP012", "overshoot", limit="coincide", measures=("24",), requires=("GEO001", "GEO002", "TOP001"), once="coincide"
)
def overshoot(lines: Lines, *, coincide: Metres, reach: Metres) -> Hits:
    """Line end that goes beyond the line it should meet.

    *End*, *other linework* and *connected* are as in TOP011 undershoot. An end that is not connected is an
    **overshoot** if the line, followed back from the end for at most ``reach`` of its own length, meets other linework:
    crosses it, or comes as near as ``coincide`` in the plane and in depth. The length from the end to the last meeting
    is more than ``coincide``. Where a piece meets without crossing, the meeting place nearest the end is taken.

    Parameters
    ----------
    lines : Lines, n rows
        Linework that belongs together; boundaries of areas have no ends and are other linework.
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Hits
        One an end: place is the end, size the length along the line from the end to the last meeting, other the line
        met there (of equals the longest, then the first by place).

    Notes
    -----
    O(n log n). A line shorter than ``reach`` that meets other linework with one end only is an overshoot by its whole
    length. Does not report lines that cross farther than ``reach`` from their ends.
    """
    table = lines.polylines
    ends = classify_ends(table, coincide=coincide, reach=reach)
    at = np.flatnonzero(ends.kind == EndKind.OVERSHOOT)
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at], ends.other[at])
