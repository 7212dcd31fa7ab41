# SPDX-License-Identifier: MIT
"""TOP012 overshoot."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim, EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule(
    "TOP012", "overshoot", limit="coincide", measures=("24",), requires=("GEO001", "GEO002", "TOP001"), once="coincide"
)
def overshoot(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio
) -> Hits:
    """Line end that goes beyond the line it should meet.

    *End*, *other linework*, *connected*, and how lines are followed on, are as in TOP011 undershoot. An end that is not
    connected is an **overshoot** if the line, followed back from the end, meets other linework: crosses it, or comes as
    near as ``coincide`` in the plane and in depth; if the stub from the end to the last meeting is longer than
    ``coincide`` and at most ``reach``; and if the line goes on beyond the meeting for at least ``remainder`` times the
    length of the stub. Where a piece meets without crossing, the meeting place nearest the end is taken.
    An end that faces the next of a row of dashes (TOP015) is none.

    Parameters
    ----------
    lines : Lines, n rows
        Linework that belongs together; boundaries of areas have no ends and are other linework.
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.
    ahead, alongside : float, radians
        Half-angle of the cone in which an end misses what is near; what turns less runs alongside.
    remainder : float
        How many times the length of a stub its line goes on beyond the meeting.

    Returns
    -------
    Hits
        One an end: place is the end, size the length along the line from the end to the last meeting, other the line
        met there (of equals the longest, then the first by place).

    Notes
    -----
    O(n log n). A stub that is most of its own line, such as the arm of a cross, is none. Does not report lines that
    cross farther than ``reach`` from their ends.
    """
    table = lines.polylines
    ends = classify_ends(table, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach)
    at = np.flatnonzero(ends.kind == EndKind.OVERSHOOT)
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at], ends.other[at])
