# SPDX-License-Identifier: MIT
"""How two triangles meet beyond what they share, exactly.

What two triangles share are the corners of equal coordinates, whether they have the same number or not: nothing, a
vertex, or the edge between two. They intersect if a point of both lies outside of that.

Source: the intervals on the common line of two planes are compared by orientation signs alone, after O. Devillers and
P. Guigue, Faster triangle-triangle intersection tests, INRIA report 4488 (2002).
"""

from enum import IntEnum

from foparq.columns import Reals
from foparq.mesh.compiled import compiled
from foparq.mesh.predicates import orient2d, orient3d


class Meeting(IntEnum):
    """Why two triangles intersect."""

    NONE = 0  #: they meet in what they share at most, or are duplicates: all three corners shared
    TRANSVERSAL = 1  #: their insides cross along a segment
    COPLANAR = 2  #: they lie in one plane and have area in common
    CONTACT = 3  #: they touch in a point or a segment that they do not share
    FOLD = 4  #: they share an edge, lie in one plane and on the same side of it


_NONE, _TRANSVERSAL, _COPLANAR, _CONTACT, _FOLD = (int(kind) for kind in Meeting)


@compiled
def shared_corners(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int) -> tuple[int, int, int]:
    """Corners that two triangles share.

    Parameters
    ----------
    p : (n, 3) float
    a, b, c, d, e, f : int
        Rows of p: corners of both triangles.

    Returns
    -------
    count, one, two : int
        How many there are; of one shared corner the place in each triangle, of two shared ones the place of the third
        corner in each, which they do not share.
    """
    count, one, two = 0, 0, 0
    for i, u in enumerate((a, b, c)):
        for j, v in enumerate((d, e, f)):
            if u == v or (p[u, 0] == p[v, 0] and p[u, 1] == p[v, 1] and p[u, 2] == p[v, 2]):
                count += 1
                one += i
                two += j
    if count == 2:  # noqa: PLR2004
        return count, 3 - one, 3 - two
    return count, one % 3, two % 3


@compiled
def turned(a: int, b: int, c: int, first: int) -> tuple[int, int, int]:
    """Corners in the same order, from another one on."""
    if first == 0:
        return a, b, c
    return (b, c, a) if first == 1 else (c, a, b)


@compiled
def _apex(s: int, t: int, u: int) -> int:
    """Corner whose two edges meet a plane, given the sides of the corners; -1 if the triangle does not reach it.

    All corners in the plane are not asked for.
    """
    above = (s > 0) + (t > 0) + (u > 0)
    below = (s < 0) + (t < 0) + (u < 0)
    if above == 3 or below == 3:  # noqa: PLR2004
        return -1
    if above == 1 and below != 1:
        alone = 1
    elif below == 1 and above != 1:
        alone = -1
    else:
        # One above, one below, one within: any of the first two. Else one within, two on a side.
        alone = 1 if above == 1 else 0
    if s == alone:
        return 0
    return 1 if t == alone else 2


@compiled
def line_signs(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, w: Reals) -> tuple[int, int, int, int]:
    """Order of two intervals on the line where two planes meet.

    Parameters
    ----------
    p : (n, 3) float
    a, b, c, d, e, f : int
        Corners of both triangles; the edges a b and a c bound the interval of the first on the line, d e and d f that
        of the second.
    w : (WORKSPACE,) float

    Returns
    -------
    int
        For a b with d e, a b with d f, a c with d e, a c with d f: the sign of the way from an end of the first
        interval to an end of the second, all in the same unknown direction.
    """
    return (
        orient3d(p, a, b, d, e, w), orient3d(p, a, b, d, f, w),
        orient3d(p, a, c, d, e, w), orient3d(p, a, c, d, f, w),
    )  # fmt: skip


@compiled
def crossing(
    p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, shared: int, w: Reals
) -> tuple[int, int, int, bool, bool]:
    """Where two triangles reach into each other's plane.

    Parameters
    ----------
    p, a, b, c, d, e, f, w
        As in `meeting`.
    shared : int
        How many corners they share: 0, or 1, which is the first of both.

    Returns
    -------
    kind : int
        0 if one does not reach the plane of the other but in the shared corner, 1 if both do, 2 if they lie in one
        plane.
    apex, other : int
        Place of the corner whose edges meet the other's plane, in each triangle.
    through, points : bool
        Whether both planes pass between corners; whether one triangle has only a point in the other's plane.
    """
    s, t, u = orient3d(p, a, b, c, d, w), orient3d(p, a, b, c, e, w), orient3d(p, a, b, c, f, w)
    if s == 0 and t == 0 and u == 0:
        return 2, 0, 0, False, False
    other = _apex(s, t, u)
    if other < 0:
        return 0, 0, 0, False, False
    through = min(s, t, u) < 0 < max(s, t, u)
    points = not through and abs(s) + abs(t) + abs(u) == 2  # noqa: PLR2004
    if shared and points:
        return 0, 0, 0, False, False
    s, t, u = orient3d(p, d, e, f, a, w), orient3d(p, d, e, f, b, w), orient3d(p, d, e, f, c, w)
    apex = _apex(s, t, u)
    if apex < 0:
        return 0, 0, 0, False, False
    through_too = min(s, t, u) < 0 < max(s, t, u)
    points = points or (not through_too and abs(s) + abs(t) + abs(u) == 2)  # noqa: PLR2004
    return 1, apex, other, through and through_too, points


@compiled
def meeting(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, w: Reals) -> int:
    """Why two triangles intersect, as a number of `Meeting`.

    Parameters
    ----------
    p : (n, 3) float
        Points; safe coordinates (`predicates.safe`).
    a, b, c, d, e, f : int
        Rows of p: corners of both triangles, neither of which has all its corners on one line.
    w : (WORKSPACE,) float
        Workspace, one a thread.

    Notes
    -----
    O(1), at most ten `orient3d` and twenty `orient2d`; neighbours in a flat mesh need none of the former. Orientation
    and order of the triangles do not matter.
    """
    shared, one, two = shared_corners(p, a, b, c, d, e, f)
    if shared > 2:  # noqa: PLR2004
        return _NONE
    if shared:
        a, b, c = turned(a, b, c, one)
        d, e, f = turned(d, e, f, two)
    x, y = plane_axes(p, a, b, c, w)
    if shared == 2:  # noqa: PLR2004
        return _folded(p, a, b, c, d, x, y, w)
    # Seen along an axis first: what is apart there is apart, and in one plane it is all there is to see.
    seen = _around_corner(p, a, b, c, e, f, x, y, w) if shared else _in_plane(p, a, b, c, d, e, f, x, y, w)
    if seen == _NONE:
        return _NONE
    kind, apex, other, through, points = crossing(p, a, b, c, d, e, f, shared, w)
    if kind == 2:  # noqa: PLR2004
        return seen
    if kind == 0:
        return _NONE
    a, b, c = turned(a, b, c, apex)
    d, e, f = turned(d, e, f, other)
    signs = line_signs(p, a, b, c, d, e, f, w)
    return _on_line(min(signs), max(signs), shared, through, points)


@compiled
def _on_line(least: int, most: int, shared: int, through: bool, points: bool) -> int:  # noqa: FBT001
    """What the order of the two intervals on the common line of the planes says."""
    if least > 0 or most < 0:
        return _NONE
    if points or least >= 0 or most <= 0:
        # A point that is shared is no more than that.
        return _NONE if shared else _CONTACT
    return _TRANSVERSAL if through else _CONTACT


@compiled
def _folded(p: Reals, a: int, b: int, c: int, d: int, x: int, y: int, w: Reals) -> int:
    """Whether two triangles of the edge b c, with the third corners a and d, lie on each other."""
    if orient2d(p, b, c, a, x, y, w) != orient2d(p, b, c, d, x, y, w):
        return _NONE
    return _FOLD if orient3d(p, a, b, c, d, w) == 0 else _NONE


@compiled
def plane_axes(p: Reals, a: int, b: int, c: int, w: Reals) -> tuple[int, int]:
    """Coordinate plane on which a triangle has area, exactly; the one of the largest, but for rounding.

    Returns
    -------
    x, y : int
        Its axes; -1, -1 if all corners lie on one line.
    """
    best_x, best_y, most = -1, -1, -1.0
    for x, y in ((0, 1), (1, 2), (2, 0)):
        left = (p[a, x] - p[c, x]) * (p[b, y] - p[c, y])
        right = (p[a, y] - p[c, y]) * (p[b, x] - p[c, x])
        if abs(left - right) > most and orient2d(p, a, b, c, x, y, w) != 0:
            best_x, best_y, most = x, y, abs(left - right)
    return best_x, best_y


@compiled
def _in_plane(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, x: int, y: int, w: Reals) -> int:
    """How two triangles meet in a coordinate plane that share no corner; the second need not have area there."""
    kind = _COPLANAR
    for side in range(2):
        turn = orient2d(p, a, b, c, x, y, w)
        for k in range(3):
            i, j, _ = turned(a, b, c, k)
            most = max(
                turn * orient2d(p, i, j, d, x, y, w),
                turn * orient2d(p, i, j, e, x, y, w),
                turn * orient2d(p, i, j, f, x, y, w),
            )
            if most < 0:
                return _NONE
            if most == 0:
                # The edge parts them; they meet on its line, unless another edge parts them altogether.
                kind = _CONTACT
        if side == 0:
            a, b, c, d, e, f = d, e, f, a, b, c
    return kind


@compiled
def _around_corner(p: Reals, a: int, b: int, c: int, e: int, f: int, x: int, y: int, w: Reals) -> int:
    """How two triangles meet in a coordinate plane that share the corner a: only their angles there matter.

    A second triangle that has no area there is told to have some in common: there is more to see.
    """
    if orient2d(p, a, b, c, x, y, w) < 0:
        b, c = c, b
    turn = orient2d(p, a, e, f, x, y, w)
    if turn == 0:
        return _COPLANAR
    if turn < 0:
        e, f = f, e
    be, bf = orient2d(p, a, b, e, x, y, w), orient2d(p, a, b, f, x, y, w)
    ce, cf = orient2d(p, a, c, e, x, y, w), orient2d(p, a, c, f, x, y, w)
    # One of the four edges parts the angles, if any line does.
    parted = max(be, bf) <= 0 or min(ce, cf) >= 0 or min(be, ce) >= 0 or max(bf, cf) <= 0
    if not parted:
        return _COPLANAR
    for side, i, j in ((be, b, e), (bf, b, f), (ce, c, e), (cf, c, f)):
        if side == 0 and _same_way(p, a, i, j, x, y):
            return _CONTACT
    return _NONE


@compiled
def _same_way(p: Reals, a: int, i: int, j: int, x: int, y: int) -> bool:
    """Whether i and j, on one line with a, lie on the same side of it."""
    axis = x if p[a, x] != p[i, x] else y
    return bool((p[i, axis] > p[a, axis]) == (p[j, axis] > p[a, axis]))
