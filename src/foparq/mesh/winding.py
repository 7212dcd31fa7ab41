# SPDX-License-Identifier: MIT
"""Winding number of a mesh around places: how often it goes around them, as a whole or, where it is open, in part.

The border of the mesh is closed by a cone over its edges. How often the closed mesh goes around a place is a whole
number: the triangles that a ray passes through are counted, exactly, up or down. What the cone adds is the sum of the
solid angles of its triangles, and is taken off. Nothing is approximated by clusters of triangles.

Source: A. Jacobson, L. Kavan and O. Sorkine-Hornung, Robust inside-outside segmentation using generalized winding
numbers, ACM Transactions on Graphics 32 (2013); A. van Oosterom and J. Strackee, The solid angle of a plane triangle,
IEEE Transactions on Biomedical Engineering 30 (1983).
"""

import numpy as np

from foparq.columns import Index, Reals
from foparq.mesh.bvh import LEAF, Singles, hierarchy
from foparq.mesh.compiled import compiled, parts_of, side_by_side
from foparq.mesh.determinants import WORKSPACE
from foparq.mesh.predicates import orient2d, orient3d, safe

#: places asked in one step
_PART = 2**12


def winding(points: Reals, corners: Index, asked: Reals, *, threads: int | None = None) -> Reals:
    """Generalised winding number of a mesh around places.

    Parameters
    ----------
    points : (p, 3) float
    corners : (n, 3) int
        Points of the triangles, of safe coordinates (`predicates.safe`). Edges are the same where their numbers are: of
        points with equal coordinates give a common number.
    asked : (q, 3) float
        Places.
    threads : int, optional
        By default one a processor. The result does not depend on it.

    Returns
    -------
    (q,) float
        1 inside of a closed mesh whose triangles turn counterclockwise seen from outside, 0 outside, -1 inside of one
        that is inside out; exact where the mesh is closed. Where it is open, the share of the sphere around the place
        that it covers, correct but for rounding; a place is inside if more than half is covered. On the mesh it is one
        of its two sides. NaN where a place is not safe.

    Notes
    -----
    O((n + q) log n + q b) for b edges of the border, where triangles do not lie above each other by the hundred.
    """
    asked = np.asarray(asked, dtype=np.float64)
    told = np.full(len(asked), np.nan)
    rows = np.flatnonzero(safe(asked))
    told[rows] = 0.0
    if not len(corners) or not len(rows):
        return told
    edges = border(corners)
    apex = edges[0, 0] if len(edges) else 0
    edges = edges[(edges != apex).all(axis=1)]
    cone = np.stack([edges[:, 1], edges[:, 0], np.full(len(edges), apex)], axis=1)
    places = np.concatenate([points, asked])
    tree = hierarchy(points, np.concatenate([corners, cone]), threads=threads)

    def count(start: int, end: int) -> None:
        w = np.empty(WORKSPACE)
        _crossings(
            places, len(points), tree.corners, tree.boxes, tree.nodes, tree.levels, tree.origin, rows, start, end,
            told, w,
        )  # fmt: skip
        _take_off(places, len(points), cone, rows, start, end, told, w)

    for _ in side_by_side(count, parts_of(len(rows), _PART), threads=threads):
        pass
    return told


def signed(distance: Reals, turns: Reals) -> Reals:
    """Distances with the sign of their side: negative inside, positive outside.

    Parameters
    ----------
    distance : (q,) float
        Without sign, as `distance.nearest` tells.
    turns : (q,) float
        Winding numbers; a place is inside above one half. NaN makes the distance NaN.
    """
    told: Reals = np.where(np.isnan(turns), np.nan, np.where(turns > 0.5, -distance, distance))  # noqa: PLR2004
    return told


def border(corners: Index) -> Index:
    """Directed edges (b, 2) that triangles pass once more in their direction than against it; k times more, k times.

    Parameters
    ----------
    corners : (n, 3) int
    """
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    forth = start < end
    low, high = np.where(forth, start, end), np.where(forth, end, start)
    ordered = np.lexsort((high, low))
    low, high, forth = low[ordered], high[ordered], forth[ordered]
    begin = np.flatnonzero(np.concatenate([[True], (low[1:] != low[:-1]) | (high[1:] != high[:-1])])[: len(low)])
    net = np.add.reduceat(np.where(forth, 1, -1), begin) if len(begin) else begin
    net[low[begin] == high[begin]] = 0
    one = np.where(net > 0, low[begin], high[begin])
    two = np.where(net > 0, high[begin], low[begin])
    edges: Index = np.repeat(np.stack([one, two], axis=1), np.abs(net), axis=0)
    return edges


@compiled
def _crossings(
    places: Reals, first: int, corners: Index, boxes: Singles, nodes: Singles, levels: Index, origin: Reals,
    rows: Index, start: int, end: int, told: Reals, w: Reals,
) -> None:  # fmt: skip
    """Count the triangles above places, those that face up less those that face down."""
    top = len(levels) - 2
    for k in range(start, end):
        q = first + rows[k]
        x, y, z = places[q, 0] - origin[0], places[q, 1] - origin[1], places[q, 2] - origin[2]
        level, i, total = top, 0, 0
        while i < levels[level + 1] - levels[level]:
            if _below(nodes, levels[level] + i, x, y, z):
                if level:
                    level, i = level - 1, 2 * i
                    continue
                for t in range(i * LEAF, min(i * LEAF + LEAF, len(corners))):
                    if _below(boxes, t, x, y, z):
                        total += _passes(places, corners[t, 0], corners[t, 1], corners[t, 2], q, w)
            i += 1
            while i & 1 == 0 and level < top:
                i >>= 1
                level += 1
        told[rows[k]] += total


@compiled
def _below(boxes: Singles, i: int, x: float, y: float, z: float) -> bool:
    """Whether a ray upward from a place meets a box."""
    return bool((boxes[i, 0] <= x) & (x <= boxes[i, 3]) & (boxes[i, 1] <= y) & (y <= boxes[i, 4]) & (z <= boxes[i, 5]))


@compiled
def _passes(p: Reals, a: int, b: int, c: int, q: int, w: Reals) -> int:
    """1 if the ray upward from q passes a triangle that faces up, -1 if one that faces down, 0 if none."""
    turn = _around(p, a, b, c, q, 0, 1, w)
    return turn if turn != 0 and orient3d(p, a, b, c, q, w) * turn > 0 else 0


@compiled
def _around(p: Reals, a: int, b: int, c: int, q: int, x: int, y: int, w: Reals) -> int:
    """How a triangle turns around q in a coordinate plane; 0 if q lies outside.

    A place on an edge lies to the right of it, whichever triangle asks; one at a corner, above it in y. Of the
    triangles around, it lies in one.
    """
    turn = 0
    for i, j in ((a, b), (b, c), (c, a)):
        if p[i, y] <= p[q, y] < p[j, y] and orient2d(p, i, j, q, x, y, w) > 0:
            turn += 1
        elif p[j, y] <= p[q, y] < p[i, y] and orient2d(p, j, i, q, x, y, w) > 0:
            turn -= 1
    return turn


@compiled
def _take_off(places: Reals, first: int, cone: Index, rows: Index, start: int, end: int, told: Reals, w: Reals) -> None:
    """Take off the share of the sphere around places that a cone covers."""
    for k in range(start, end):
        q = first + rows[k]
        total = 0.0
        for t in range(len(cone)):
            total += solid_angle(places, cone[t, 0], cone[t, 1], cone[t, 2], q, w)
        told[rows[k]] -= total / (4.0 * np.pi)


@compiled
def solid_angle(p: Reals, a: int, b: int, c: int, q: int, w: Reals) -> float:
    """Solid angle of a triangle seen from q, positive if its corners turn clockwise there.

    Parameters
    ----------
    p : (n, 3) float
    a, b, c, q : int
        Rows of p.
    w : (WORKSPACE,) float
        Workspace.

    Notes
    -----
    The side of q is exact. A place on the triangle sees it as from above, as the count of triangles above it does.
    """
    side = orient3d(p, a, b, c, q, w)
    if side == 0:
        return -2.0 * np.pi * _on_plane(p, a, b, c, q, w)
    ax, ay, az = p[a, 0] - p[q, 0], p[a, 1] - p[q, 1], p[a, 2] - p[q, 2]
    bx, by, bz = p[b, 0] - p[q, 0], p[b, 1] - p[q, 1], p[b, 2] - p[q, 2]
    cx, cy, cz = p[c, 0] - p[q, 0], p[c, 1] - p[q, 1], p[c, 2] - p[q, 2]
    la, lb, lc = (
        np.sqrt(ax * ax + ay * ay + az * az), np.sqrt(bx * bx + by * by + bz * bz), np.sqrt(cx * cx + cy * cy + cz * cz)
    )  # fmt: skip
    volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    rest = (
        la * lb * lc + (ax * bx + ay * by + az * bz) * lc + (bx * cx + by * cy + bz * cz) * la
        + (cx * ax + cy * ay + cz * az) * lb
    )  # fmt: skip
    return 2.0 * float(np.arctan2(np.copysign(volume, side), rest))


@compiled
def _on_plane(p: Reals, a: int, b: int, c: int, q: int, w: Reals) -> int:
    """How a triangle turns around a place of its plane, seen from above, or from ahead if it stands upright."""
    for x, y in ((0, 1), (1, 2), (2, 0)):
        if orient2d(p, a, b, c, x, y, w) != 0:
            return _around(p, a, b, c, q, x, y, w)
    return 0
