# SPDX-License-Identifier: MIT
"""Where a line, followed from one of its vertices, leaves the circle around it."""

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.polylines import Polylines


def leaving(lines: Polylines, vertex: Index, forward: Flags, *, radius: float) -> Index:
    """First vertex at which a line, followed from a given vertex, is farther than ``radius`` from it in the plane.

    Parameters
    ----------
    vertex : (k,) int
    forward : (k,) bool
        Followed in the order of the line, else against it.
    radius : float, metres

    Returns
    -------
    (k,) int
        Row of the coordinates. A line that never leaves gives a row beyond its end: past the last vertex of all lines
        if forward, before the first if not.

    Notes
    -----
    Runs of vertices whose box lies within the circle are passed over at once: O(log m) steps, unless the line runs
    along the circle itself.
    """
    left = np.where(forward, len(lines.coordinates), -1)
    owner = lines.line_of_vertex[vertex]
    last = np.where(forward, lines.tails[owner], lines.heads[owner])
    way = np.where(forward, 1, -1)
    at, level = vertex + way, np.zeros(len(vertex), dtype=np.intp)
    active = np.flatnonzero(vertex != last)
    while len(active):
        here, size = at[active], np.int64(1) << level[active]
        stop = here + way[active] * (size - 1)
        inside = (stop - last[active]) * way[active] <= 0
        inside[inside] = _reach(lines, vertex[active[inside]], here[inside], level[active[inside]]) <= radius
        away = ~inside & (level[active] == 0)
        left[active[away]] = here[away]
        level[active[~inside]] -= 1
        passed = active[inside]
        at[passed] = stop[inside] + way[passed]
        # A run begins where its length divides the row, so that runs nest.
        start = np.where(forward[passed], at[passed], at[passed] + 1)
        level[passed] += start % (2 * size[inside]) == 0
        active = active[~away]
        active = active[(at[active] - last[active]) * way[active] <= 0]
    return left


def _reach(lines: Polylines, vertex: Index, at: Index, level: Index) -> Reals:
    """Distance (k,) from a vertex to the farthest corner of the box around a run of ``2 ** level`` vertices."""
    if not level.any():
        away: Reals = np.hypot(*(lines.plane[at] - lines.plane[vertex]).T)
        return away
    low, high, offsets = lines.kept(("runs",), lambda: _runs(lines.plane))
    box = offsets[level] + (at >> level)
    corner = np.maximum(high[box] - lines.plane[vertex], lines.plane[vertex] - low[box])
    reach: Reals = np.hypot(*corner.T)
    return reach


def _runs(plane: Reals) -> tuple[Reals, Reals, Index]:
    """Boxes around single vertices, pairs, fours ... one level after the other, and where each level begins."""
    lows, highs = [plane], [plane]
    while len(lows[-1]) > 1:
        whole = len(lows[-1]) // 2 * 2
        lows.append(np.minimum(lows[-1][0:whole:2], lows[-1][1:whole:2]))
        highs.append(np.maximum(highs[-1][0:whole:2], highs[-1][1:whole:2]))
    offsets = np.concatenate([[0], np.cumsum([len(low) for low in lows])]).astype(np.intp)
    return np.concatenate(lows), np.concatenate(highs), offsets
