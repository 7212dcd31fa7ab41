# SPDX-License-Identifier: MIT
"""TOP015 exploded-dashes."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim, classify_ends
from foparq.geom.ranks import line_ranks
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule(
    "TOP015",
    "exploded-dashes",
    size="items",
    measures=("21",),
    requires=("GEO001", "GEO002", "TOP001"),
    once="coincide",
)
def exploded_dashes(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio
) -> Hits:
    """Row of dashes drawn one by one: a line whose line type was exploded.

    A **row of dashes** is at least five lines, followed on as in TOP011 undershoot, of which each heads for the next:
    their nearest ends are not connected, lie within ``reach`` of each other, face each other and turn by no more than
    ``alongside``. Gaps differ from their median by a fifth at most; no dash is longer than twelve gaps; and the dashes
    but for the outermost, one after the other or in turns of two or three, are as long as each other but for a fifth.

    A row is none if other linework lies in more than half of its gaps and meets fewer than half of its dashes, or if
    more than half of the ends at its gaps go beyond what they meet: a rail cut at its bars.

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
        One a row: row is its longest dash (of equals the first by place), place all its dashes, size their number.

    Notes
    -----
    O(n log n). Dashed arcs are found as well. What the ends of the whole row miss is told by the other rules. ISO 128-2
    has dashes of eight gaps at most. Does not find rows whose gaps are wider than ``reach``.
    """
    ends = classify_ends(lines.polylines, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach)
    order = np.lexsort((line_ranks(lines.polylines, ends.dash), ends.row))
    dash, row = ends.dash[order], ends.row[order]
    first = np.unique(row, return_index=True)[1]
    place = shapely.multilinestrings(lines.geometry[dash], indices=row)
    return hits(dash[first], place, np.bincount(row).astype(float) if len(row) else np.zeros(0))
