# SPDX-License-Identifier: MIT
"""TOP032 gap."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.coverage import coverage_gaps
from foparq.model.inputs import Areas
from foparq.units import Metres, SquareMetres


@rule("TOP032", "gap", size="m2", limit="most", requires=("GEO001", "GEO004"))
def gap(areas: Areas, *, coincide: Metres, most: SquareMetres) -> Hits:
    """Place between areas that none of them covers.

    A place is a gap if it is enclosed by the areas together, covered by none, not larger than ``most``, bounded by at
    least two areas, and a disc of diameter ``coincide`` fits into it. Parts of it narrower than ``coincide`` do not
    count, and an opening narrower than ``coincide`` does not let out.

    Parameters
    ----------
    areas : Areas, n rows
        Areas of one coverage; the parts of one feature are rows of their own.
    coincide : float, metres
        Distance up to which two places are one.
    most : float, square metres
        Area of the largest gap; a larger opening is meant.

    Returns
    -------
    Hits
        One a gap: place is its polygon, size its area, row the area that bounds most of it (of equals the
        larger, then the first by place), other the next.

    Notes
    -----
    O(v log v) in the vertices. A hole inside one area is no gap, nor is a bay that is open to the outside. Does not
    look at depth.
    """
    found = coverage_gaps(areas.geometry, coincide=coincide, most=most)
    return hits(found.first, found.gap, found.area, found.second)
