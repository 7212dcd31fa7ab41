# SPDX-License-Identifier: MIT
"""TOP013 free-end."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import Aim, EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres, Radians, Ratio


@rule("TOP013", "free-end", limit="reach", measures=("21",), requires=("GEO001", "GEO002", "TOP001"), once="coincide")
def free_end(
    lines: Lines, *, coincide: Metres, reach: Metres, ahead: Radians, alongside: Radians, remainder: Ratio
) -> Hits:
    """Line end that misses nothing near it.

    *End*, *other linework*, *connected*, and what an end could run into, are as in TOP011 undershoot. An end is
    **free** if it is neither connected nor an overshoot, and nothing that it could run into lies within ``reach``. It
    may have other linework beside it or behind it all the same; then that is named.

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
        One an end: place is the end. Size is the distance to the nearest other linework, which is the other; where none
        lies within ``reach``, size is ``reach``: nothing was found up to there.

    Notes
    -----
    O(n log n). Does not say what was meant: a line may end in the open. TOP016 probable-undershoot tells which of
    them head for a line beyond ``reach``.
    """
    table = lines.polylines
    ends = classify_ends(table, Aim(ahead, alongside, remainder), coincide=coincide, reach=reach)
    at = np.flatnonzero(np.isin(ends.kind, [EndKind.FREE, EndKind.BESIDE]))
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at], ends.other[at])
