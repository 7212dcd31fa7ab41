# SPDX-License-Identifier: MIT
"""Hierarchy of boxes over the triangles of a mesh.

Triangles are sorted along a Z-order curve and packed eight to a leaf; leaves are paired level by level. Node i of a
level holds nodes 2 i and 2 i + 1 of the level below: the tree has no pointers.

Boxes are of single precision, relative to an origin amid the mesh and rounded outward. Subtraction and rounding keep
the order of numbers: boxes that meet still meet.

Source: C. Lauterbach et al., Fast BVH construction on GPUs, Computer Graphics Forum 28 (2009); G. M. Morton (1966).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Index, Reals
from foparq.mesh.compiled import compiled, parts_of, side_by_side
from foparq.mesh.predicates import safe

Singles = NDArray[np.float32]
Keys = NDArray[np.uint64]

LEAF = 8  #: triangles in a leaf
_GREATEST = 3e38  # of single precision, but for rounding
#: rows worked on in one step
_PART = 2**17
#: points looked at to tell the bulk of a mesh from what lies far outside
_SAMPLE = 1000


class Hierarchy(NamedTuple):
    """Boxes over n triangles, in the order of the curve.

    Attributes
    ----------
    order : (n,) int
        Row of the triangle at each place of the curve.
    corners : (n, 3) int
        Its points, in that order.
    boxes : (n, 6) float32
        Least and greatest x, y, z of each triangle, relative to ``origin``.
    nodes : (m, 6) float32
        Boxes of the nodes: all leaves, then level by level up to the root.
    levels : (l + 1,) int
        Where each level begins among the nodes.
    origin : (3,) float
    """

    order: Index
    corners: Index
    boxes: Singles
    nodes: Singles
    levels: Index
    origin: Reals


def hierarchy(points: Reals, corners: Index, rows: Index | None = None, *, threads: int | None = None) -> Hierarchy:
    """Boxes over the triangles of a mesh.

    Parameters
    ----------
    points : (p, 3) float
        Points of the triangles have safe coordinates (`predicates.safe`).
    corners : (n, 3) int
        Points of the triangles.
    rows : (k,) int, optional
        Triangles to take, at least one; by default all.
    threads : int, optional
        By default one a processor. The result does not depend on it.

    Notes
    -----
    O(n log n) for sorting, else O(n); 56 bytes a triangle.
    """
    rows = np.arange(len(corners)) if rows is None else rows
    low, high = bulk(points)
    order = rows[curve(points, corners, rows, low, high, threads=threads)]
    return _packed(points, corners[order], order, low / 2 + high / 2, threads)


def curve(points: Reals, corners: Index, rows: Index, low: Reals, high: Reals, *, threads: int | None = None) -> Index:
    """Order of triangles along a Z-order curve: places in ``rows``.

    Parameters
    ----------
    points, corners, rows, threads
        As in `hierarchy`.
    low, high : (3,) float
        Box that the curve fills; what lies outside is taken to its border.

    Returns
    -------
    (k,) int
    """
    keys = np.empty(len(rows), dtype=np.uint64)
    bits = max(len(rows) - 1, 1).bit_length()
    fineness = min((64 - bits) // 3, 21)

    def key(start: int, end: int) -> None:
        _keys(points, corners, rows, low, high, fineness, bits, keys, start, end)

    for _ in side_by_side(key, parts_of(len(rows), _PART), threads=threads):
        pass
    # The place lies in the low bits: sorting numbers is several times as fast as sorting their places.
    keys.sort()
    order: Index = (keys & np.uint64(2**bits - 1)).astype(np.intp)
    return order


def _packed(points: Reals, corners: Index, order: Index, origin: Reals, threads: int | None) -> Hierarchy:
    """Hierarchy over triangles in the order of the curve."""
    boxes = np.empty((len(order), 6), dtype=np.float32)

    def box(start: int, end: int) -> None:
        _boxes(points, corners, origin, boxes, start, end)

    for _ in side_by_side(box, parts_of(len(order), _PART), threads=threads):
        pass
    sizes = [-(-len(order) // LEAF)]
    while sizes[-1] > 1:
        sizes.append(-(-sizes[-1] // 2))
    levels = np.cumsum([0, *sizes])
    nodes = np.empty((levels[-1], 6), dtype=np.float32)
    _join(boxes, LEAF, nodes[: sizes[0]])
    for below, above in zip(range(len(sizes) - 1), range(1, len(sizes)), strict=True):
        _join(nodes[levels[below] : levels[above]], 2, nodes[levels[above] : levels[above + 1]])
    return Hierarchy(order, corners, boxes, nodes, levels, origin)


def bulk(points: Reals) -> tuple[Reals, Reals]:
    """Opposite corners (3,) of a box around the bulk of points; what lies far outside takes no fineness from it.

    Parameters
    ----------
    points : (n, 3) float
        Those that are not safe (`predicates.safe`) are not looked at.
    """
    few = points[:: max(1, len(points) // _SAMPLE)]
    few = np.sort(few[safe(few)], axis=0)
    if not len(few):
        return np.zeros(3), np.zeros(3)
    tenth = len(few) // 10
    low, high = few[tenth], few[-1 - tenth]
    room = 4 * (high - low)
    return np.fmax(low - room, np.fmin.reduce(points)), np.fmin(high + room, np.fmax.reduce(points))


@compiled
def _spread(cell: int) -> np.uint64:
    """Bits of a number moved apart to every third place."""
    spread = np.uint64(cell) & np.uint64(0x1FFFFF)
    spread = (spread | (spread << np.uint64(32))) & np.uint64(0x1F00000000FFFF)
    spread = (spread | (spread << np.uint64(16))) & np.uint64(0x1F0000FF0000FF)
    spread = (spread | (spread << np.uint64(8))) & np.uint64(0x100F00F00F00F00F)
    spread = (spread | (spread << np.uint64(4))) & np.uint64(0x10C30C30C30C30C3)
    return (spread | (spread << np.uint64(2))) & np.uint64(0x1249249249249249)


@compiled
def _keys(
    points: Reals, corners: Index, rows: Index, low: Reals, high: Reals,
    fineness: int, bits: int, keys: Keys, start: int, end: int,
) -> None:  # fmt: skip
    """Place of triangles along the curve, above the number of their row among ``rows``."""
    side = max(high[0] - low[0], high[1] - low[1], high[2] - low[2])
    last = 2.0**fineness - 1.0
    for k in range(start, end):
        key = np.uint64(0)
        for axis in range(3):
            first = points[corners[rows[k], 0], axis]
            least, most = first, first
            for corner in range(1, 3):
                value = points[corners[rows[k], corner], axis]
                least, most = min(least, value), max(most, value)
            middle = least / 2 + most / 2 - low[axis]
            share = min(max(middle / side, 0.0), 1.0) if side > 0.0 else 0.0
            key |= _spread(int(share * last)) << np.uint64(axis)
        keys[k] = (key << np.uint64(bits)) | np.uint64(k)


@compiled
def _boxes(points: Reals, corners: Index, origin: Reals, boxes: Singles, start: int, end: int) -> None:
    """Boxes of triangles, relative to the origin, rounded outward."""
    for k in range(start, end):
        for axis in range(3):
            first = points[corners[k, 0], axis]
            least, most = first, first
            for corner in range(1, 3):
                value = points[corners[k, corner], axis]
                least, most = min(least, value), max(most, value)
            low, high = least - origin[axis], most - origin[axis]
            # Outward of the rounding of both steps. What single precision cannot tell reaches to infinity.
            boxes[k, axis] = np.float32(min(low - abs(low) * 2.0**-23, _GREATEST))
            boxes[k, axis + 3] = np.float32(max(high + abs(high) * 2.0**-23, -_GREATEST))


@compiled
def _join(below: Singles, many: int, above: Singles) -> None:
    """Boxes around groups of boxes."""
    for node in range(len(above)):
        begin = node * many
        for axis in range(6):
            value = below[begin, axis]
            for k in range(begin + 1, min(begin + many, len(below))):
                value = min(value, below[k, axis]) if axis < 3 else max(value, below[k, axis])  # noqa: PLR2004
            above[node, axis] = value
