# SPDX-License-Identifier: MIT
"""TOP013 free-end."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ends import EndKind, classify_ends
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("TOP013", "free-end", limit="reach", measures=("21",), requires=("GEO001", "GEO002", "TOP001"), once="coincide")
def free_end(lines: Lines, *, coincide: Metres, reach: Metres) -> Hits:
    """Line end with nothing near it.

    *End*, *other linework* and *connected* are as in TOP011 undershoot. An end is **free** if it is not connected, no
    other linework lies within ``reach`` of it, and the line, followed back from the end for at most ``reach`` of its
    own length, meets none.

    Parameters
    ----------
    lines : Lines, n rows
        Linework that belongs together; boundaries of areas have no ends and are other linework.
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Hits
        One an end: place is the end, size ``reach``: nothing was found up to there, and nothing is looked for beyond.

    Notes
    -----
    O(n log n). Says nothing about what was meant: a line may end in the open. Does not look for the line that would be
    met beyond ``reach``.
    """
    table = lines.polylines
    ends = classify_ends(table, coincide=coincide, reach=reach)
    at = np.flatnonzero(ends.kind == EndKind.FREE)
    return hits(ends.line[at], table.points(table.plane[ends.vertex[at]]), ends.size[at])
