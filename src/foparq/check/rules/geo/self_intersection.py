# SPDX-License-Identifier: MIT
"""GEO004 self-intersection."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.crossings import self_meetings
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("GEO004", "self-intersection", limit="coincide", measures=("26", "27"), requires=("GEO001", "GEO002"))
def self_intersection(lines: Lines, *, coincide: Metres) -> Hits:
    """Line that crosses, touches or retraces itself.

    Two segments of one line that are not joined are at fault if they cross or come as near as ``coincide``, in the
    plane and in depth there. Two segments are *joined* if the line between them stays within ``coincide`` of one place:
    neighbours, also over repeated vertices, and the segments at the closing point of a ring. Joined segments are at
    fault if they run along each other for more than ``coincide``: the line turns back on itself. Segments run along
    each other where their common interval lies within ``coincide`` at both its ends and they are turned against each
    other by less than one in four.

    Parameters
    ----------
    lines : Lines, n rows
        Lines and boundaries of areas, each by itself.
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a place; meetings of one line nearer than twice ``coincide`` are one place. The place is a point, or the
        longest piece that is run along twice. Size is the length along the line between the two passes, in a ring the
        shorter way round.

    Notes
    -----
    O(n log n + meetings). Does not compare different lines.
    """
    table = lines.polylines
    found = self_meetings(table, coincide=coincide)
    where = table.points(found.start)
    run = np.flatnonzero(np.any(found.start != found.end, axis=1))
    where[run] = table.chords(found.start[run], found.end[run])
    return hits(found.line, where, found.loop)
