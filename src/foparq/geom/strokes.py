# SPDX-License-Identifier: MIT
"""Lines no longer than a point: no linework by themselves, and joints of what they touch.

A *stroke* is a line that is not longer than ``coincide``. Strokes touch each other where an end of one is as near as
``coincide`` to an end of the other; a *joint* is a chain of strokes that touch. A joint touches the lines that are as
near as that to an end of one of its strokes.
"""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.polylines import Polylines
from foparq.geom.segments import at_share, nearest_share
from foparq.geom.stretches import components


class Joints(NamedTuple):
    """Joints of some lines, and the linework that they touch."""

    tip: Index  #: (t,) end vertices of the strokes, rows of the coordinates
    joint: Index  #: (t,) of each of them
    touching: Index  #: (k,) joint of each touch
    segment: Index  #: (k,) segment touched, never of a stroke


def joints(lines: Polylines, short: Flags, *, within: float) -> Joints:
    """Joints that strokes make, and the segments of other lines that they touch.

    Parameters
    ----------
    lines : Polylines, n lines
    short : (n,) bool
        Which lines are strokes.
    within : float, metres
        Distance up to which places are one, in the plane and in depth.

    Notes
    -----
    O(t log t + near pairs); strokes at one place cost no pairs.
    """
    strokes = np.flatnonzero(short & (np.diff(lines.offsets) > 0))
    tip = np.concatenate([lines.heads[strokes], lines.tails[strokes]])
    joint = _chained(lines, tip, np.tile(np.arange(len(strokes)), 2), within)
    turned = lines.plane[tip] @ lines.turn
    touching, segments = [tip[:0]], [tip[:0]]
    for asked, found in lines.tree.query(turned, turned, distance=within):
        kept = ~short[lines.line[found]]
        at, segment = asked[kept], found[kept]
        near = lines.segments(segment)
        share = nearest_share(lines.plane[tip[at]], near.start, near.end)
        flat = np.hypot(*(at_share(share, near.start, near.end) - lines.plane[tip[at]]).T)
        drop = np.abs(at_share(share, near.z0, near.z1) - lines.depth[tip[at]])
        met = (flat <= within) & (drop <= within)
        touching.append(joint[at[met]])
        segments.append(segment[met])
    return Joints(tip, joint, np.concatenate(touching), np.concatenate(segments))


def near_tips(lines: Polylines, found: Joints, vertex: Index, *, within: float) -> tuple[Index, Index]:
    """Vertices that a joint touches.

    Parameters
    ----------
    vertex : (v,) int
        Rows of the coordinates.
    within : float, metres

    Returns
    -------
    row, joint : (k,) int
        Row of ``vertex``, and a joint that it touches; each pair once.
    """
    pairs = [np.zeros((2, 0), dtype=np.intp)]
    for at, tip in _tree(lines, found.tip).query(*[lines.plane[vertex] @ lines.turn] * 2, distance=within):
        met = _near(lines, vertex[at], found.tip[tip], within)
        pairs.append(np.unique(np.stack([at[met], found.joint[tip[met]]]), axis=1))
    row, joint = np.unique(np.concatenate(pairs, axis=1), axis=1)
    return row, joint


def _chained(lines: Polylines, tip: Index, stroke: Index, within: float) -> Index:
    """Joint (t,) of every tip: tips of one stroke, and tips that are near each other, belong together."""
    count = int(stroke.max()) + 1 if len(stroke) else 0
    # Strokes in one small cell are one to begin with: a heap of them costs no pairs.
    cell = np.floor(np.column_stack([lines.plane[tip], lines.depth[tip]]) / (0.57 * within))
    _, place = np.unique(cell, axis=0, return_inverse=True)
    place = place.reshape(-1)
    first = np.full(int(place.max()) + 1 if len(place) else 0, count, dtype=np.intp)
    np.minimum.at(first, place, stroke)
    joint = components(count, stroke, first[place])[stroke]
    edges = [np.zeros((2, 0), dtype=np.intp)]
    for one, two in _tree(lines, tip).pairs(distance=within):
        apart = joint[one] != joint[two]
        i, j = one[apart], two[apart]
        met = _near(lines, tip[i], tip[j], within)
        edges.append(np.unique(np.stack([joint[i[met]], joint[j[met]]]), axis=1))
    pair = np.concatenate(edges, axis=1)
    return components(int(joint.max()) + 1 if len(joint) else 0, pair[0], pair[1])[joint]


def _tree(lines: Polylines, vertex: Index) -> BoxTree:
    turned = lines.plane[vertex] @ lines.turn
    return BoxTree(turned, turned)


def _near(lines: Polylines, one: Index, two: Index, within: float) -> Flags:
    flat: Reals = np.hypot(*(lines.plane[one] - lines.plane[two]).T)
    near: Flags = (flat <= within) & (np.abs(lines.depth[one] - lines.depth[two]) <= within)
    return near
