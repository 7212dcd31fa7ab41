# SPDX-License-Identifier: MIT
"""Nearest place of a mesh to given places."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index, Reals
from foparq.mesh.bvh import LEAF, Hierarchy, Singles, bulk, curve
from foparq.mesh.compiled import compiled, parts_of, side_by_side
from foparq.mesh.predicates import safe

#: places asked in one step
_PART = 2**12
#: nodes that wait: two a level
_DEPTH = 128

Place = tuple[float, float, float, float]


class Nearest(NamedTuple):
    """Nearest place of a mesh to each of q places.

    Attributes
    ----------
    distance : (q,) float
        In the unit of the coordinates; NaN where a coordinate is not safe (`predicates.safe`).
    row : (q,) int
        Triangle that it lies on, of several the first; -1 where there is none.
    place : (q, 3) float
    """

    distance: Reals
    row: Index
    place: Reals


def nearest(points: Reals, tree: Hierarchy, asked: Reals, *, threads: int | None = None) -> Nearest:
    """Nearest place of the triangles of a mesh.

    Parameters
    ----------
    points : (p, 3) float
        Those of the mesh.
    tree : Hierarchy
        Over at least one triangle of safe coordinates; it may be a line or a point.
    asked : (q, 3) float
        Places.
    threads : int, optional
        By default one a processor. The result does not depend on it.

    Returns
    -------
    Nearest
        Distances are without sign. Their error is a few roundings of the coordinates relative to the place asked.

    Notes
    -----
    O(q log n) for places near the mesh. Where two triangles are equally near but for rounding, either may be told.
    Squares of areas must not over- or underflow: an extent within 1e-70 ... 1e70 is safe. `winding.signed` tells the
    sides apart.
    """
    asked = np.ascontiguousarray(asked, dtype=np.float64)
    found = Nearest(np.full(len(asked), np.nan), np.full(len(asked), -1, dtype=np.intp), np.full(asked.shape, np.nan))
    rows = np.flatnonzero(safe(asked))
    if not len(rows):
        return found
    same = np.repeat(np.arange(len(asked))[:, None], 3, axis=1)
    order = rows[curve(asked, same, rows, *bulk(asked), threads=threads)]

    def seek(start: int, end: int) -> None:
        _seek(
            points, tree.corners, tree.order, tree.boxes, tree.nodes, tree.levels, tree.origin, asked, order, start,
            end, found.distance, found.row, found.place, np.empty((_DEPTH, 2), dtype=np.intp), np.empty(_DEPTH),
        )  # fmt: skip

    for _ in side_by_side(seek, parts_of(len(order), _PART), threads=threads):
        pass
    return found


@compiled
def _seek(
    points: Reals, corners: Index, order: Index, boxes: Singles, nodes: Singles, levels: Index, origin: Reals,
    asked: Reals, queue: Index, start: int, end: int, distance: Reals, row: Index, place: Reals, stack: Index,
    gaps: Reals,
) -> None:  # fmt: skip
    """Nearest places of some of the places asked, in their order along the curve."""
    last = 0
    for k in range(start, end):
        q = queue[k]
        x, y, z = asked[q, 0], asked[q, 1], asked[q, 2]
        # What was nearest to the place before is near to this one: most nodes are left out at once.
        best = closest(points, corners[last, 0], corners[last, 1], corners[last, 2], x, y, z)
        best, last = _descend(points, corners, order, boxes, nodes, levels, origin, x, y, z, best, last, stack, gaps)
        distance[q], row[q] = np.sqrt(best[3]), order[last]
        place[q, 0], place[q, 1], place[q, 2] = x + best[0], y + best[1], z + best[2]


@compiled
def _descend(
    points: Reals, corners: Index, order: Index, boxes: Singles, nodes: Singles, levels: Index, origin: Reals,
    x: float, y: float, z: float, best: Place, last: int, stack: Index, gaps: Reals,
) -> tuple[Place, int]:  # fmt: skip
    """Nearest place of all triangles, given that of one, and the triangle: the nearer node first."""
    dx, dy, dz = x - origin[0], y - origin[1], z - origin[2]
    stack[0, 0], stack[0, 1], gaps[0] = len(levels) - 2, 0, 0.0
    waiting = 1
    while waiting:
        waiting -= 1
        level, i = stack[waiting, 0], stack[waiting, 1]
        if gaps[waiting] > best[3]:
            continue
        if level == 0:
            best, last = _leaf(points, corners, order, boxes, i, dx, dy, dz, x, y, z, best, last)
            continue
        level, i = level - 1, 2 * i
        one = _gap(nodes, levels[level] + i, dx, dy, dz)
        two = np.inf
        if i + 1 < levels[level + 1] - levels[level]:
            two = _gap(nodes, levels[level] + i + 1, dx, dy, dz)
        for turn in range(2):
            second = (one <= two) == (turn == 0)
            gap = two if second else one
            if gap <= best[3]:
                stack[waiting, 0], stack[waiting, 1], gaps[waiting] = level, i + second, gap
                waiting += 1
    return best, last


@compiled
def _leaf(
    points: Reals,
    corners: Index,
    order: Index,
    boxes: Singles,
    leaf: int,
    dx: float,
    dy: float,
    dz: float,
    x: float,
    y: float,
    z: float,
    best: Place,
    last: int,
) -> tuple[Place, int]:
    """Nearest place of the triangles of a leaf, if it is nearer than what is known."""
    for k in range(leaf * LEAF, min(leaf * LEAF + LEAF, len(order))):
        if _gap(boxes, k, dx, dy, dz) > best[3]:
            continue
        found = closest(points, corners[k, 0], corners[k, 1], corners[k, 2], x, y, z)
        if found[3] < best[3] or (found[3] == best[3] and order[k] < order[last]):
            best, last = found, k
    return best, last


@compiled
def _gap(nodes: Singles, node: int, x: float, y: float, z: float) -> float:
    """Square of the distance to a box."""
    dx = max(nodes[node, 0] - x, 0.0, x - nodes[node, 3])
    dy = max(nodes[node, 1] - y, 0.0, y - nodes[node, 4])
    dz = max(nodes[node, 2] - z, 0.0, z - nodes[node, 5])
    square: float = dx * dx + dy * dy + dz * dz
    return square


@compiled
def closest(p: Reals, a: int, b: int, c: int, x: float, y: float, z: float) -> Place:
    """Place of a triangle nearest to x, y, z.

    Parameters
    ----------
    p : (n, 3) float
    a, b, c : int
        Rows of p; they may lie on one line or be one place.
    x, y, z : float

    Returns
    -------
    x, y, z, square : float
        The way from the place asked to the nearest, and the square of its length.

    Notes
    -----
    The nearest of all edges and, if it lies within, of the foot on the plane, which is corrected once: of a narrow
    triangle the first solution is not good.
    """
    ax, ay, az = p[a, 0] - x, p[a, 1] - y, p[a, 2] - z
    bx, by, bz = p[b, 0] - x, p[b, 1] - y, p[b, 2] - z
    cx, cy, cz = p[c, 0] - x, p[c, 1] - y, p[c, 2] - z
    best = _on_edge(ax, ay, az, p[b, 0] - p[a, 0], p[b, 1] - p[a, 1], p[b, 2] - p[a, 2])
    found = _on_edge(bx, by, bz, p[c, 0] - p[b, 0], p[c, 1] - p[b, 1], p[c, 2] - p[b, 2])
    if found[3] < best[3]:
        best = found
    found = _on_edge(cx, cy, cz, p[a, 0] - p[c, 0], p[a, 1] - p[c, 1], p[a, 2] - p[c, 2])
    if found[3] < best[3]:
        best = found
    ux, uy, uz = p[b, 0] - p[a, 0], p[b, 1] - p[a, 1], p[b, 2] - p[a, 2]
    vx, vy, vz = p[c, 0] - p[a, 0], p[c, 1] - p[a, 1], p[c, 2] - p[a, 2]
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    square = nx * nx + ny * ny + nz * nz
    if square == 0.0:
        return best
    s, t, fx, fy, fz = 0.0, 0.0, ax, ay, az
    for _ in range(2):
        s += (nx * (vy * fz - vz * fy) + ny * (vz * fx - vx * fz) + nz * (vx * fy - vy * fx)) / square
        t += (nx * (fy * uz - fz * uy) + ny * (fz * ux - fx * uz) + nz * (fx * uy - fy * ux)) / square
        fx, fy, fz = ax + s * ux + t * vx, ay + s * uy + t * vy, az + s * uz + t * vz
    reached = fx * fx + fy * fy + fz * fz
    if s >= 0.0 and t >= 0.0 and s + t <= 1.0 and reached < best[3]:
        return fx, fy, fz, reached
    return best


@compiled
def _on_edge(x: float, y: float, z: float, ux: float, uy: float, uz: float) -> Place:
    """Place nearest to the origin on the way from x, y, z along u."""
    length = ux * ux + uy * uy + uz * uz
    share = min(max(-(x * ux + y * uy + z * uz) / length, 0.0), 1.0) if length > 0.0 else 0.0
    x, y, z = x + share * ux, y + share * uy, z + share * uz
    return x, y, z, x * x + y * y + z * z
