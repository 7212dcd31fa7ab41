# SPDX-License-Identifier: MIT
"""TOP016 probable-undershoot."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim
from foparq.geom.heading import heading_ends
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule(
    "TOP016",
    "probable-undershoot",
    limit="reach",
    measures=("23",),
    requires=("GEO001", "GEO002", "TOP001"),
    once="coincide",
)
def probable_undershoot(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio,
    heading: Metres,
) -> Hits:  # fmt: skip
    """Free line end that heads for a line a little beyond reach.

    An end that is free (TOP013) is a **probable undershoot** if, drawn on by at most ``heading``, it meets other
    linework that is turned against it by ``alongside`` or more, or closes a corner with another free end that is drawn
    on by no more; nothing that lies in line is nearer. The direction is that of the last segment, or of the chord over
    the last ``reach``. If the other end of the line is nearer still, and the line ``remainder`` times as long as the
    gap between them, that is what it misses: an outline left open.

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
    heading : float, metres
        How far an end may head for a line: what is seen on the plot.

    Returns
    -------
    Hits
        One an end: place is the end, size the length that is missing, other the line that it would meet first.

    Notes
    -----
    O(n log n). The same ends are told as free: this says which of them a reviewer would look at. Bars that stop short
    of their frame on purpose, to leave room for a joint, look alike. Does not tell ends that face each other in line.
    """
    table = lines.polylines
    found = heading_ends(table, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach, heading=heading)
    return hits(found.line, table.points(table.plane[found.vertex]), found.size, found.other)
