# SPDX-License-Identifier: MIT
"""TOP033 undeclared-coverage."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.geom.ranks import line_ranks
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("TOP033", "undeclared-coverage", size="items", requires=("GEO001", "GEO002", "TOP001"))
def undeclared_coverage(lines: Lines, *, coincide: Metres) -> Hits:
    """Layer whose closed lines adjoin like the areas of a coverage, and that nobody declares as one.

    The stones of a wall, tiles and rooms have borders in common, and each of them is rightly drawn as a closed line. A
    layer looks so if at least half of its closed lines, and at least three, share a quarter of their length or more
    with others of the layer, nearer than ``coincide``; lines that lie in another one, or hold one, are not asked.

    The borders that closed lines of such a layer share are no line overlaps (TOP021). Whether they leave gaps or cover
    each other is looked at once the manifest declares the layer: ``areas = ["REVESTIMENTO"]`` in its ``[[drawing]]``,
    or ``--areas`` of ``foparq check``.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a layer: row is the longest of its closed lines (of equals the first by place), place the convex hull of all
        of them, size their number.

    Notes
    -----
    O(n log n + meetings). Does not find a coverage that is drawn with open lines, nor look at more than a hundred
    layers, those with the most closed lines. A closed line that is drawn twice is a duplicate all the same (TOP001).
    """
    rows = np.flatnonzero(lines.adjoining(coincide))
    _, of = np.unique(lines.names[rows], return_inverse=True)
    order = np.lexsort((line_ranks(lines.polylines, rows), of))
    rows, of = rows[order], of[order]
    _, first, count = np.unique(of, return_index=True, return_counts=True)
    hulls = [shapely.convex_hull(shapely.multilinestrings(part)) for part in np.split(lines.geometry[rows], first[1:])]
    where = np.empty(len(first), dtype=object)
    where[:] = [shapely.force_2d(hull) for hull in hulls[: len(first)]]
    return hits(rows[first], where, count.astype(float))
