# SPDX-License-Identifier: MIT
"""TOP031 area-overlap."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.coverage import area_overlaps
from foparq.model.inputs import Areas
from foparq.units import SquareMetres


@rule("TOP031", "area-overlap", size="m2", limit="least", measures=("11",), requires=("GEO001", "GEO004"))
def area_overlap(areas: Areas, *, least: SquareMetres) -> Hits:
    """Two areas that cover the same place.

    Two areas are at fault if their common area is greater than ``least``.

    Parameters
    ----------
    areas : Areas, n rows
        Areas of one coverage.
    least : float, square metres
        Common area up to which two areas are neighbours.

    Returns
    -------
    Hits
        One a pair: row is the smaller of the two (of equals the second by place), other the larger; place is the
        common polygon, size its area.

    Notes
    -----
    O(n log n + pairs that touch). Does not look at depth. A place that three areas cover is found in three pairs.
    """
    found = area_overlaps(areas.geometry, least=least)
    return hits(found.smaller, found.common, found.area, found.larger)
