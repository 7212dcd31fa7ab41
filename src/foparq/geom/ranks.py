# SPDX-License-Identifier: MIT
"""Which of several things comes first where a rule has to choose: the shape decides, not the file.

Ranks do not change when lines are drawn backwards, rings start elsewhere, or items have other names. What is equal in
size comes in order of its place; only things that cover each other are told apart by their row.
"""

import numpy as np
import shapely

from foparq.columns import Geometries, Index, Reals
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import ragged
from foparq.geom.rounding import slack_of


def line_ranks(lines: Polylines, rows: Index) -> Index:
    """Ranks (k,) of some lines: the longest first, then the most stretched, then by the box, then by the ends."""
    grid = 4 * lines.slack
    count = np.diff(lines.offsets)[rows]
    _, vertex = ragged(lines.offsets[rows], count)
    start = np.cumsum(count) - count
    way = lines.plane[vertex]
    low, high = (corner.reduceat(way, start) if len(rows) else way for corner in (np.minimum, np.maximum))
    head, tail = lines.plane[lines.heads[rows]], lines.plane[lines.tails[rows]]
    # The end that comes first by x, then y; a ring has none.
    cells = np.round(np.column_stack([head, tail]) / grid)
    later = (cells[:, 0] > cells[:, 2]) | ((cells[:, 0] == cells[:, 2]) & (cells[:, 1] > cells[:, 3]))
    end = np.where(later[:, None], cells[:, 2:], cells[:, :2])
    end[lines.opening[rows] <= grid] = 0.0
    size = np.round(np.column_stack([lines.length[rows], lines.opening[rows]]) / grid)
    return _ranks(np.column_stack([-size, np.round(np.column_stack([low, high]) / grid), end]), rows)


def area_ranks(areas: Geometries) -> Index:
    """Ranks (n,) of polygons: the largest first, then by the box around them."""
    grid = 4 * slack_of(shapely.get_coordinates(areas))
    # An area may be off by the rounding of its boundary.
    around = np.maximum(np.median(shapely.length(areas)), grid) if len(areas) else 1.0
    size = np.round(shapely.area(areas) / (grid * around))
    box = np.round(shapely.bounds(areas).reshape(-1, 4) / grid)
    return _ranks(np.column_stack([-size, box]), np.arange(len(areas)))


def _ranks(columns: Reals, rows: Index) -> Index:
    order = np.lexsort((rows, *columns.T[::-1]))
    ranks = np.empty(len(rows), dtype=np.intp)
    ranks[order] = np.arange(len(rows))
    return ranks
