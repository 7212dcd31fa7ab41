# SPDX-License-Identifier: MIT
"""GEO005 open-ring."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.shapes import open_rings
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("GEO005", "open-ring", limit="coincide", measures=("119",), requires=("GEO001", "GEO002"))
def open_ring(lines: Lines, *, coincide: Metres, reach: Metres) -> Hits:
    """Ring left open: a line that nearly comes back to its start.

    A line is at fault if it has at least four vertices and its first and last vertex are apart by more than
    ``coincide`` and at most ``reach``, in space.

    Parameters
    ----------
    lines : Lines, n rows
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Hits
        One a line: place is the chord between the two ends, size its length.

    Notes
    -----
    O(vertices). Does not tell a ring left open from a short bent line: both have ends near each other. If the line
    left the circle of radius ``reach`` in between, its ends are also TOP011 undershoots of the line itself.
    """
    table = lines.polylines
    found = open_rings(table, coincide=coincide, reach=reach)
    return hits(found.line, table.chords(found.start, found.end), found.gap)
