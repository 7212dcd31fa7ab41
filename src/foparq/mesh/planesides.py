# SPDX-License-Identifier: MIT
"""Triangles that lie on one side of the plane of another: most neighbours of a curved surface, told at little cost."""

from foparq.columns import Reals
from foparq.mesh.compiled import compiled

#: as of orientation determinants in doubles (`predicates`): the same products and sums in the same order
_BOUND = (7.0 + 56.0 * 2.0**-53) * 2.0**-53
_UNDERFLOW = 1e-220

Plane = tuple[float, float, float, float, float, float]


@compiled
def plane_of(p: Reals, a: int, b: int, c: int) -> Plane:
    """Normal of a triangle in doubles, and what bounds its error: the sizes of the products it is made of.

    Parameters
    ----------
    p : (n, 3) float
        Safe coordinates.
    a, b, c : int
        Rows of p.
    """
    ux, uy, uz = p[b, 0] - p[a, 0], p[b, 1] - p[a, 1], p[b, 2] - p[a, 2]
    vx, vy, vz = p[c, 0] - p[a, 0], p[c, 1] - p[a, 1], p[c, 2] - p[a, 2]
    yz, zy, zx, xz, xy, yx = uy * vz, uz * vy, uz * vx, ux * vz, ux * vy, uy * vx
    return yz - zy, zx - xz, xy - yx, abs(yz) + abs(zy), abs(zx) + abs(xz), abs(xy) + abs(yx)


@compiled
def beside(p: Reals, a: int, b: int, c: int, plane: Plane, d: int, e: int, f: int) -> bool:
    """Whether a triangle surely has no more in common with another than the corners or the edge that they share.

    It has not if all its corners that are not shared lie on one side of the other's plane.

    Parameters
    ----------
    p : (n, 3) float
        Safe coordinates.
    a, b, c : int
        Corners of the other triangle.
    plane : tuple of float
        Of a, b, c, by `plane_of`.
    d, e, f : int
        Corners of the triangle.

    Returns
    -------
    bool
        False says nothing.
    """
    one, two, three = _side(p, a, plane, d), _side(p, a, plane, e), _side(p, a, plane, f)
    apart = abs(one + two + three)
    within = (one == 0) + (two == 0) + (three == 0)
    # Shared corners lie in the plane. All is compared: branches that cannot be foreseen cost several times as much.
    if (apart == 0) | (apart + within != 3):  # noqa: PLR2004
        return False
    shared = (
        (d == a) | (d == b) | (d == c),
        (e == a) | (e == b) | (e == c),
        (f == a) | (f == b) | (f == c),
    )  # fmt: skip
    if within == shared[0] + shared[1] + shared[2]:
        return True
    for v, side in ((d, one), (e, two), (f, three)):
        if side == 0 and not (_same(p, v, a) or _same(p, v, b) or _same(p, v, c)):
            return False
    return True


@compiled
def _side(p: Reals, a: int, plane: Plane, v: int) -> int:
    """Side of a plane on which a point surely lies, or 0."""
    x, y, z, size_x, size_y, size_z = plane
    dx, dy, dz = p[v, 0] - p[a, 0], p[v, 1] - p[a, 1], p[v, 2] - p[a, 2]
    height = x * dx + y * dy + z * dz
    bound = _BOUND * (size_x * abs(dx) + size_y * abs(dy) + size_z * abs(dz)) + _UNDERFLOW
    return int(height > bound) - int(height < -bound)


@compiled
def _same(p: Reals, a: int, b: int) -> bool:
    """Whether two points have the same coordinates."""
    return bool((p[a, 0] == p[b, 0]) & (p[a, 1] == p[b, 1]) & (p[a, 2] == p[b, 2]))
