# SPDX-License-Identifier: MIT
"""TOP011 undershoot."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule(
    "TOP011", "undershoot", limit="coincide", measures=("23",), requires=("GEO001", "GEO002", "TOP001"), once="coincide"
)
def undershoot(lines: Lines, *, coincide: Metres, reach: Metres) -> Hits:
    """Line end that stops short of the line it should meet.

    An *end* is the first or last vertex of a line whose two ends are apart by more than ``coincide``. *Other linework*
    is every segment of any other line, and the segments of the line itself that come after the line, followed from the
    end, has left the circle of radius ``reach`` around it: a ring left open counts, the next small segments of a curve
    do not. The distance is that to the nearest place in the plane, joined with the difference in depth there. Lines no
    longer than ``coincide`` are no other linework, so that a dot hides nothing; they join what they touch.

    An end is *connected* if other linework is not farther than ``coincide`` in the plane, and not farther in depth
    there; or if its own line comes back to it as near, having left the circle of radius ``coincide``; or if a chain of
    lines no longer than ``coincide``, end near end, leads from it to either. An end that is not connected is an
    *overshoot* (TOP012) if the line, followed back for at most ``reach``, meets other linework. Otherwise it is an
    **undershoot** if the nearest other linework is at a distance d, coincide < d <= reach. Otherwise it is a *free end*
    (TOP013). Every end is exactly one of the four.

    Parameters
    ----------
    lines : Lines, n rows
        Linework that belongs together; boundaries of areas have no ends and are other linework.
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Hits
        One an end: place is the end, size the distance d, other the nearest line (of equals the longest, then the
        first by place).

    Notes
    -----
    O(n log n). Duplicates are set aside first, so that a copy does not pass for other linework. Does not say where
    the line would arrive if it were drawn on: the nearest line may lie aside.
    """
    table = lines.polylines
    ends = classify_ends(table, coincide=coincide, reach=reach)
    at = np.flatnonzero(ends.kind == EndKind.UNDERSHOOT)
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at], ends.other[at])
