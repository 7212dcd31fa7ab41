# SPDX-License-Identifier: MIT
"""TOP014 short-node."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim
from foparq.geom.nodes import short_nodes
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule(
    "TOP014", "short-node", limit="coincide", measures=("23",), requires=("GEO001", "GEO002", "TOP001"), once="coincide"
)
def short_node(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio
) -> Hits:
    """Corner where only ends meet, short of a third line.

    A *node* is a place where two ends of lines or more meet, none farther than ``coincide`` from the next, and no line
    that does not end there; two ends whose last segments go on in each other, turned by less than ``alongside``, are
    one line. It is **short** if the nearest line that one of its ends could run into, as in TOP011 undershoot, is at a
    distance d, coincide < d <= reach, and does not end there itself.

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
        One a node: row is the longest of the lines that end there (of equals the first by place), place is its end,
        size the distance d, other the line that is missed.

    Notes
    -----
    O(n log n). The apex of a gable short of its cornice, and the corner of a frame within another that is drawn as
    single lines, look alike: it is for a person to say which it is. The corners of polylines are no ends.
    """
    table = lines.polylines
    found = short_nodes(table, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach)
    return hits(found.line, table.points(table.plane[found.vertex]), found.size, found.other)
