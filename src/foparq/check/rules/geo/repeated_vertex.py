# SPDX-License-Identifier: MIT
"""GEO003 repeated-vertex."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.shapes import repeated_vertices
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("GEO003", "repeated-vertex", limit="coincide", measures=("119",), requires=("GEO001", "GEO002"))
def repeated_vertex(lines: Lines, *, coincide: Metres) -> Hits:
    """Vertex written twice in a row.

    Two consecutive vertices are at fault if they are not farther apart than ``coincide``, in space. Vertices are
    compared as delivered: a run of k + 1 vertices at one place gives k findings.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a repeated vertex: place is halfway between the two, size their distance.

    Notes
    -----
    O(vertices). Does not compare vertices that are not consecutive: see GEO004 self-intersection. The closing vertex
    of a ring is no repetition.
    """
    table = lines.polylines
    found = repeated_vertices(table, coincide=coincide)
    return hits(found.line, table.points(found.place), found.distance)
