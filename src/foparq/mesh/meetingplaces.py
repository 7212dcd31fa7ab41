# SPDX-License-Identifier: MIT
"""Where triangles meet that intersect.

Which ends bound what two triangles have in common is decided by exact signs. Where they are on an edge is the ratio of
two determinants that are worked out exactly and rounded once, so that planes or edges that are nearly one still cross
where they do.
"""

import numpy as np

from foparq.columns import Index, Reals
from foparq.mesh.compiled import compiled
from foparq.mesh.determinants import WORKSPACE, area, volume
from foparq.mesh.predicates import orient2d, orient3d
from foparq.mesh.trianglepairs import crossing, line_signs, plane_axes, shared_corners, turned

#: most ends of what two triangles have in common: three corners of each, nine crossings of edges
_MOST = 15


def places_of(points: Reals, corners: Index, first: Index, second: Index) -> Reals:
    """Ends of what pairs of triangles have in common.

    Parameters
    ----------
    points : (p, 3) float
        Safe coordinates.
    corners : (n, 3) int
    first, second : (k,) int
        Rows of triangles that intersect (`trianglepairs.meeting`).

    Returns
    -------
    (k, 2, 3) float
        The two ends that are farthest apart; of a single point, twice the same.

    Notes
    -----
    O(k).
    """
    segment = np.empty((len(first), 2, 3))
    if len(first):
        _places(points, corners, first, second, segment, np.empty((_MOST, 3)), np.empty(WORKSPACE))
    return segment


@compiled
def _places(p: Reals, corners: Index, first: Index, second: Index, segment: Reals, ends: Reals, w: Reals) -> None:
    for k in range(len(first)):
        i, j = first[k], second[k]
        a, b, c = corners[i, 0], corners[i, 1], corners[i, 2]
        d, e, f = corners[j, 0], corners[j, 1], corners[j, 2]
        shared, one, two = shared_corners(p, a, b, c, d, e, f)
        if shared == 1:
            a, b, c = turned(a, b, c, one)
            d, e, f = turned(d, e, f, two)
        kind, apex, other, _, _ = crossing(p, a, b, c, d, e, f, min(shared, 1) * (shared < 2), w)  # noqa: PLR2004
        if kind == 1:
            a, b, c = turned(a, b, c, apex)
            d, e, f = turned(d, e, f, other)
            n = _ends_on_line(p, a, b, c, d, e, f, ends, w)
        else:
            n = _ends_in_plane(p, a, b, c, d, e, f, ends, w)
        _farthest(ends, n, p, a, segment[k])


@compiled
def _farthest(ends: Reals, n: int, p: Reals, a: int, segment: Reals) -> None:
    """Write the two ends that are farthest apart, of equals the first; ends are relative to a."""
    one, two, most = 0, 0, 0.0
    for i in range(n):
        for j in range(i):
            x, y, z = ends[i, 0] - ends[j, 0], ends[i, 1] - ends[j, 1], ends[i, 2] - ends[j, 2]
            square = x * x + y * y + z * z
            if square > most:
                one, two, most = j, i, square
    for axis in range(3):
        segment[0, axis] = p[a, axis] + ends[one, axis]
        segment[1, axis] = p[a, axis] + ends[two, axis]


@compiled
def _put(p: Reals, base: int, a: int, b: int, near: float, far: float, ends: Reals, n: int) -> None:
    """Write the place between a and b that is as far from them as heights say, relative to ``base``."""
    total = near - far
    share = min(max(near / total, 0.0), 1.0) if total != 0.0 else 0.5
    for axis in range(3):
        step = p[b, axis] - p[a, axis]
        ends[n, axis] = (p[a, axis] - p[base, axis]) + share * step


@compiled
def _put_on_plane(p: Reals, base: int, a: int, b: int, d: int, e: int, f: int, ends: Reals, n: int, w: Reals) -> None:
    """Write where the edge a b meets the plane d, e, f, relative to ``base``."""
    if orient3d(p, d, e, f, a, w) == 0:
        _put(p, base, a, a, 0.0, 1.0, ends, n)
    elif orient3d(p, d, e, f, b, w) == 0:
        _put(p, base, b, b, 0.0, 1.0, ends, n)
    else:
        _put(p, base, a, b, volume(p, d, e, f, a, w), volume(p, d, e, f, b, w), ends, n)


@compiled
def _ends_on_line(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, ends: Reals, w: Reals) -> int:
    """Ends of either interval on the common line that lie within the other."""
    s, t, u, v = line_signs(p, a, b, c, d, e, f, w)
    n = 0
    if s * t <= 0:
        _put_on_plane(p, a, a, b, d, e, f, ends, n, w)
        n += 1
    if u * v <= 0:
        _put_on_plane(p, a, a, c, d, e, f, ends, n, w)
        n += 1
    if s * u <= 0:
        _put_on_plane(p, a, d, e, a, b, c, ends, n, w)
        n += 1
    if t * v <= 0:
        _put_on_plane(p, a, d, f, a, b, c, ends, n, w)
        n += 1
    return n


@compiled
def _within(p: Reals, a: int, d: int, e: int, f: int, x: int, y: int, w: Reals) -> bool:
    """Whether a lies in the triangle d, e, f or on its border, in a coordinate plane."""
    s, t, u = orient2d(p, d, e, a, x, y, w), orient2d(p, e, f, a, x, y, w), orient2d(p, f, d, a, x, y, w)
    return min(s, t, u) >= 0 or max(s, t, u) <= 0


@compiled
def _ends_in_plane(p: Reals, a: int, b: int, c: int, d: int, e: int, f: int, ends: Reals, w: Reals) -> int:
    """Corners of what two triangles of one plane have in common."""
    x, y = plane_axes(p, a, b, c, w)
    one, two = (a, b, c), (d, e, f)
    n = 0
    for k in range(3):
        if _within(p, one[k], d, e, f, x, y, w):
            _put(p, a, one[k], one[k], 0.0, 1.0, ends, n)
            n += 1
        if _within(p, two[k], a, b, c, x, y, w):
            _put(p, a, two[k], two[k], 0.0, 1.0, ends, n)
            n += 1
    for k in range(3):
        i, j = one[k], one[(k + 1) % 3]
        for m in range(3):
            g, h = two[m], two[(m + 1) % 3]
            apart = orient2d(p, g, h, i, x, y, w) * orient2d(p, g, h, j, x, y, w)
            if apart < 0 and orient2d(p, i, j, g, x, y, w) * orient2d(p, i, j, h, x, y, w) < 0:
                _put(p, a, i, j, area(p, g, h, i, x, y, w), area(p, g, h, j, x, y, w), ends, n)
                n += 1
    return n
