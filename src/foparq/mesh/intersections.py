# SPDX-License-Identifier: MIT
"""Pairs of triangles of a mesh that intersect beyond what they share."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.mesh.bvh import LEAF, Hierarchy, Singles, hierarchy
from foparq.mesh.compiled import compiled, parts_of, side_by_side
from foparq.mesh.determinants import WORKSPACE
from foparq.mesh.meetingplaces import places_of
from foparq.mesh.planesides import beside, plane_of
from foparq.mesh.predicates import safe
from foparq.mesh.trianglepairs import Meeting, meeting, plane_axes

#: leaves asked in one step
_PART = 2**10
#: pairs that a step has room for at first; with more it is done again
_ROOM = 2**10


class Intersections(NamedTuple):
    """Pairs of triangles that intersect.

    Attributes
    ----------
    first, second : (k,) int
        Rows of triangles, first < second, sorted.
    kind : (k,) int
        Why, as numbers of `Meeting`.
    segment : (k, 2, 3) float
        Ends of what they have in common: a crossing or a touching edge from end to end, a point twice, the longest way
        through a common area. Correct but for rounding.
    counts : (5,) int
        Number of pairs of each kind, kept or not; the place is the number of `Meeting`.
    left_out : (l,) int
        Triangles that took no part, in order: with all corners on one line, exactly, or with a corner that is not safe
        (`predicates.safe`).
    """

    first: Index
    second: Index
    kind: Index
    segment: Reals
    counts: Index
    left_out: Index

    @property
    def total(self) -> int:
        """Number of pairs that intersect, kept or not."""
        return int(self.counts.sum())


def intersections(points: Reals, corners: Index, *, keep: int, threads: int | None = None) -> Intersections:
    """Pairs of triangles that intersect beyond the corners or the edge that they share.

    Parameters
    ----------
    points : (p, 3) float
        As delivered: nothing is shifted, scaled or merged.
    corners : (n, 3) int
        Points of the triangles, by row. Corners of equal coordinates are shared, whatever their rows.
    keep : int
        Greatest number of pairs to keep; all are counted. Of more, those are kept that come first along a curve through
        the mesh.
    threads : int, optional
        By default one a processor. The result does not depend on it.

    Returns
    -------
    Intersections

    Notes
    -----
    O(n log n + c) for c pairs of triangles whose boxes meet. Signs are exact (`trianglepairs.meeting`). Triangles of
    the same three corners are no pair. Triangles left out change nothing of what is said of the others.
    """
    points = np.ascontiguousarray(points, dtype=np.float64)
    corners = np.ascontiguousarray(corners, dtype=np.intp)
    usable = with_area(points, corners, threads=threads)
    left_out = np.flatnonzero(~usable)
    rows = np.flatnonzero(usable) if len(left_out) else None
    first, second, kind = [], [], []
    counts = np.zeros(len(Meeting), dtype=np.intp)
    room = keep
    if len(left_out) < len(corners):
        for pairs, kinds, found in _found(points, hierarchy(points, corners, rows, threads=threads), keep, threads):
            counts += found
            first.append(pairs[:room, 0])
            second.append(pairs[:room, 1])
            kind.append(kinds[:room])
            room -= len(first[-1])
    none = np.empty(0, dtype=np.intp)
    one, two, why = (np.concatenate([none, *column]) for column in (first, second, kind))
    ordered = np.lexsort((two, one))
    one, two, why = one[ordered], two[ordered], why[ordered]
    return Intersections(one, two, why, places_of(points, corners, one, two), counts, left_out)


def with_area(points: Reals, corners: Index, *, threads: int | None = None) -> Flags:
    """Triangles (n,) whose corners have safe coordinates and do not lie on one line, exactly.

    Parameters
    ----------
    points : (p, 3) float
    corners : (n, 3) int
    threads : int, optional
    """
    flags = np.empty(len(corners), dtype=np.bool_)
    sound = safe(points)

    def look(start: int, end: int) -> None:
        _with_area(points, corners, sound, flags, start, end, np.empty(WORKSPACE))

    for _ in side_by_side(look, parts_of(len(corners), _PART * LEAF), threads=threads):
        pass
    return flags


def _found(points: Reals, tree: Hierarchy, keep: int, threads: int | None) -> Iterator[tuple[Index, Index, Index]]:
    """Pairs (k, 2), their kinds (k,) and the counts (5,) of each part of the leaves, in order."""
    so_far = 0

    def search(start: int, end: int) -> tuple[Index, Index, Index]:
        wanted = keep - so_far
        room = min(wanted, _ROOM)
        while True:
            pairs, kinds = np.empty((room, 2), dtype=np.intp), np.empty(room, dtype=np.intp)
            counts = np.zeros(len(Meeting), dtype=np.intp)
            _search(
                points, tree.corners, tree.order, tree.boxes, tree.nodes, tree.levels, start, end,
                pairs, kinds, counts, np.empty(WORKSPACE),
            )  # fmt: skip
            found = int(counts.sum())
            if found <= room or room >= wanted:
                return pairs[:found], kinds[:found], counts
            room = min(found, wanted)

    leaves = -(-len(tree.order) // LEAF)
    for result in side_by_side(search, parts_of(leaves, _PART), threads=threads):
        # Parts that began earlier kept more than is used: what is used does not depend on it.
        so_far = min(so_far + len(result[0]), keep)
        yield result


@compiled
def _with_area(points: Reals, corners: Index, sound: Flags, flags: Flags, start: int, end: int, w: Reals) -> None:
    for k in range(start, end):
        a, b, c = corners[k, 0], corners[k, 1], corners[k, 2]
        flags[k] = sound[a] and sound[b] and sound[c] and plane_axes(points, a, b, c, w)[0] >= 0


@compiled
def _near(a: Singles, i: int, b: Singles, j: int) -> bool:
    """Whether two boxes meet. All is compared: branches that cannot be foreseen cost three times as much."""
    return bool(
        (a[i, 0] <= b[j, 3]) & (b[j, 0] <= a[i, 3])
        & (a[i, 1] <= b[j, 4]) & (b[j, 1] <= a[i, 4])
        & (a[i, 2] <= b[j, 5]) & (b[j, 2] <= a[i, 5])
    )  # fmt: skip


@compiled
def _search(
    points: Reals, corners: Index, order: Index, boxes: Singles, nodes: Singles, levels: Index,
    start: int, end: int, pairs: Index, kinds: Index, counts: Index, w: Reals,
) -> None:  # fmt: skip
    """Pairs of triangles of some leaves with those of the same leaf or a later one.

    The nodes after a leaf are visited without a stack: from a node to the next of its level, and up as long as that is
    the first of its parent.
    """
    top = len(levels) - 2
    near = np.empty((LEAF * LEAF + 1, 2), dtype=np.intp)
    for leaf in range(start, end):
        _leaves(points, corners, order, boxes, nodes, leaf, leaf, near, pairs, kinds, counts, w)
        level, i = 0, leaf
        while True:
            i += 1
            while i & 1 == 0 and level < top:
                i >>= 1
                level += 1
            if i >= levels[level + 1] - levels[level]:
                break
            while _near(nodes, leaf, nodes, levels[level] + i):
                if level == 0:
                    _leaves(points, corners, order, boxes, nodes, leaf, i, near, pairs, kinds, counts, w)
                    break
                level -= 1
                i <<= 1


@compiled
def _leaves(
    points: Reals, corners: Index, order: Index, boxes: Singles, nodes: Singles,
    one: int, two: int, near: Index, pairs: Index, kinds: Index, counts: Index, w: Reals,
) -> None:  # fmt: skip
    """Pairs of triangles of two leaves, or of one."""
    n, waiting = len(order), 0
    for i in range(one * LEAF, min(one * LEAF + LEAF, n)):
        if _near(boxes, i, nodes, two):
            for j in range(i + 1 if one == two else two * LEAF, min(two * LEAF + LEAF, n)):
                # Written in any case, and written over if it is not near.
                near[waiting, 0], near[waiting, 1] = i, j
                waiting += _near(boxes, i, boxes, j)
    last, plane = -1, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for k in range(waiting):
        i, j = near[k, 0], near[k, 1]
        a, b, c = corners[i, 0], corners[i, 1], corners[i, 2]
        d, e, f = corners[j, 0], corners[j, 1], corners[j, 2]
        if i != last:
            last, plane = i, plane_of(points, a, b, c)
        if beside(points, a, b, c, plane, d, e, f):
            continue
        kind = meeting(points, a, b, c, d, e, f, w)
        if kind:
            found = counts.sum()
            counts[kind] += 1
            if found < len(kinds):
                pairs[found, 0], pairs[found, 1] = min(order[i], order[j]), max(order[i], order[j])
                kinds[found] = kind
