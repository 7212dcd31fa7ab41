# SPDX-License-Identifier: MIT
"""TOP011 undershoot."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim, EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule(
    "TOP011", "undershoot", limit="coincide", measures=("23",), requires=("GEO001", "GEO002", "TOP001"), once="coincide"
)
def undershoot(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio
) -> Hits:
    """Line end that stops short of the line it should meet.

    An *end* is the first or last vertex of a line whose two ends are apart by more than ``coincide``. Where just two
    ends meet, the line is followed on: a polyline and its segments drawn one by one are the same. *Other linework* is
    every segment of any other line so followed, and the segments of the line itself that come after the line, followed
    from the end, has left the circle of radius ``reach`` around it: a ring left open counts, the next small segments of
    a curve do not. The distance is that to the nearest place in the plane, joined with the difference in depth there.
    Lines no longer than ``coincide`` are no other linework, so that a dot hides nothing; they join what they touch.

    The strokes of point symbols are no linework for any rule. A block insert is a *point symbol* if its lines fit into
    a circle of diameter ``symbol`` (``[linework]`` of the profile), and if its block is inserted so at least
    ``symbol_times`` times, fewer than half of which are bound to other linework by ends; or if nothing else lies as
    near as ``heading``. What shows a feature or a coverage is none. Symbols are listed with what was not checked.

    An end is *connected* if other linework is not farther than ``coincide`` in the plane, and not farther in depth
    there; or if its own line comes back to it as near, having left the circle of radius ``coincide``; or if a chain of
    lines no longer than ``coincide``, end near end, leads from it to either. An end that is not connected may be an
    *overshoot* (TOP012). Otherwise it is an **undershoot** if something that it could run into is at a distance d,
    coincide < d <= reach:

    - linework that lies in the cone of half-angle ``ahead`` around the direction of the end, or that the end would meet
      if drawn on, unless it runs alongside, turned by less than ``alongside``; what is met within ``reach`` counts even
      then;
    - an end that is not connected either and faces it: their directions are opposed, and neither lies behind the other
      by more than ``coincide``;
    - an end with which it would close a corner, if both were drawn on by at most ``reach``.

    The direction is that of the last segment, and of the chord over the last ``reach``; either may serve. Lines that
    merely lie side by side, such as mouldings cut at one break line, do not miss each other. Ends in a row of dashes
    are told by TOP015 exploded-dashes, and no end faces a dash of a row but its neighbours. All others are free
    (TOP013).

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
        One an end: place is the end, size the distance d, other the nearest line that it could run into (of equals the
        longest, then the first by place).

    Notes
    -----
    O(n log n). Duplicates are set aside first, so that a copy does not pass for other linework. An end that heads for a
    line beyond ``reach`` is told by TOP016 probable-undershoot, a corner where only ends meet by TOP014 short-node.
    """
    table = lines.polylines
    ends = classify_ends(table, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach)
    at = np.flatnonzero(ends.kind == EndKind.UNDERSHOOT)
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at], ends.other[at])
