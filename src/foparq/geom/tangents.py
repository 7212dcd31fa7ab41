# SPDX-License-Identifier: MIT
"""Lines that run along each other, told from curves that touch at a tangent.

Where a curve touches a line, both are nearer than any tolerance for a while: a circle of 1 m stays within 0.5 mm of its
tangent for 60 mm. An arch that springs from a jamb touches it so, and is drawn rightly.
"""

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.polylines import Polylines, summed
from foparq.geom.segments import at_share, nearest_share
from foparq.geom.stretches import join_pieces

_FLUSH = 1 / 16  #: share of the tolerance: a tangent stays within it for a quarter of its stretch
_MOSTLY = 0.5  #: of a stretch must be flush where only one of its ends is an end or a corner
_SMOOTH = 0.7  #: cosine of the sharpest turn that still is a curve


def runs_along(lines: Polylines, i: Index, j: Index, start: Reals, end: Reals, *, within: float) -> Flags:
    """Which shared pieces belong to a stretch that two lines really share.

    A stretch begins and ends somewhere. If both its ends lie at an end or a corner of one of the lines, the lines run
    along each other. If only one does, they do if at least half of the stretch is flush: nearer than a sixteenth of
    ``within``, where a tangent is for a quarter of it. If none does, the lines come near and part again in the open:
    a tangent.

    Parameters
    ----------
    i, j : (k,) int
        Pairs of segments.
    start, end : (k, 2) metres
        Pieces that they share, from the origin of the lines.
    within : float, metres
        Distance up to which two places are one.

    Returns
    -------
    (k,) bool

    Notes
    -----
    O(k log k). Does not see a line that leaves another by turns of less than 45 degrees within the tolerance and
    before half of the stretch is flush.
    """
    if not len(i):
        return np.zeros(0, dtype=bool)
    _, group = np.unique(lines.line[j] * len(lines) + lines.line[i], return_inverse=True)
    label = join_pieces(group, start, end, gap=2 * within).label
    count = int(label.max()) + 1
    one, two = _extremes(label, start, end, count, lines.slack)
    breaks, of = _breaks(lines, i, j, start, end, label, within)
    ends = np.zeros(count, dtype=np.intp)
    for extreme in (one, two):
        near = np.hypot(*(breaks - extreme[of]).T) <= 2 * within
        held = np.zeros(count, dtype=bool)
        held[of[near]] = True
        ends += held
    length = summed(label, np.hypot(*(end - start).T), count)
    flush = summed(label, _flush(lines, i, j, start, end, within * _FLUSH), count)
    real = (ends == 2) | ((ends == 1) & (flush >= _MOSTLY * length))  # noqa: PLR2004 - both ends
    found: Flags = real[label]
    return found


def _extremes(label: Index, start: Reals, end: Reals, count: int, slack: float) -> tuple[Reals, Reals]:
    """Two ends (count, 2) of every stretch: of its places, two that lie farthest apart."""
    places, of = np.concatenate([start, end]), np.concatenate([label, label])
    # In an order of their own, so that neither the file nor the way of drawing decides between places equally far.
    order = np.lexsort((*np.round(places / (4 * slack)).T, of))
    places, of = places[order], of[order]
    first = places[np.searchsorted(of, np.arange(count))]
    one = _farthest(places, of, first, count, slack)
    return one, _farthest(places, of, one, count, slack)


def _farthest(places: Reals, of: Index, origin: Reals, count: int, slack: float) -> Reals:
    order = np.lexsort((np.round(np.hypot(*(places - origin[of]).T) / (4 * slack)), of))
    last = np.searchsorted(of[order], np.arange(count), side="right") - 1
    found: Reals = places[order[last]]
    return found


def _breaks(
    lines: Polylines, i: Index, j: Index, start: Reals, end: Reals, label: Index, within: float
) -> tuple[Reals, Index]:
    """Ends and corners of lines that lie at the border of a piece: places (b, 2) and their stretch."""
    sharp = sharp_vertices(lines)
    places, of = [], []
    for segment in (i, j):
        for vertex in (lines.first[segment], lines.first[segment] + 1):
            there = lines.plane[vertex]
            near = np.minimum(np.hypot(*(there - start).T), np.hypot(*(there - end).T)) <= 2 * within
            rows = np.flatnonzero(sharp[vertex] & near)
            places.append(there[rows])
            of.append(label[rows])
    return np.concatenate(places), np.concatenate(of)


def _flush(lines: Polylines, i: Index, j: Index, start: Reals, end: Reals, most: float) -> Reals:
    """Length (k,) of each piece over which the two segments lie nearer than ``most``; their distance is linear."""
    apart = np.zeros((2, len(i)))
    for segment in (i, j):
        row = lines.segments(segment)
        for side, place in enumerate((start, end)):
            nearest = at_share(nearest_share(place, row.start, row.end), row.start, row.end)
            apart[side] = np.maximum(apart[side], np.hypot(*(place - nearest).T))
    low, high = apart.min(axis=0), apart.max(axis=0)
    rise = np.where(high > low, high - low, 1.0)
    share = np.where(high <= most, 1.0, np.clip((most - low) / rise, 0.0, 1.0))
    length: Reals = np.hypot(*(end - start).T) * share
    return length


def sharp_vertices(lines: Polylines) -> Flags:
    """Vertices (m,) where a line ends, or turns by more than 45 degrees."""
    sharp = np.ones(len(lines.coordinates), dtype=bool)
    step = lines.plane[lines.first + 1] - lines.plane[lines.first]
    one = np.flatnonzero(lines.line[:-1] == lines.line[1:])
    two = one + 1
    vertex = lines.first[two]
    heads, tails = lines.heads, lines.tails
    ring = np.flatnonzero((lines.opening <= lines.slack) & (np.diff(lines.segment_offsets) > 1))
    one = np.concatenate([one, lines.segment_offsets[ring + 1] - 1])
    two = np.concatenate([two, lines.segment_offsets[ring]])
    size = lines.step[one] * lines.step[two]
    along = np.einsum("ij,ij->i", step[one], step[two])
    smooth = along >= _SMOOTH * size
    inner = len(vertex)
    sharp[vertex[smooth[:inner]]] = False
    closing = ring[smooth[inner:]]
    sharp[heads[closing]] = sharp[tails[closing]] = False
    return sharp
