# SPDX-License-Identifier: MIT
"""GEO002 zero-length."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.shapes import point_like
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("GEO002", "zero-length", limit="coincide", measures=("119",), requires=("GEO001",))
def zero_length(lines: Lines, *, coincide: Metres) -> Hits:
    """Line that is no longer than a point.

    A line is at fault if all its segments together are not longer than ``coincide``, in space.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a line: place is its first vertex, size its length.

    Notes
    -----
    O(vertices). Does not report a point-like part of a longer line: see GEO003 repeated-vertex.
    """
    table = lines.polylines
    row = point_like(table, coincide=coincide)
    return hits(row, table.points(table.plane[table.heads[row]]), table.length_in_space[row])
