# SPDX-License-Identifier: MIT
"""How far a line goes on beyond its last meeting."""

import numpy as np

from foparq.columns import Index, Reals
from foparq.geom.loose import Least, LooseEnds
from foparq.geom.polylines import Segments
from foparq.geom.ragged import last_not_above, ragged
from foparq.geom.segments import at_share, cannot_meet, contacts


def stubs(ends: LooseEnds) -> Least:
    """Length from each end back to the last meeting of its chain with other linework.

    Returns
    -------
    Least
        ``inf`` where none is met within ``radius`` of the chain's own length.

    Notes
    -----
    Where two pieces cross, the crossing is where they meet; failing that, the meeting place nearest the end.
    """
    lines, found = ends.lines, Least(ends.given, len(ends))
    # Followed a little farther, so that a crossing just beyond is not taken for one at the radius.
    end, before, piece = _followed(ends, ends.radius + 2 * ends.within)
    length = np.hypot(*(piece.end - piece.start).T)
    start, stop = piece.start @ lines.turn, piece.end @ lines.turn
    for row, segment in lines.tree.query(np.minimum(start, stop), np.maximum(start, stop), distance=ends.within):
        kept = np.flatnonzero(ends.others(end[row], segment))
        kept = kept[~cannot_meet(piece.take(row[kept]), lines.segments(segment[kept]), within=ends.within)]
        at, one, two = row[kept], piece.take(row[kept]), segment[kept]
        met = contacts(one, lines.segments(two), within=ends.within)
        share = np.where(met.meets, met.on_a, np.inf)
        place = np.where(met.meets[0], share[0], share[1:].min(axis=0)) if len(at) else np.zeros(0)
        passed = before[at] + place * length[at]
        near = np.flatnonzero(passed <= ends.radius)
        found.lower(end[at[near]], passed[near], ends.chains.piece[two[near]])
    return found


def _followed(ends: LooseEnds, radius: float) -> tuple[Index, Reals, Segments]:
    """Pieces of the chains from each end back to ``radius`` of their own length, each directed away from the end.

    Returns
    -------
    end, before, piece
        Row of the end, length between the end and the piece, the piece.
    """
    lines, vertex = ends.lines, ends.vertex
    run = lines.along[vertex]
    head, tail = lines.heads[ends.line], lines.tails[ends.line]
    last = last_not_above(lines.along, vertex, np.maximum(tail, vertex + 1), run + radius)
    first = last_not_above(lines.along, head, vertex + 1, run - radius) + 1
    count = np.where(ends.forward, last - vertex, vertex - first) + 1
    end, place = ragged(np.zeros(len(vertex), dtype=np.intp), count)
    stride = np.where(ends.forward, 1, -1)
    start = vertex[end] + stride[end] * place
    stop = start + stride[end]
    before = np.abs(lines.along[start] - run[end])
    length = np.abs(lines.along[stop] - lines.along[start])
    share = np.clip((radius - before) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    share = np.where(length > 0, share, 1.0)
    p0, p1, z0, z1 = lines.plane[start], lines.plane[stop], lines.depth[start], lines.depth[stop]
    return end, before, Segments(p0, at_share(share, p0, p1), z0, at_share(share, z0, z1))
