# SPDX-License-Identifier: MIT
"""TOP021 line-overlap."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.overlaps import line_overlaps
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("TOP021", "line-overlap", limit="coincide", measures=("27",), requires=("GEO001", "GEO002", "TOP001"))
def line_overlap(lines: Lines, *, coincide: Metres) -> Hits:
    """Two lines that run along each other for a stretch.

    Two segments share the common interval of their projections on the longer one, if they are within ``coincide`` of
    each other at both its ends, in the plane and in depth, and turned against each other by less than one in four. Two
    lines are at fault if the intervals of all their segments together are longer than ``coincide``: a line of many
    vertices is found along a long straight one.

    Curves that touch at a tangent are near each other for a while and share nothing: a stretch counts only if both its
    ends lie at an end or a corner of one of the lines, or if one does and at least half of the stretch is flush,
    nearer than a sixteenth of ``coincide``. An arch may spring from a jamb that goes on.

    Only lines that bind are compared: on layers of one name, of one feature class of the manifest, or bound by it
    (``bind``). What lines of other layers share is told by TOP022 shared-edge.

    Parameters
    ----------
    lines : Lines, n rows
        Pairs of boundaries of areas are not compared: neighbours share them. Nor are pairs of closed lines of a layer
        whose closed lines adjoin, see TOP033 undeclared-coverage.
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a pair: row is the shorter of the two, other the longer (of a group that overlaps each other, all but the
        longest are at fault); place is the longest shared piece, size the shared length.

    Notes
    -----
    O(n log n + meetings). Lines that only touch end to end share no more than ``coincide``. Does not report whole
    lines drawn twice: see TOP001 duplicate, which sets them aside; nor a line that runs along itself: see GEO004.
    """
    table = lines.polylines
    stays = lines.adjoining(coincide)
    found = line_overlaps(table, lines.bounds, coincide=coincide, apart=lines.bond, stays=stays)
    return hits(found.line, table.chords(found.start, found.end), found.length, found.other)
